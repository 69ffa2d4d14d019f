#include <converge/picture_errors.h>

#include <mc/core/types.h>
#include <mc/estimate/moments.h>
#include <mc/stats/t_test.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carlo {

using render::Image;

namespace {

/// Share of the squared mean over pixels and channels that is added to the square of a pixel. A share makes the relmse
/// independent of the unit of light. In the median over the gallery's pictures it equals the .01 of carlo compare.
constexpr double relmse_floor_share = 0.1;

// Squared difference of two images at one pixel, relative to the reference, averaged over channels.
double relative_square(const Image& image, const Image& from, const ReferencePicture& reference, std::size_t i) {
  const Eigen::Array3d off = image.pixels[i].cast<double>() - from.pixels[i].cast<double>();
  return (off.square() / (reference.image.pixels[i].cast<double>().square() + reference.relmse_floor)).sum() / 3;
}

// The mean of relative_square over all pixels.
double relmse(const Image& image, const Image& from, const ReferencePicture& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < from.pixels.size(); ++i) sum += relative_square(image, from, reference, i);
  return sum / double(from.pixels.size());
}

mc::Moments squares_of(const PictureSeries& s, const ReferencePicture& reference) {
  mc::Moments squares;
  for (const Image& image : s.images) squares.add(relmse(image, reference.image, reference));
  return squares;
}

// The number R of repetitions that gives the log error of these pictures a variance of 1 / (2 R).
std::uint32_t repetitions(const std::vector<mc::RmsError>& errors) {
  double most = 1e-6;
  for (const mc::RmsError& e : errors) most = std::max(most, mc::sqr(std::log(e.hi / e.rms) / 2));
  return static_cast<std::uint32_t>(std::clamp(1 / (2 * most), 2.0, 1e6));
}

/// Bias of the mean picture and noise of a single picture.
struct BiasAndNoise {
  double bias = 0, noise = 0; ///< relmse
  mc::Moments pixels;         ///< contribution of each pixel to the bias
};

// Estimates both without the picture `out`. The mean picture of R has 1 / R of the noise.
BiasAndNoise bias_and_noise_of(const PictureSeries& s, const ReferencePicture& reference, std::size_t out) {
  Image mean(reference.image.width, reference.image.height);
  const double count = double(s.images.size() - (out < s.images.size() ? 1 : 0));
  for (std::size_t r = 0; r < s.images.size(); ++r)
    for (std::size_t i = 0; r != out && i < mean.pixels.size(); ++i) mean.pixels[i] += s.images[r].pixels[i];
  for (render::Spectrum& p : mean.pixels) p /= render::Float(count);
  BiasAndNoise parts;
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    double own = 0;
    for (std::size_t r = 0; r < s.images.size(); ++r)
      if (r != out) own += relative_square(s.images[r], mean, reference, i) / (count - 1);
    parts.noise += own / double(mean.pixels.size());
    parts.pixels.add(relative_square(mean, reference.image, reference, i) - own / count);
  }
  parts.bias = parts.pixels.mean() - reference.noise;
  return parts;
}

} // namespace

double noise(const Image& image, const ReferencePicture& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Eigen::Array3d radiance = reference.image.pixels[i].cast<double>();
    sum += (image.variance[i].cast<double>() / (radiance.square() + reference.relmse_floor)).sum();
  }
  return sum / (3.0 * double(image.pixels.size()));
}

double relmse_floor_of(const Image& image) {
  double sum = 0;
  for (const render::Spectrum& p : image.pixels) sum += p.cast<double>().abs().sum();
  return relmse_floor_share * mc::sqr(sum / (3.0 * double(image.pixels.size())));
}

