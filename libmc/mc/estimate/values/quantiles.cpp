#include <mc/core/error.h>
#include <mc/estimate/integrate/run.h>
#include <mc/estimate/values/quantiles.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc {

namespace {

// Sorted values of each replicate and of all replicates together.
struct ReplicateValues {
  std::vector<std::vector<double>> replicates;
  std::vector<double> all;

  // Confidence interval of the share of values at or below t.
  Estimate::Interval share(double t, double confidence) const {
    std::vector<double> shares;
    for (const std::vector<double>& r : replicates)
      shares.push_back(static_cast<double>(std::upper_bound(r.begin(), r.end(), t) - r.begin()) /
                       static_cast<double>(r.size()));
    const double inside[] = {0, 1}; // a share is the mean of values in {0, 1}
    SampledValues values;
    values.averaged.add(inside);
    detail::SpreadHistory history;
    return detail::interval(
        detail::mean_of_replicates(shares, static_cast<double>(replicates.front().size()), values, 1, history),
        confidence);
  }
};

// First value at which one end of the interval of the share is at least p. Both ends increase with t, up to random
// fluctuations.
std::vector<double>::const_iterator first_value(const ReplicateValues& sampled, double p, double confidence,
                                                double Estimate::Interval::*end) {
  return std::partition_point(sampled.all.begin(), sampled.all.end(),
                              [&](double t) { return sampled.share(t, confidence).*end < p; });
}

// The interval reaches from the first value with a share that may be p to the first value with a share of at least p.
Quantile quantile(const ReplicateValues& sampled, double p, double confidence) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto lo = first_value(sampled, p, confidence, &Estimate::Interval::hi);
  const auto hi = first_value(sampled, p, confidence, &Estimate::Interval::lo);
  const bool may_be_below = sampled.share(-infinity, confidence).hi >= p; // below all sampled values
  const auto rank = static_cast<std::size_t>(std::ceil(p * static_cast<double>(sampled.all.size())));
  const double value = sampled.all[std::clamp<std::size_t>(rank, 1, sampled.all.size()) - 1];
  return {p,
          value,
          {may_be_below ? -infinity : std::min(*lo, value), hi == sampled.all.end() ? infinity : std::max(*hi, value)}};
}

ReplicateValues sample_replicates(detail::Run& run, std::uint64_t points) try {
  ReplicateValues sampled;
  const std::uint32_t replicates = run.options().replicates;
  detail::Record record;
  run.evaluator.evaluate(run.sobol_sets(detail::Stream::quantiles, 0, 0, replicates), 0, points, {},
                         {.record = &record, .most_recorded = points * replicates});
  for (std::uint64_t r = 0; r < replicates; ++r) {
    const auto first = record.values.begin() + static_cast<std::ptrdiff_t>(r * points);
    sampled.replicates.emplace_back(first, first + static_cast<std::ptrdiff_t>(points));
    std::sort(sampled.replicates.back().begin(), sampled.replicates.back().end());
  }
  sampled.all = std::move(record.values);
  std::sort(sampled.all.begin(), sampled.all.end());
  return sampled;
} catch (const detail::Cancelled&) {
  throw Error("quantiles: cancelled");
}

} // namespace

std::vector<Quantile> quantiles(const std::function<double(std::span<const double>)>& f, int dim,
                                std::span<const double> probabilities, const QuantileOptions& o) {
  require(f != nullptr, "quantiles: the function is empty; it must be callable");
  require(dim >= 1, "quantiles: dimension {} must be at least 1", dim);
  require(!probabilities.empty(), "quantiles: no probabilities");
  for (const double p : probabilities) require(p > 0 && p < 1, "quantiles: probability {} must lie in (0, 1)", p);
  require(o.confidence > 0 && o.confidence < 1, "quantiles: confidence {} must lie in (0, 1)", o.confidence);
  require(o.replicates >= 2, "quantiles: {} replicates; at least 2 are needed for an interval", o.replicates);
  const std::uint64_t points = o.calls / o.replicates;
  require(points >= 2, "quantiles: {} calls for {} replicates; at least 2 for each are needed", o.calls, o.replicates);

  IntegrateOptions settings;
  settings.replicates = o.replicates;
  settings.seed = o.seed;
  settings.threads = o.threads;
  settings.cancel = o.cancel;
  detail::Run run{{{.one = &f}, 1, dim, settings}};
  const std::uint64_t most = (std::uint64_t{1} << 24) / (static_cast<std::uint64_t>(dim) + 2); // 128 MB
  require(o.calls <= most, "quantiles: {} calls; at most {} values can be kept", o.calls, most);
  const ReplicateValues sampled = sample_replicates(run, points);
  std::vector<Quantile> all;
  for (const double p : probabilities) all.push_back(quantile(sampled, p, o.confidence));
  return all;
}

} // namespace mc
