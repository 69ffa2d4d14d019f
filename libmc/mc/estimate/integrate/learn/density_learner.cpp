#include <mc/core/parallel.h>
#include <mc/estimate/integrate/learn/density_learner.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

namespace {
constexpr double small = 1e-3, large = 1e-2; // bounds of a variance per point, relative to the squared mean
constexpr double enough = 8;                 // number of points that must contribute to a variance
// the grid uses all points if this times the number of decisive points exceeds their number
constexpr double equal_factor = 12;
constexpr double fewest = 256; // minimum number of points for the grid
} // namespace

DensityLearner::DensityLearner(const IntegrationRun& run)
    : run_(run), dim_(static_cast<std::size_t>(run.dim)), density_{ImportanceGrid(run.dim)} {}

void DensityLearner::learn(const std::vector<Sums>& round) {
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
template <class F> void DensityLearner::for_each_point(F&& f) const {
  constexpr std::size_t chunk = 4096;
  parallel_for((size() + chunk - 1) / chunk, size() > 4 * chunk ? run_.options.threads : 1, [&](std::size_t c) {
    std::vector<double> scratch(dim_);
    for (std::size_t i = c * chunk; i < std::min(size(), (c + 1) * chunk); ++i) f(i, scratch);
  });
}

void DensityLearner::add_densities_of_round() {
  const std::size_t before = mixture_.size(), now = values_.size() / run_.primary_outputs();
  mixture_.resize(now);
  rounds_.push_back({static_cast<double>(now - before), density_});
  for_each_point([&](std::size_t i, std::span<double> scratch) {
    for (std::size_t r = i < before ? rounds_.size() - 1 : 0; r < rounds_.size(); ++r)
      mixture_[i] += rounds_[r].points * rounds_[r].density.density(point(i), scratch);
  });
}

void DensityLearner::measure() {
  const std::size_t outputs = run_.primary_outputs();
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
  // Gives outputs of different size equal weight.
  scale_.assign(outputs, 0);
  log_second_moment_ = 0;
  for (std::size_t k = 0; k < outputs; ++k) {
    if (const double size = largest[k] * std::sqrt(square[k]); std::isfinite(1 / size)) scale_[k] = 1 / size;
    if (mean[k] != 0)
      log_second_moment_ = std::max(log_second_moment_, std::log(std::max(square[k] / sqr(mean[k]), 1.0)));
  }
}

// Contribution of every point to the variance of an output for points from the mixture with density p, relative to the
// squared mean.
std::vector<double> DensityLearner::variance_contributions(std::size_t output, const AdaptedDensity& p) const {
  const std::size_t outputs = run_.primary_outputs();
  double largest = 0, mean = 0;
  for (std::size_t i = output; i < values_.size(); i += outputs) largest = std::max(largest, std::abs(values_[i]));
  for (std::size_t i = 0; i < size() && largest > 0; ++i) mean += values_[i * outputs + output] / largest / mixture_[i];
  std::vector<double> all(size());
  if (mean == 0) return all;
  for_each_point([&](std::size_t i, std::span<double> scratch) {
    const double x = values_[i * outputs + output] / largest / mean, here = p.density(point(i), scratch);
    all[i] = sqr(x - here) / (Proposal::uniform_share + (1 - Proposal::uniform_share) * here) / mixture_[i];
  });
  return all;
}

bool DensityLearner::fits(const AdaptedDensity& p) const {
  const double share = static_cast<double>(AxisProfile::most * run_.options.replicates) / static_cast<double>(size());
  for (std::size_t k = 0; k < run_.primary_outputs(); ++k) {
    double now = 0, squares = 0, later = 0;
    for (const double x : variance_contributions(k, p)) {
      now += x;
      squares += sqr(x);
    }
    for (const double x : variance_contributions(k, p.tree ? density_ : AdaptedDensity{density_.grid})) later += x;
    const bool few = sqr(now) < enough * squares / share;
    if ((now > small && few) || (now > large && later < 0.5 * now)) return false;
  }
  return true;
}

// The points in the coordinates of the grid. The value of a point is the root of the sum of squares of all outputs, or
// for a single output its signed value.
WeightedSamples DensityLearner::samples_in_grid_coordinates() const {
  const std::size_t outputs = run_.primary_outputs();
  WeightedSamples samples{run_.dim, points_, std::vector<double>(size()), std::vector<double>(size())};
  for_each_point([&](std::size_t i, std::span<double>) {
    const double of_grid = density_.grid.invert({samples.points.data() + i * dim_, dim_});
    samples.weights[i] = of_grid / mixture_[i];
    for (std::size_t k = 0; k < outputs; ++k) {
      const double x = values_[i * outputs + k] * scale_[k] / of_grid;
      samples.values[i] = outputs == 1 ? x : std::hypot(samples.values[i], x);
    }
  });
  return samples;
}

// Adapts the grid. Three rules keep it from following single points:
//   - If the values are widely spread, the few largest would decide everything. The grid then follows a root of the
//     integrand, and the remaining factor is less widely spread.
//   - If few points dominate the integral [Kish65], refine() gets a smaller number of points, because a density that
//     follows single points is far too low between them. The number is reduced by the square of the dominating share,
//     because the grid follows about the squared integrand, which even fewer points dominate.
//   - Even a handful of points determines a coarse density, so that the next round samples their region. Many points
//     dominate a singular integral although few dominate its square. The grid follows it as closely as possible,
//     because otherwise its tail would stay hidden.
void DensityLearner::adapt_grid() {
  const WeightedSamples samples = samples_in_grid_coordinates();
  const double exponent = std::min(2.0, std::sqrt(8 / std::max(log_second_moment_, 1e-3)));
  std::vector<double> power(dim_ * ImportanceGrid::bins);
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double value = std::abs(samples.values[i]), x = std::pow(value, exponent) * samples.weights[i];
    sum += value * samples.weights[i];
    squares += sqr(value * samples.weights[i]);
    for (std::size_t j = 0; j < dim_; ++j)
      power[j * ImportanceGrid::bins + static_cast<std::size_t>(samples.points[i * dim_ + j] * ImportanceGrid::bins)] +=
          x;
  }
  const double all = static_cast<double>(size()), decide = squares > 0 ? sqr(sum) / squares : all;
  const double effective_points = all * sqr(std::min(1.0, equal_factor * decide / all));
  density_.grid.refine(power, static_cast<std::uint64_t>(std::min(std::max(effective_points, fewest), all)));
}

void DensityLearner::adapt_tree() { density_.tree = importance_tree(samples_in_grid_coordinates()); }

} // namespace mc::detail
