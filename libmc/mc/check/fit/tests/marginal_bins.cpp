#include <mc/check/fit/tests/marginal_bins.h>

#include <mc/check/fit/tests/fit_test.h>

#include <mc/stats/binomial.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mc {
namespace {

constexpr std::size_t max_bins = 2048, max_ranges = 64, max_integrated = 4;
constexpr int halvings = 6; // number of halvings of the bins at both ends

} // namespace

MarginalBins::MarginalBins(const Pilot& pilot, int dim) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) {
    const std::vector<double>& sorted = pilot.sorted[d];
    AxisBins axis;
    axis.index = d;
    const std::size_t count = std::clamp<std::size_t>(sorted.size() / 32, 1, max_bins);
    for (std::size_t k = 1; k < count; ++k) axis.ends.push_back(sorted[k * sorted.size() / count]);
    if (!axis.ends.empty()) {
      const double first = axis.ends.front(), last = 1 - axis.ends.back();
      for (int k = 1; k <= halvings; ++k) {
        axis.ends.push_back(std::ldexp(first, -k));
        axis.ends.push_back(1 - std::ldexp(last, -k));
      }
    }
    std::sort(axis.ends.begin(), axis.ends.end());
    axis.ends.erase(std::unique(axis.ends.begin(), axis.ends.end()), axis.ends.end());
    axis.bins.resize(axis.ends.size() + 1);
    for (std::size_t k = 0; k <= AxisBins::buckets; ++k) {
      const double v = static_cast<double>(k) / static_cast<double>(AxisBins::buckets);
      axis.guide.push_back(
          static_cast<std::uint32_t>(std::upper_bound(axis.ends.begin(), axis.ends.end(), v) - axis.ends.begin()));
    }
    sort_points(pilot, axis);
    axes_.push_back(std::move(axis));
  }
}

void MarginalBins::sort_points(const Pilot& pilot, AxisBins& axis) {
  std::vector<std::uint32_t> bin;
  bin.reserve(pilot.points.size());
  axis.first_points.resize(axis.bins.size() + 1);
  for (const Subject::Coordinates& v : pilot.points) {
    bin.push_back(static_cast<std::uint32_t>(axis.find(v[axis.index])));
    ++axis.first_points[bin.back() + 1];
  }
  std::partial_sum(axis.first_points.begin(), axis.first_points.end(), axis.first_points.begin());
  std::vector<std::uint32_t> next = axis.first_points;
  axis.points.resize(pilot.points.size());
  for (std::size_t i = 0; i < bin.size(); ++i) axis.points[next[bin[i]]++] = static_cast<std::uint32_t>(i);
}

IntervalQuery MarginalBins::interval_query(const BinRange& range) const {
  constexpr std::size_t least = 64;
  const AxisBins& axis = axes_[range.axis];
  std::size_t first = range.first, last = range.last;
  const auto count = [&] { return axis.first_points[last] - axis.first_points[first]; };
  while (count() < std::min(least, axis.points.size())) {
    if (first > 0) --first;
    if (last < axis.bins.size()) ++last;
  }
  return {range.axis, range.lo,
          range.hi,   {axis.points.begin() + axis.first_points[first], axis.points.begin() + axis.first_points[last]},
          0,          false};
}

bool MarginalBins::is_rounded(const Subject& s, const Pilot& pilot, const BinRange& range) const {
  double step = 0;
  for (const std::uint32_t i : pilot.nearest(range.axis, 0.5 * (range.lo + range.hi), 16))
    step = std::max(step, rounding_step(s, pilot.points[i], range.axis));
  if (step * min_resolved_steps > range.hi - range.lo) return true;
  const AxisBins& axis = axes_[range.axis];
  const auto samples_per_length = [&](std::size_t i) {
    const double lo = i > 0 ? axis.ends[i - 1] : 0.0, hi = i < axis.ends.size() ? axis.ends[i] : 1.0;
    return axis.bins[i].observed / (hi - lo);
  };
  // A bin of few samples may border on a peak, and one rounding step then moves more samples than the bin contains.
  double ends = 2 * range.compared.mean / (range.hi - range.lo);
  if (range.first > 0) ends = std::max(ends, samples_per_length(range.first - 1) + samples_per_length(range.first));
  if (range.last < axis.bins.size())
    ends = std::max(ends, samples_per_length(range.last - 1) + samples_per_length(range.last));
  return step * ends > std::sqrt(range.compared.mean);
}

