#include <mc/check/fit/interior_density.h>
#include <mc/check/fit/tests/fit_test.h>
#include <mc/check/fit/tests/spectrum.h>
#include <mc/core/types.h>
#include <mc/random/hash.h>
#include <mc/random/pcg.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc {
namespace {

constexpr int number_of_grids = 5;                    // grids with 1, 2, 4, ... bins of the finest joined along an axis
constexpr PerAxis<std::size_t> finest{4096, 256, 32}; // bins along an axis, by the number of axes
constexpr std::size_t points_of_bin = 4;              // where the density is evaluated
constexpr double resolved = 0.05;   // variance of an expected count by that of the observed one, at most
constexpr double cap_over_seen = 4; // largest density that counts, by the largest at the points of a bin

using PointDensities = std::span<const double, points_of_bin>;

std::size_t number_of_bins(std::size_t size, int dim) {
  std::size_t count = 1;
  for (int d = 0; d < dim; ++d) count *= size;
  return count;
}

// Bins along an axis of the finest grid: at most as many bins as samples, evaluations of the density for a twelfth of
// those allowed, and so wide that a lattice of rounding steps changes the counts by less than their noise.
std::size_t finest_size(const FitSetup& setup) {
  const SubjectOptions& options = setup.options;
  const int dim = setup.subject.dim;
  const double n = static_cast<double>(options.samples), noise = 1 / std::sqrt(n);
  const double most_bins =
      std::min(n, static_cast<double>(options.max_evaluations) / static_cast<double>(12 * points_of_bin));
  const double step = mean_step(setup.subject, setup.pilot, noise);
  std::size_t size = finest[static_cast<std::size_t>(dim - 1)];
  while (size > 1 &&
         (static_cast<double>(number_of_bins(size, dim)) > most_bins || step * static_cast<double>(size) > noise))
    size /= 2;
  return size;
}

// A bin of the finest grid.
struct Bin {
  double expected = 0, noise = 0; // share of the samples; variance of the expected count, by that of the observed one
  double cap = 0;                 // density above which a sample counts less: its mass hides between the points
  double observed = 0;            // sum of the samples' weights
  bool is_resolved = true;
};

// Counts on grids of equal bins of the chart. The expected counts come from two pairs of points in each bin. Bins in
// which these do not resolve the density do not count, nor do their neighbours; a density that varies within most bins
// has no grids. Mass between the points counts little, as in StratifiedReference.
struct GridsInProgress {
  int dim;
  double share;
  std::size_t size; // bins of the finest grid along an axis
  std::vector<Bin> bins = {};

  std::size_t index(const Subject::Coordinates& v) const {
    std::size_t at = 0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) {
      const double scaled = std::clamp(v[d] * static_cast<double>(size), 0.0, static_cast<double>(size - 1));
      at = at * size + static_cast<std::size_t>(static_cast<std::int64_t>(scaled));
    }
    return at;
  }
  UnitBox box(std::size_t bin) const {
    UnitBox b;
    for (auto d = static_cast<std::size_t>(dim); d-- > 0; bin /= size) {
      b.lo[d] = static_cast<double>(bin % size) / static_cast<double>(size);
      b.hi[d] = static_cast<double>(bin % size + 1) / static_cast<double>(size);
    }
    return b;
  }

  void prepare(const FitSetup& setup) {
    const std::size_t count = number_of_bins(size, dim);
    bins.resize(count);
    Pcg random(hash(setup.options.seed, 6));
    const double n = static_cast<double>(setup.options.samples);
    AntitheticPoints points;
    std::vector<double> densities;
    constexpr std::size_t together = 512;
    for (std::size_t first = 0; first < count; first += together) {
      points.points.clear();
      points.volumes.clear();
      const std::size_t last = std::min(first + together, count);
      for (std::size_t i = first; i < last; ++i) points.add(box(i), dim, {}, 1, random);
      densities.resize(points.points.size());
      interior_densities(setup.subject, points.points, densities);
      for (std::size_t i = first; i < last; ++i)
        set(bins[i], points.volumes[i - first], PointDensities(&densities[points_of_bin * (i - first)], points_of_bin),
            n);
    }
    if (is_textured()) return bins.clear();
    leave_out_edges();
  }
  // Whether the points do not resolve the density as a whole. Single bins may then seem resolved by chance.
  bool is_textured() const {
    constexpr double most_of_bin = 10;
    double sum = 0;
    for (const Bin& bin : bins) sum += std::min(bin.noise, most_of_bin);
    return !(sum <= resolved * static_cast<double>(bins.size()));
  }
  static void set(Bin& bin, double volume, PointDensities density, double n) {
    EstimatedMass mass;
    mass.add_part(volume, density);
    bin.expected = mass.value;
    bin.cap = cap_over_seen * *std::max_element(density.begin(), density.end());
    bin.noise = mass.value > 0 ? n * mass.variance / mass.value : 0;
    bin.is_resolved = bin.noise <= resolved && std::isfinite(mass.value) && mass.value >= 0;
  }
  // Calls visit(bin, next) for all pairs of bins that are next to each other along an axis.
  template <class Visit> void for_pairs(Visit visit) {
    std::size_t stride = 1;
    for (int d = 0; d < dim; ++d, stride *= size)
      for (std::size_t i = 0; i < bins.size(); ++i)
        if (i / stride % size + 1 < size) visit(i, i + stride);
  }
  // Leaves out steps of the density between bins, and the bins next to all those that are left out: an edge may pass
  // between all points of a bin.
  void leave_out_edges() {
    constexpr double step = 2;
    std::vector<bool> out(bins.size());
    const auto leave_out = [&] {
      for (std::size_t i = 0; i < bins.size(); ++i) bins[i].is_resolved = bins[i].is_resolved && !out[i];
    };
    for_pairs([&](std::size_t a, std::size_t b) {
      const auto [less, more] = std::minmax(bins[a].expected, bins[b].expected);
      if (more > step * less) out[a] = out[b] = true;
    });
    leave_out();
    for_pairs([&](std::size_t a, std::size_t b) {
      if (!bins[a].is_resolved) out[b] = true;
      if (!bins[b].is_resolved) out[a] = true;
    });
    leave_out();
  }

