#include <mc/check/fit/tests/spectrum.h>

#include <mc/check/fit/tests/fit_test.h>
#include <mc/core/types.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace mc {
namespace {

// Returns 3^digits.
std::size_t power_of_3(int digits) {
  std::size_t n = 1;
  for (int i = 0; i < digits; ++i) n *= 3;
  return n;
}

// Returns the number of periods along an axis; the upper half of the coefficients have negative frequencies.
int periods(std::size_t k, std::size_t size) {
  return k <= size / 2 ? static_cast<int>(k) : static_cast<int>(k) - static_cast<int>(size);
}

struct Wave {
  double exponent = 0; ///< minus the logarithm of its p-value
  PerAxis<int> periods{};
};

struct Band {
  double sum = 0, coefficients = 0;
};

struct Spectrum {
  std::size_t dim;
  Wave largest;
  std::vector<Band> bands;

  // Adds the Fourier coefficient with k periods along the axes.
  void add(const PerAxis<int>& k, double power) {
    int most = 0;
    for (std::size_t d = 0; d < dim; ++d) most = std::max(most, std::abs(k[d]));
    if (most == 0) return;
    if (power > largest.exponent) largest = {power, k};
    // For 0 periods along the last axis, the coefficients include their conjugates.
    const double each = k[dim - 1] == 0 ? 0.5 : 1.0;
    Band& band = bands[static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(most)) - 1)];
    band.sum += each * power;
    band.coefficients += each;
  }
};

// Returns the half of the coefficients of a grid that determines the other half by conjugation, by periods of the last
// axis.
std::vector<std::complex<float>> transform(const std::vector<float>& grid, std::size_t dim, std::size_t size) {
  std::vector<std::complex<float>> x = fourier_transform(grid, size);
  // Rows along the last axis are contiguous. Rows along the other axes are interleaved in blocks.
  std::size_t stride = size / 2 + 1;
  for (std::size_t d = 1; d < dim; ++d) {
    for (std::size_t first = 0; first < x.size(); first += stride * size)
      fourier_transform(&x[first], size, stride, stride, 1);
    stride *= size;
  }
  return x;
}

// Largest number of bins on an axis as a power of 3, limited by memory.
int most_digits(int dim) {
  constexpr PerAxis<int> digits{10, 6, 4, 3, 2, 2};
  return digits[static_cast<std::size_t>(dim - 1)];
}

} // namespace

SpectrumTest::SpectrumTest(int dim, double samples, double step) : dim_(dim) {
  const double wanted = std::log(8 * std::max(samples, 1.0)) / std::log(3.0) / dim;
  int digits = std::clamp(static_cast<int>(std::lround(wanted)), 2, most_digits(dim));
  // A lattice of steps is a wave of amplitude step / (pi w) in bins of width w: a third of the noise of the samples.
  while (digits > 1 && step * static_cast<double>(power_of_3(digits)) * std::sqrt(samples) > 1) --digits;
  size_ = power_of_3(digits);
  observed_.resize(power_of_3(digits * dim));
  expected_.resize(observed_.size());
}