std::vector<MarginalBins::BinRange> MarginalBins::farthest_ranges(double& family) const {
  std::vector<BinRange> ranges, ends;
  for (const AxisBins& axis : axes_) {
    WeightedCounts all;
    for (const WeightedCounts& bin : axis.bins) all.join(bin);
    if (!(all.observed > 0 && all.expected > 0)) continue;
    const double scale = all.observed / all.expected;
    const std::size_t size = axis.bins.size();
    for (std::size_t length = 1; 2 * length <= size; length *= 2)
      for (std::size_t lo = 0; lo + length <= size; lo += std::max<std::size_t>(length / 2, 1)) {
        BinRange range{axis.index,
                       lo,
                       lo + length,
                       lo > 0 ? axis.ends[lo - 1] : 0.0,
                       lo + length < size ? axis.ends[lo + length - 1] : 1.0,
                       {},
                       {}};
        for (std::size_t i = lo; i < lo + length; ++i) range.counts.join(axis.bins[i]);
        range.compared = compare(range.counts, scale);
        range.expected = range.compared.expected;
        family += 1;
        // The noise of the random points may hide errors in the thin bins at the ends.
        if (length <= 8 && (lo == 0 || lo + length == size)) ends.push_back(range);
        else if (std::abs(range.compared.z()) >= 2) ranges.push_back(range);
      }
  }
  std::sort(ranges.begin(), ranges.end(),
            [](const BinRange& a, const BinRange& b) { return std::abs(a.compared.z()) > std::abs(b.compared.z()); });
  if (ranges.size() > max_ranges) ranges.resize(max_ranges);
  ranges.insert(ranges.end(), ends.begin(), ends.end());
  return ranges;
}

// Computes the p-value of a run's count against an integral of its own, with four standard deviations conceded. Uses
// the random points if samples have weights other than 1, or if the points are more accurate.
void MarginalBins::BinRange::compute_p(const Subject& s, const Pilot& pilot, IntervalQuery query, double n, double mass,
                                       Effort effort) {
  p = compared.p();
  expected = compared.expected;
  if (counts.observed_squares != counts.observed) return;
  query.mass = mass * counts.observed / n;
  const EstimatedMass own = interval_mass(s, pilot, query, 1, effort);
  const double integrated = n * own.value / mass, error = n * std::sqrt(own.worst_case_variance()) / mass;
  const double error_of_points = std::sqrt(compared.point_variance * std::max(compared.observed, compared.expected));
  // An integral that is 0, or that contradicts the random points, missed the mass of the run.
  const double off = std::abs(integrated - compared.expected);
  if (!(own.value > 0 && error <= error_of_points && off <= 4 * error + 3 * error_of_points)) return;
  expected = integrated;
  const double slack = 4 * error, excess = counts.observed - expected;
  const double conceded =
      excess > 0 ? std::min(expected + slack, counts.observed) : std::max(expected - slack, counts.observed);
  p = binomial_tail(counts.observed, n, std::min(conceded / n, 1.0));
}

Check MarginalBins::test(const Subject& s, const Pilot& pilot, double n, double mass, double share,
                         double alpha) const {
  Check c{"marginal bins", Verdict::pass, 1.0, share, 0, 0, Fault::local, {}};
  double least = 1, family = 0;
  std::vector<BinRange> ranges = farthest_ranges(family);
  for (BinRange& range : ranges) range.compute_p(s, pilot, interval_query(range), n, mass, Effort::quick);
  std::stable_sort(ranges.begin(), ranges.end(), [](const BinRange& a, const BinRange& b) { return a.p < b.p; });
  std::size_t integrated = 0;
  for (BinRange& range : ranges) {
    if (integrated == max_integrated) break;
    if (is_rounded(s, pilot, range)) continue;
    range.compute_p(s, pilot, interval_query(range), n, mass, Effort::full);
    ++integrated;
    if (range.p >= least) continue;
    least = range.p;
    c.statistic = range.compared.z();
    c.detail = fmt::format("{} contains {:.0f} samples, {:.1f} expected",
                           describe_interval(s, range.axis, range.lo, range.hi), range.counts.observed, range.expected);
  }
  c.p = sidak(least, family);
  if (*c.p <= sidak_level(alpha, share)) c.verdict = Verdict::fail;
  else c.detail.clear();
  return c;
}

namespace {

struct MarginalBinsInProgress {
  MarginalBins bins;
  double share;

  void expect(const ReferenceBlock& block) {
    for (std::size_t i = 0; i < block.points.size(); ++i)
      bins.add_expected(block.points[i].v, block.points[i].share, block.weights[i]);
  }
  void count(const SampleBlock& block) {
    for (std::size_t i = 0; i < block.points.size(); ++i)
      bins.add_sample(block.points[i], block.weights[i], block.shares[i]);
  }
  Findings judge(const FitCounts& counts) const {
    const Subject& s = counts.setup.subject;
    const double points = std::max(counts.mass.value - std::accumulate(s.atoms.begin(), s.atoms.end(), 0.0), 1e-300);
    return {{bins.test(s, counts.setup.pilot, counts.weights.points, points, share, counts.setup.options.alpha)}};
  }
};

} // namespace

FitTest marginal_bins_test(const FitSetup& setup, double share) {
  return make_fit_test(MarginalBinsInProgress{MarginalBins(setup.pilot, setup.subject.dim), share});
}

} // namespace mc