  void count(const SampleBlock& block) {
    if (bins.empty()) return;
    for (std::size_t i = 0; i < block.points.size(); ++i) {
      Bin& bin = bins[index(block.points[i])];
      bin.observed += block.densities[i] > bin.cap ? bin.cap / block.densities[i] : 1;
    }
  }

  // The bin that contains a bin of the finest grid, where 2^halving bins are one along each axis.
  std::size_t joined(std::size_t bin, int halving) const {
    std::size_t at = 0, stride = 1;
    for (int d = 0; d < dim; ++d, bin /= size, stride *= size >> halving) at += (bin % size >> halving) * stride;
    return at;
  }
  // Chi-square over the bins of a grid, given their sum. Bins that expect less than one sample are pooled in their
  // order. Counts of Poisson variables have the variance 2 + 1 / expected of a term of chi-square [Haldane37]; a scaled
  // chi-square matches the mean and the variance of the sum.
  std::optional<Check> test(int halving, double share_of_grid, double alpha) const {
    const std::size_t side = size >> halving;
    if (side < 2) return {};
    struct Sum {
      double expected = 0, noise = 0, observed = 0;
    };
    std::vector<Sum> sums(number_of_bins(side, dim));
    double expected = 0, observed = 0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      const Bin& bin = bins[i];
      if (!bin.is_resolved || !(bin.expected > 0)) continue;
      Sum& sum = sums[joined(i, halving)];
      sum.expected += bin.expected;
      sum.noise += bin.noise * bin.expected;
      sum.observed += bin.observed;
      expected += bin.expected;
      observed += bin.observed;
    }
    const double scale = observed / expected;
    double statistic = 0, terms = 0, variance = 0;
    Sum next;
    for (const Sum& sum : sums) {
      next.expected += scale * sum.expected;
      next.noise += scale * sum.noise;
      next.observed += sum.observed;
      if (!(next.expected >= 1)) continue;
      statistic += sqr(next.observed - next.expected) / (next.expected + next.noise);
      variance += 2 + 1 / next.expected;
      terms += 1;
      next = {};
    }
    if (!(terms >= 8)) return {};
    const double mean = terms - 1, ratio = 2 * mean / variance;
    return statistical_check(
        fmt::format("grid of {}", fmt::join(std::vector<std::size_t>(static_cast<std::size_t>(dim), side), " x ")),
        chi_square_tail(ratio * statistic, ratio * mean), statistic, share_of_grid, alpha, Fault::local,
        fmt::format("chi-square over {:.0f} bins is {:.4g}, {:.0f} expected", terms, statistic, mean));
  }
  Findings judge(const FitCounts& counts) const {
    Findings found;
    for (int halving = number_of_grids - 1; halving >= 0 && !bins.empty(); --halving)
      if (auto c = test(halving, share / number_of_grids, counts.setup.options.alpha))
        found.checks.push_back(std::move(*c));
    return found;
  }
};

} // namespace

// Chi-square on grids of equal bins, from coarse to fine. Unlike the cells of the tree, the bins are small wherever the
// density is low.
FitTest grid_test(const FitSetup& setup, double share) {
  GridsInProgress grids{setup.subject.dim, share, finest_size(setup)};
  if (grids.size > 1) grids.prepare(setup);
  return make_fit_test(std::move(grids));
}

} // namespace mc