std::vector<Check> SpectrumTest::test(const WeightedCounts& all, double share, double alpha,
                                      const char* coordinates) const {
  double observed = 0, expected = 0, collisions = 0;
  for (const double o : observed_) observed += o;
  for (const double e : expected_) expected += e;
  if (!(observed > 0 && expected > 0 && size_ >= 8)) return {};
  const double scale = observed / expected, bins = static_cast<double>(observed_.size());
  std::vector<float> off(observed_.size());
  for (std::size_t i = 0; i < off.size(); ++i) {
    off[i] = static_cast<float>(observed_[i] - scale * expected_[i]);
    collisions += sqr(expected_[i]);
  }
  const double variance = all.observed_squares + sqr(scale) * std::max(all.expected_squares, all.shares / scale);
  // Neighbouring coefficients are correlated: factor of the variance of a sum of squares, compared with independent
  // ones.
  const double correlated = std::max(1.0, collisions / sqr(expected) * bins);
  const auto dim = static_cast<std::size_t>(dim_);
  const std::vector<std::complex<float>> x = transform(off, dim, size_);
  Spectrum spectrum{dim, {}, std::vector<Band>(static_cast<std::size_t>(std::bit_width(size_ / 2)))};
  const std::size_t half = size_ / 2 + 1;
  for (std::size_t row = 0; row < x.size() / half; ++row) {
    PerAxis<int> k{};
    std::size_t rest = row;
    for (std::size_t d = dim - 1; d-- > 0;) {
      k[d] = periods(rest % size_, size_);
      rest /= size_;
    }
    for (k[dim - 1] = 0; k[dim - 1] < static_cast<int>(half); ++k[dim - 1])
      spectrum.add(k, static_cast<double>(std::norm(x[row * half + static_cast<std::size_t>(k[dim - 1])])) / variance);
  }

  std::vector<Check> checks;
  const auto add = [&](std::string name, double p, double statistic, const std::string& detail) {
    Check c{std::move(name), Verdict::pass, p, share / 2, statistic, 0, Fault::local, {}};
    if (p <= sidak_level(alpha, c.share)) {
      c.verdict = Verdict::fail;
      c.detail = detail;
    }
    checks.push_back(std::move(c));
  };
  const Wave& largest = spectrum.largest;
  add(fmt::format("Fourier coefficients, {}", coordinates), sidak(std::exp(-largest.exponent), 0.5 * (bins - 1)),
      largest.exponent,
      fmt::format("counts minus expected counts oscillate with {} periods along the axes",
                  fmt::format("{}", fmt::join(largest.periods.begin(), largest.periods.begin() + dim_, ", "))));
  double least = 1, family = 0, excess = 0, at = 0;
  for (std::size_t b = 0; b < spectrum.bands.size(); ++b) {
    const double dof = 2 * spectrum.bands[b].coefficients / correlated;
    if (!(dof >= 8)) continue;
    family += 1;
    const double p = chi_square_tail(2 * spectrum.bands[b].sum / correlated, dof);
    if (p >= least) continue;
    least = p;
    excess = spectrum.bands[b].sum / spectrum.bands[b].coefficients - 1;
    at = std::exp2(static_cast<double>(b));
  }
  if (family > 0)
    add(fmt::format("Fourier bands, {}", coordinates), sidak(least, family), 1 + excess,
        fmt::format("Fourier coefficients of {:.0f} to {:.0f} periods have {:.3g} % of the expected power", at,
                    2 * at - 1, 100 * (1 + excess)));
  return checks;
}

double mean_step(const Subject& s, const Pilot& pilot, double most) {
  if (pilot.points.empty()) return 0;
  const std::size_t every = std::max<std::size_t>(pilot.points.size() / 256, 1);
  double largest = 0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(s.dim); ++axis) {
    double sum = 0, points = 0;
    for (std::size_t i = 0; i < pilot.points.size(); i += every) {
      sum += std::min(rounding_step(s, pilot.points[i], axis), most);
      points += 1;
    }
    largest = std::max(largest, sum / points);
  }
  return largest;
}

namespace {

// One number of each of several rows, which are transformed together.
template <std::size_t L> struct Lanes { std::array<float, L> re, im; };

// Replaces (a, b, c) by the transform of (a, v b, w c).
template <std::size_t L>
void butterfly(Lanes<L>& a, Lanes<L>& b, Lanes<L>& c, std::complex<float> v, std::complex<float> w) {
  constexpr float sine = 0.8660254037844386f; // of a third of a turn
  for (std::size_t l = 0; l < L; ++l) {
    const float b_re = b.re[l] * v.real() - b.im[l] * v.imag(), b_im = b.re[l] * v.imag() + b.im[l] * v.real();
    const float c_re = c.re[l] * w.real() - c.im[l] * w.imag(), c_im = c.re[l] * w.imag() + c.im[l] * w.real();
    const float sum_re = b_re + c_re, sum_im = b_im + c_im;
    const float off_re = sine * (b_re - c_re), off_im = sine * (b_im - c_im);
    const float mean_re = a.re[l] - 0.5f * sum_re, mean_im = a.im[l] - 0.5f * sum_im;
    a.re[l] += sum_re;
    a.im[l] += sum_im;
    b.re[l] = mean_re + off_im;
    b.im[l] = mean_im - off_re;
    c.re[l] = mean_re - off_im;
    c.im[l] = mean_im + off_re;
  }
}

// Returns the number with the base-3 digits of i < n = 3^m in reverse.
std::size_t reversed(std::size_t i, std::size_t n) {
  std::size_t result = 0;
  for (; n > 1; n /= 3, i /= 3) result = 3 * result + i % 3;
  return result;
}

template <std::size_t L>
void transform_lanes(std::complex<float>* x, std::size_t n, std::size_t stride, std::size_t distance,
                     const std::vector<std::complex<float>>& roots, std::vector<Lanes<L>>& row) {
  row.resize(n);
  // Gathers the numbers first: columns of a grid are far apart in memory.
  for (std::size_t i = 0; i < n; ++i) {
    Lanes<L>& to = row[reversed(i, n)];
    for (std::size_t l = 0; l < L; ++l) {
      to.re[l] = x[i * stride + l * distance].real();
      to.im[l] = x[i * stride + l * distance].imag();
    }
  }
  for (std::size_t third = 1; third < n; third *= 3)
    for (std::size_t first = 0; first < n; first += 3 * third)
      for (std::size_t i = 0; i < third; ++i) {
        const std::size_t turn = i * (n / 3 / third);
        butterfly(row[first + i], row[first + third + i], row[first + 2 * third + i], roots[turn], roots[2 * turn]);
      }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t l = 0; l < L; ++l) x[i * stride + l * distance] = {row[i].re[l], row[i].im[l]};
}

} // namespace

