#include <mc/core/parallel.h>
#include <mc/estimate/integrate/learn/learner.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

namespace {
constexpr double small = 1e-3, large = 1e-2; // variances of a point over the squared mean
constexpr double enough = 8;                 // points that a variance must be made of
constexpr double of_equal = 12;              // times as many points as decide, and the grid is told of all
constexpr double fewest = 256;               // points that the grid is told of at least
} // namespace

Learner::Learner(const Run& run)
    : run_(run), dim_(static_cast<std::size_t>(run.dim)), density_{ImportanceGrid(run.dim)} {}

void Learner::learn(const std::vector<Sums>& round) {
  for (const Sums& s : round) {
    points_.insert(points_.end(), s.points.begin(), s.points.end());
    values_.insert(values_.end(), s.values.begin(), s.values.end());
  }
  add_densities_of_round();
  measure();
  adapt_grid();
  if (rounds_.size() > 1) adapt_tree();
}

// Calls f(i, scratch) for every point, in chunks.
template <class F> void Learner::each(F&& f) const {
  constexpr std::size_t chunk = 4096;
  parallel_for((size() + chunk - 1) / chunk, size() > 4 * chunk ? run_.o.threads : 1, [&](std::size_t c) {
    std::vector<double> scratch(dim_);
    for (std::size_t i = c * chunk; i < std::min(size(), (c + 1) * chunk); ++i) f(i, scratch);
  });
}

void Learner::add_densities_of_round() {
  const std::size_t before = mixture_.size(), now = values_.size() / run_.leading();
  mixture_.resize(now);
  rounds_.push_back({static_cast<double>(now - before), density_});
  each([&](std::size_t i, std::span<double> scratch) {
    for (std::size_t r = i < before ? rounds_.size() - 1 : 0; r < rounds_.size(); ++r)
      mixture_[i] += rounds_[r].points * rounds_[r].density.density(point(i), scratch);
  });
}

void Learner::measure() {
  const std::size_t outputs = run_.leading();
  std::vector<double> largest(outputs), mean(outputs), square(outputs), scratch(dim_);
  for (std::size_t i = 0; i < values_.size(); ++i)
    largest[i % outputs] = std::max(largest[i % outputs], std::abs(values_[i]));
  for (std::size_t i = 0; i < size(); ++i) {
    const double p = density_.density(point(i), scratch);
    for (std::size_t k = 0; k < outputs; ++k) {
      const double x = largest[k] > 0 ? values_[i * outputs + k] / largest[k] : 0;
      mean[k] += x / mixture_[i];
      square[k] += x * x / (p * mixture_[i]);
    }
  }
  // Outputs of different size count alike.
  scale_.assign(outputs, 0);
  width_ = 0;
  for (std::size_t k = 0; k < outputs; ++k) {
    if (const double size = largest[k] * std::sqrt(square[k]); std::isfinite(1 / size)) scale_[k] = 1 / size;
    if (mean[k] != 0) width_ = std::max(width_, std::log(std::max(square[k] / sqr(mean[k]), 1.0)));
  }
}

// For every point that was seen, its part of the variance of an output whose points are drawn from the mixture with the
// density p, over the squared mean.
std::vector<double> Learner::off(std::size_t output, const AdaptedDensity& p) const {
  const std::size_t outputs = run_.leading();
  double largest = 0, mean = 0;
  for (std::size_t i = output; i < values_.size(); i += outputs) largest = std::max(largest, std::abs(values_[i]));
  for (std::size_t i = 0; i < size() && largest > 0; ++i) mean += values_[i * outputs + output] / largest / mixture_[i];
  std::vector<double> all(size());
  if (mean == 0) return all;
  each([&](std::size_t i, std::span<double> scratch) {
    const double x = values_[i * outputs + output] / largest / mean, here = p.density(point(i), scratch);
    all[i] = sqr(x - here) / (Proposal::uniform_share + (1 - Proposal::uniform_share) * here) / mixture_[i];
  });
  return all;
}

bool Learner::fits(const AdaptedDensity& p) const {
  const double share = static_cast<double>(AxisProfile::most * run_.o.replicates) / static_cast<double>(size());
  for (std::size_t k = 0; k < run_.leading(); ++k) {
    double now = 0, squares = 0, later = 0;
    for (const double x : off(k, p)) {
      now += x;
      squares += sqr(x);
    }
    for (const double x : off(k, p.tree ? density_ : AdaptedDensity{density_.grid})) later += x;
    const bool few = sqr(now) < enough * squares / share;
    if ((now > small && few) || (now > large && later < 0.5 * now)) return false;
  }
  return true;
}

// The points in the coordinates of the grid. The value of each is the root of the squares of all outputs, or, where
// there is one output only, that output with its sign.
WeightedValues Learner::within_grid() const {
  const std::size_t outputs = run_.leading();
  WeightedValues seen{run_.dim, points_, std::vector<double>(size()), std::vector<double>(size())};
  each([&](std::size_t i, std::span<double>) {
    const double of_grid = density_.grid.unmap({seen.points.data() + i * dim_, dim_});
    seen.weights[i] = of_grid / mixture_[i];
    for (std::size_t k = 0; k < outputs; ++k) {
      const double x = values_[i * outputs + k] * scale_[k] / of_grid;
      seen.values[i] = outputs == 1 ? x : std::hypot(seen.values[i], x);
    }
  });
  return seen;
}

// Where the values are spread widely, a few of the largest would decide everything. Then the grid follows a root of the
// integrand first, and what is left to learn is spread less widely. And where few of the points decide the integral
// [Kish65], most having met next to nothing, the grid is told of fewer points: a density that follows single ones is
// far too low where none fell. By the square of that share, since the grid follows about the square of the integrand,
// of which fewer still decide. But what even a handful found is followed, if coarsely, so that the next round looks
// there. Of a singular integrand a good share decides, although a few points hold its square: it is followed as far as
// it goes, else its tail would stay hidden.
void Learner::adapt_grid() {
  const WeightedValues seen = within_grid();
  const double exponent = std::min(2.0, std::sqrt(8 / std::max(width_, 1e-3)));
  std::vector<double> power(dim_ * ImportanceGrid::bins);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double value = std::abs(seen.values[i]), x = std::pow(value, exponent) * seen.weights[i];
    sum += value * seen.weights[i];
    squares += sqr(value * seen.weights[i]);
    for (std::size_t j = 0; j < dim_; ++j)
      power[j * ImportanceGrid::bins + static_cast<std::size_t>(seen.points[i * dim_ + j] * ImportanceGrid::bins)] += x;
  }
  const double all = static_cast<double>(size()), decide = squares > 0 ? sqr(sum) / squares : all;
  const double told = all * sqr(std::min(1.0, of_equal * decide / all));
  density_.grid.refine(power, static_cast<std::uint64_t>(std::min(std::max(told, fewest), all)));
}

void Learner::adapt_tree() { density_.tree = importance_tree(within_grid()); }

} // namespace mc::detail
