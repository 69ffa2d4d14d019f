#include <mc/core/error.h>
#include <mc/estimate/integrate/mean.h>
#include <mc/estimate/integrate/run.h>
#include <mc/estimate/values/quantiles.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc {

namespace {

// The values of all replicates, each sorted, and all together.
struct Seen {
  std::vector<std::vector<double>> replicates;
  std::vector<double> all;

  // The interval of the share of values at or below t.
  Estimate::Interval share(double t, double confidence) const {
    std::vector<double> shares;
    for (const std::vector<double>& r : replicates)
      shares.push_back(static_cast<double>(std::upper_bound(r.begin(), r.end(), t) - r.begin()) /
                       static_cast<double>(r.size()));
    const double inside[] = {0, 1}; // of the values whose mean a share is
    detail::Seen sizes;
    sizes.values.add(inside);
    detail::Evidence evidence;
    return detail::interval(detail::replicated(shares, static_cast<double>(replicates.front().size()), sizes, evidence),
                            confidence);
  }
};

// The first value at which one end of the interval of the share is p or more. Both ends grow with t but for chance.
std::vector<double>::const_iterator first_value(const Seen& seen, double p, double confidence,
                                                double Estimate::Interval::*end) {
  return std::partition_point(seen.all.begin(), seen.all.end(),
                              [&](double t) { return seen.share(t, confidence).*end < p; });
}

// Between the first value whose share may be p, and the first whose share is at least that.
Quantile quantile(const Seen& seen, double p, double confidence) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto lo = first_value(seen, p, confidence, &Estimate::Interval::hi);
  const auto hi = first_value(seen, p, confidence, &Estimate::Interval::lo);
  const bool may_be_below = seen.share(-infinity, confidence).hi >= p; // of all that was seen
  const auto rank = static_cast<std::size_t>(std::ceil(p * static_cast<double>(seen.all.size())));
  const double value = seen.all[std::clamp<std::size_t>(rank, 1, seen.all.size()) - 1];
  return {p,
          value,
          {may_be_below ? -infinity : std::min(*lo, value), hi == seen.all.end() ? infinity : std::max(*hi, value)}};
}

Seen seen_by(detail::Run& run, std::uint64_t points) try {
  Seen seen;
  for (detail::Sums& s :
       run.evaluate_all(run.sobol_sets(1, 0, run.o.replicates), 0, points, {}, detail::Keep::points)) {
    std::sort(s.values.begin(), s.values.end());
    seen.all.insert(seen.all.end(), s.values.begin(), s.values.end());
    seen.replicates.push_back(std::move(s.values));
  }
  std::sort(seen.all.begin(), seen.all.end());
  return seen;
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
  detail::Run run{{.one = &f}, 1, dim, settings};
  require(o.calls <= run.recordable(), "quantiles: {} calls; at most {} values can be kept", o.calls, run.recordable());
  const Seen seen = seen_by(run, points);
  std::vector<Quantile> all;
  for (const double p : probabilities) all.push_back(quantile(seen, p, o.confidence));
  return all;
}

} // namespace mc