void fourier_transform(std::complex<float>* x, std::size_t n, std::size_t stride, std::size_t count,
                       std::size_t distance) {
  std::vector<std::complex<float>> roots;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = -2 * pi<double> * static_cast<double>(i) / static_cast<double>(n);
    roots.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
  }
  constexpr std::size_t many = 16;
  std::vector<Lanes<many>> rows;
  std::vector<Lanes<1>> row;
  std::size_t done = 0;
  for (; done + many <= count; done += many) transform_lanes(x + done * distance, n, stride, distance, roots, rows);
  for (; done < count; ++done) transform_lanes(x + done * distance, n, stride, distance, roots, row);
}

std::vector<std::complex<float>> fourier_transform(const std::vector<float>& x, std::size_t n) {
  const std::size_t rows = x.size() / n, half = n / 2 + 1;
  // Transforms two rows at a time, as the real and the imaginary part of one.
  std::vector<std::complex<float>> pairs((rows + 1) / 2 * n), result(rows * half);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t i = 0; i < n; ++i) {
      std::complex<float>& z = pairs[row / 2 * n + i];
      if (row % 2 == 0) z = x[row * n + i];
      else z = {z.real(), x[row * n + i]};
    }
  fourier_transform(pairs.data(), n, 1, pairs.size() / n, n);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t k = 0; k < half; ++k) {
      const std::complex<float> z = pairs[row / 2 * n + k], w = std::conj(pairs[row / 2 * n + (n - k) % n]);
      const std::complex<float> sum = 0.5f * (z + w), difference = 0.5f * (z - w);
      if (row % 2 == 0) result[row * half + k] = sum;
      else result[row * half + k] = {difference.imag(), -difference.real()};
    }
  return result;
}

namespace {

struct SpectrumInProgress {
  SpectrumTest grid;
  double share;

  void expect(const ReferenceBlock& block) {
    for (const StratifiedReference::EvaluatedPoint& p : block.points) grid.add_expected(p.v, p.share);
  }
  void count(const SampleBlock& block) {
    for (std::size_t i = 0; i < block.points.size(); ++i) grid.add_sample(block.points[i], block.weights[i]);
  }
  Findings judge(const FitCounts& counts) const {
    return {grid.test(counts.all, share, counts.setup.options.alpha, "chart")};
  }
};

bool is_finite(const Subject::Coordinates& u) {
  return std::all_of(u.begin(), u.end(), [](double x) { return std::isfinite(x); });
}

} // namespace

FitTest spectrum_test(const FitSetup& setup, double share) {
  const double n = static_cast<double>(setup.options.samples);
  const double step = mean_step(setup.subject, setup.pilot, 1 / std::sqrt(n));
  return make_fit_test(SpectrumInProgress{SpectrumTest(setup.subject.dim, n, step), share});
}

FitTest inverted_spectrum_test(const FitSetup&, double share) {
  return {.judge = [share](const FitCounts& counts) {
    const std::vector<Subject::Coordinates>& inverted = counts.inverted;
    if (inverted.empty() || !std::all_of(inverted.begin(), inverted.end(), is_finite)) return Findings{};
    const Subject& s = counts.setup.subject;
    SpectrumTest grid(s.dim, static_cast<double>(inverted.size()), s.invert_error);
    grid.expect_uniform();
    WeightedCounts all;
    for (const Subject::Coordinates& u : inverted) {
      grid.add_sample(u, 1);
      all.add_sample(1, 0);
    }
    return Findings{grid.test(all, share, counts.setup.options.alpha, "inverted samples")};
  }};
}

} // namespace mc
