#include <mc/core/types.h>
#include <mc/estimate/integrate/learn_density.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

namespace {
constexpr double enough_points = 32; // effective points that determine a grid

// Squares of the values in units of their weighted mean square, averaged over the primary outputs.
std::vector<double> squares(const Samples& s) {
  std::vector<double> all(s.size());
  for (std::size_t k = 0; k < s.primary; ++k) {
    const double largest = s.largest(k);
    double mean = 0, used = 0;
    if (!(largest > 0)) continue;
    s.each([&](std::size_t i) {
      mean += s.record.weights[i] * sqr(s.value(i, k) / largest);
      used += 1;
    });
    if (mean > 0) s.each([&](std::size_t i) { all[i] += sqr(s.value(i, k) / largest) * (used / mean); });
  }
  return all;
}

// Effective number of the points [Kish65] if each has its weight times a value.
double effective_number(const Samples& s, std::span<const double> values) {
  double sum = 0, sum_of_squares = 0;
  s.each([&](std::size_t i) {
    const double share = s.record.weights[i] * values[i];
    sum += share;
    sum_of_squares += sqr(share);
  });
  return sum_of_squares > 0 ? sqr(sum) / sum_of_squares : 0;
}

// Values of the largest power 1, 1/2, 1/4 or 1/8 that enough points determine: a density that follows few points misses
// what lies between them, and one that follows a root of the function lets the next points determine more.
std::vector<double> tempered(std::vector<double> values, const Samples& s) {
  for (int i = 0; i < 3 && effective_number(s, values) < enough_points; ++i)
    for (double& x : values) x = std::sqrt(x);
  return values;
}

ImportanceGrid refined(ImportanceGrid grid, const Samples& s, std::span<const double> squares) {
  constexpr std::size_t bins = ImportanceGrid::bins;
  const auto d = static_cast<std::size_t>(s.dim);
  std::vector<double> power(d * bins), x(d);
  double sum = 0, sum_of_squares = 0;
  s.each([&](std::size_t i) {
    if (squares[i] == 0) return;
    std::ranges::copy(s.point(i), x.begin());
    const double share = s.record.weights[i] * squares[i] / grid.invert(x);
    sum += share;
    sum_of_squares += share * share;
    for (std::size_t a = 0; a < d; ++a) power[a * bins + static_cast<std::size_t>(x[a] * bins)] += share;
  });
  if (sum > 0) grid.refine(power, sum * sum / sum_of_squares);
  return grid;
}

BoxTree tree_within(const ImportanceGrid& grid, const Samples& s, std::span<const double> squares) {
  const auto d = static_cast<std::size_t>(s.dim);
  WeightedSamples in_grid{s.dim, {}, {}, {}};
  std::vector<double> x(d);
  s.each([&](std::size_t i) {
    std::ranges::copy(s.point(i), x.begin());
    const double density = grid.invert(x);
    in_grid.points.insert(in_grid.points.end(), x.begin(), x.end());
    in_grid.values.push_back(std::sqrt(squares[i]) / density);
    in_grid.weights.push_back(s.record.weights[i] * density);
  });
  for (double& w : in_grid.weights) w /= static_cast<double>(in_grid.size());
  return importance_tree(in_grid);
}
} // namespace

void MixtureRecord::add(const Record& record, const Proposal& proposal, int dim) {
  const auto d = static_cast<std::size_t>(dim);
  const std::size_t count = record.weights.size();
  if (densities_.size() + count > most) *this = {};
  const std::size_t before = densities_.size();
  all_.points.insert(all_.points.end(), record.points.begin(), record.points.end());
  all_.values.insert(all_.values.end(), record.values.begin(), record.values.end());
  sources_.push_back({proposal, static_cast<double>(count)});
  densities_.resize(before + count);
  std::vector<double> scratch(d);
  for (std::size_t i = 0; i < densities_.size(); ++i) {
    const std::span<const double> x = std::span(all_.points).subspan(i * d, d);
    for (const Source& s : i < before ? std::span(sources_).last(1) : std::span(sources_))
      densities_[i] += s.count * s.proposal.density_at(x, scratch);
  }
  all_.weights.resize(densities_.size());
  for (std::size_t i = 0; i < densities_.size(); ++i)
    all_.weights[i] = static_cast<double>(densities_.size()) / densities_[i];
}

AdaptedDensity adapted(const AdaptedDensity& from, const Samples& samples, bool tree) {
  const std::vector<double> of = squares(samples);
  AdaptedDensity next{refined(from.grid, samples, tempered(of, samples))};
  if (tree) next.tree = tree_within(next.grid, samples, of);
  return next;
}

std::vector<double> variances(const Proposal& proposal, const Samples& s) {
  std::vector<double> densities, scratch(static_cast<std::size_t>(s.dim)), all;
  if (proposal.density)
    s.each([&](std::size_t i) { densities.push_back(proposal.density->density(s.point(i), scratch)); });
  for (std::size_t k = 0; k < s.primary; ++k) {
    const double largest = s.largest(k);
    const double c = proposal.control_coefficients.empty() ? 0 : proposal.control_coefficients[k] / largest;
    double mean = 0, square = 0;
    std::size_t used = 0;
    if (largest > 0)
      s.each([&](std::size_t i) {
        // The mean of g = (f - c p) / q, and of its square, under q.
        double f = s.value(i, k) / largest, q = 1;
        if (proposal.density) {
          constexpr double share = Proposal::uniform_share;
          const double p = std::min(densities[used], 1e300);
          q = (1 - share) * p + share;
          f -= c * p;
        }
        const double w = s.record.weights[i];
        mean += w * f;
        square += w * f * f / q;
        ++used;
      });
    const double n = static_cast<double>(std::max<std::size_t>(used, 1));
    all.push_back(std::max(square / n - sqr(mean / n), 0.0) * sqr(largest));
  }
  return all;
}

} // namespace mc::detail