// The noise of the reference is part of the mean square and is subtracted. For points more even than independent ones
// this noise may be overestimated. An error that the reference alone may explain becomes a bound. Rare bright pictures
// make the mean of the squares uncertain, but it is not below the smallest square.
mc::RmsError error_of(const PictureSeries& s, const ReferencePicture& reference) {
  const mc::Moments squares = squares_of(s, reference);
  double least = squares.mean();
  for (const Image& image : s.images) least = std::min(least, relmse(image, reference.image, reference));
  const double half = squares.std_error() * mc::student_quantile(0.05, double(squares.count() - 1));
  std::vector<double> seconds = s.replicates.seconds;
  std::nth_element(seconds.begin(), seconds.begin() + std::ptrdiff_t(seconds.size() / 2), seconds.end());
  const auto root = [](double x) { return std::sqrt(std::max(x, 0.0)); };
  const double lo = std::max(squares.mean() - half, least), hi = squares.mean() + half;
  mc::RmsError e{s.spp, root(squares.mean() - reference.noise), root(lo - reference.noise), root(hi),
                 seconds[seconds.size() / 2]};
  e.is_bound = e.lo == 0;
  if (e.is_bound) e.rms = e.hi = std::max(root(hi + 4 * reference.noise), rounding_of_pixels);
  return e;
}

// The relative variance of a root is a quarter of the relative variance of its square.
int pictures_needed(const PictureSeries& s, const ReferencePicture& reference) {
  const mc::Moments squares = squares_of(s, reference);
  const double square = squares.mean() - reference.noise;
  const double needed = square > 0 ? squares.variance() / mc::sqr(square) / (4 * 0.01) : 0;
  return static_cast<int>(std::clamp(std::ceil(needed), double(first_pictures), double(most_pictures)));
}

void fit(ConvergenceCurve& curve) {
  std::vector<mc::RmsError> known;
  double logs = 0;
  for (const mc::RmsError& e : curve.errors) {
    if (e.is_bound) continue;
    known.push_back(e);
    logs += std::log(e.n);
  }
  if (known.size() < 3) return;
  curve.fit_center = std::exp(logs / double(known.size()));
  curve.power_law = mc::fit_power_law(known, repetitions(known));
}

// Light from rare paths may be missing in all pictures, which then contain no noise there. So a difference in only a
// few pixels is not reported as bias.
WorkAndBias bias_of(const PictureSeries& s, const ReferencePicture& reference, std::size_t methods) {
  const BiasAndNoise all = bias_and_noise_of(s, reference, s.images.size());
  mc::Moments biases, noises, seconds;
  for (std::size_t r = 0; r < s.images.size(); ++r) {
    const BiasAndNoise part = bias_and_noise_of(s, reference, r);
    biases.add(part.bias);
    noises.add(part.noise);
    seconds.add(s.replicates.seconds[r]);
  }
  const double dof = double(s.images.size() - 1);
  const double half =
      mc::student_quantile(0.05 / double(methods), dof) * std::hypot(biases.std_error() * dof, all.pixels.std_error());
  const auto root = [](double x) { return std::sqrt(std::max(x, 0.0)); };
  const auto relative = [](double error, double value) { return value > 0 ? mc::sqr(error / value) : 0.0; };
  return {{{root(all.bias), root(all.bias - half), root(all.bias + half)}, root(all.noise), s.spp, {}},
          std::max(all.noise, 0.0) * error_of(s, reference).seconds,
          relative(noises.std_error() * dof, all.noise) + relative(seconds.std_error(), seconds.mean()),
          dof};
}

// At the error e a method takes work / (e^2 - bias^2) seconds. A biased method pays above the error at which this
// equals the seconds of the best unbiased method.
void set_break_even_errors(std::vector<WorkAndBias>& all) {
  const WorkAndBias* best = nullptr;
  for (const WorkAndBias& one : all)
    if (!(one.bias.bias.lo > 0) && (!best || one.work < best->work)) best = &one;
  for (WorkAndBias& one : all) {
    const IntervalEstimate& bias = one.bias.bias;
    if (!(bias.lo > 0)) continue;
    const auto threshold = [](double square_root, double share) {
      return share < 1 ? square_root / std::sqrt(1 - share) : mc::infinity<double>;
    };
    const double share = best && one.work > 0 ? one.work / best->work : 0.0;
    double half = 0; // half width of the interval of the logarithm of the share
    if (best)
      half = mc::student_quantile(0.05 / double(all.size()), std::min(one.dof, best->dof)) *
             std::sqrt(one.variance + best->variance);
    const IntervalEstimate pays{threshold(bias.value, share), threshold(bias.lo, share * std::exp(-half)),
                                threshold(bias.hi, share * std::exp(half))};
    if (std::isfinite(pays.lo)) one.bias.break_even_error = pays;
  }
}

} // namespace carlo
