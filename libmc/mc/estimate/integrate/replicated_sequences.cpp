#include <mc/estimate/integrate/replicated_sequences.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc::detail {

namespace {
constexpr std::uint64_t uniform_stream_offset = 1000; // added to the stream_id for the uniform part

// Logarithm of the ratio of the variances of two errors, which may be 0.
double log_squared_ratio(double a, double b) {
  constexpr double least = std::numeric_limits<double>::min();
  return 2 * std::log((a + least) / (b + least));
}

// Evaluates points [from, to) of sets [first, last) of the stream and adds their sums. Creates missing sets.
void add(IntegrationRun& run, std::uint64_t stream_id, std::uint32_t first, std::uint32_t last, std::uint64_t from,
         std::uint64_t to, const Proposal& proposal, bool record, std::vector<PointSet>& sets,
         std::vector<Sums>& sums) {
  if (sets.size() < last) {
    const std::vector<PointSet> more = run.sobol_sets(stream_id, static_cast<std::uint32_t>(sets.size()), last);
    sets.insert(sets.end(), more.begin(), more.end());
    sums.resize(sets.size());
  }
  if (from == to) return;
  const std::vector<Sums> more =
      run.evaluate_all({sets.begin() + first, sets.begin() + last}, from, to - from, proposal,
                       record && to * last <= run.max_recorded_calls() / 2 ? Keep::points : Keep::sums);
  for (std::uint32_t r = first; r < last; ++r) sums[r].merge(more[r - first]);
}

// Extends the sequences from `first` on to the current lengths and updates the means. With a density, extends both
// parts of the mixture.
Means grown(IntegrationRun& run, ReplicatedSequences& s, std::uint32_t first, std::uint64_t from,
            std::uint64_t uniform_from) {
  Proposal part = s.proposal;
  if (part.density) part.part = Proposal::Part::density;
  add(run, s.stream_id, first, s.count, from, s.length, part, s.record, s.sets, s.sums);
  if (part.density) {
    part.part = Proposal::Part::uniform;
    add(run, s.stream_id + uniform_stream_offset, first, s.count, uniform_from, s.uniform_length, part, false,
        s.uniform_sets, s.uniform_sums);
  }
  return s.means = run.means(s.sums, s.length, s.histories, s.uniform_sums, s.proposal, s.discarded);
}

// Standard deviation of the means of the replicates, of any size.
double deviation(const std::vector<Sums>& replicates, std::size_t output) {
  std::vector<double> means;
  double largest = 0;
  for (const Sums& s : replicates) {
    means.push_back(s.outputs[output].mean());
    largest = std::max(largest, std::abs(means.back()));
  }
  ScaledMoments all;
  all.add(means, 0, largest);
  return all.std_deviation();
}
} // namespace

Means ReplicatedSequences::extend(IntegrationRun& run, std::uint64_t to) {
  const std::uint64_t from = length, uniform_from = uniform_length;
  length = to;
  uniform_length = uniform_points(to, points_per_uniform_point);
  grown(run, *this, 0, from, uniform_from);
  means_history.emplace_back(means.begin(), means.begin() + static_cast<std::ptrdiff_t>(run.primary_outputs()));
  return means;
}

Means ReplicatedSequences::add_replicates(IntegrationRun& run, std::uint32_t more) {
  count += more;
  grown(run, *this, count - more, 0, 0);
  means_history.back().assign(means.begin(), means.begin() + static_cast<std::ptrdiff_t>(run.primary_outputs()));
  return means;
}

void ReplicatedSequences::keep_first(std::uint32_t first) {
  count = first;
  discarded.resize(means.size());
  for (const auto* all : {&sums, &uniform_sums})
    for (std::size_t r = count; r < all->size(); ++r)
      for (std::size_t k = 0; k < discarded.size(); ++k) discarded[k].merge((*all)[r].diagnostics[k]);
  for (auto* points : {&sets, &uniform_sets})
    if (points->size() > count) points->erase(points->begin() + count, points->end());
  for (auto* all : {&sums, &uniform_sums})
    if (all->size() > count) all->resize(count);
}

void ReplicatedSequences::discard_records() {
  record = false;
  for (Sums& s : sums) {
    s.points = {};
    s.values = {};
  }
}

double ReplicatedSequences::uniform_variance_share() const {
  if (uniform_sums.empty()) return 0;
  const std::size_t outputs = means_history.back().size();
  double sum = 0;
  for (std::size_t k = 0; k < outputs; ++k) {
    const double uniform = Proposal::uniform_share * deviation(uniform_sums, k),
                 both = std::hypot(uniform, (1 - Proposal::uniform_share) * deviation(sums, k));
    if (both > 0) sum += sqr(uniform / both);
  }
  return sum / static_cast<double>(outputs);
}

std::vector<IntegrandDiagnostics> ReplicatedSequences::diagnostics() const {
  return merged_diagnostics(uniform_sums, merged_diagnostics(sums, discarded));
}

Correlations ReplicatedSequences::correlations(const IntegrationRun& run) const {
  return detail::correlations(run.replicate_means(sums, uniform_sums, proposal));
}

namespace {
bool significantly_different(const Mean& a, const Mean& b) {
  const auto z = z_score(a, b);
  return z && *z > 3.72; // probability 1e-4 by chance
}
} // namespace

bool significantly_different(const Means& a, const Means& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    if (significantly_different(a[k], b[k])) return true;
  return false;
}

bool has_fewer_known_errors(const Means& a, const Means& b) {
  bool less = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const bool known = a[k].error_bar == ErrorBar::known;
    if (known && b[k].error_bar != ErrorBar::known) return false;
    less |= !known && b[k].error_bar == ErrorBar::known;
  }
  return less;
}

double log_variance_ratio(const Means& a, const Means& b) {
  // Error, or relative error if the means differ significantly.
  const auto error = [](const Mean& m, const Mean& other) {
    if (!significantly_different(m, other)) return m.error;
    const double missed = std::abs(m.value) < std::abs(other.value) ? std::abs(other.value - m.value) : 0.0;
    return std::max(m.error, missed) / (std::abs(m.value) + m.error);
  };
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += log_squared_ratio(error(a[k], b[k]), error(b[k], a[k]));
  return sum;
}

double required_margin(const Means& m) {
  double sum = 0;
  for (const Mean& x : m) sum += 0.2 + 2.5 * std::abs(x.skew);
  return sum;
}

double convergence_rate(const ReplicatedSequences& s) {
  const std::size_t end = s.means_history.size() - 1, steps = std::min<std::size_t>(end, 3);
  if (steps == 0) return 0;
  return log_variance_ratio(s.means_history[end - steps], s.means_history[end]) /
         static_cast<double>(steps * s.means_history[end].size());
}

namespace {
// Standard error of one replicate if its points were independent.
double independent_error(const ReplicatedSequences& s, std::size_t output) {
  const auto error = [&](const std::vector<Sums>& replicates, std::uint64_t points) {
    ScaledMoments all;
    for (const Sums& r : replicates) all.merge(r.outputs[output]);
    return all.std_deviation() / std::sqrt(static_cast<double>(points));
  };
  const double of_density = error(s.sums, s.length);
  if (s.uniform_sums.empty()) return of_density;
  return std::hypot((1 - Proposal::uniform_share) * of_density,
                    Proposal::uniform_share * error(s.uniform_sums, s.uniform_length));
}

// Logarithm of the variance for independent points over the actual variance of a replicate; at least 0.
double log_efficiency_gain(const ReplicatedSequences& s, std::size_t output) {
  const double shown = s.means_history.back()[output].error * std::sqrt(s.count);
  return std::max(log_squared_ratio(independent_error(s, output), shown), 0.0);
}
} // namespace

double predicted_log_variance_ratio(const ReplicatedSequences& a, const ReplicatedSequences& b, double doublings,
                                    double expected) {
  constexpr double before = 0.4; // gain before the first doubling: a sequence without gain so far may still gain
  constexpr double differ = 0.5; // expected difference of two gains relative to their mean
  const Means &of_a = a.means_history.back(), &of_b = b.means_history.back();
  const double doubled = std::max(std::log2(static_cast<double>(a.length)), 1.0);
  // variance of the logarithm of both variance estimates
  const double noise = 2.0 / (a.count - 1) + 2.0 / (b.count - 1);
  double sum = 0;
  for (std::size_t k = 0; k < of_a.size(); ++k) {
    const double gain_a = log_efficiency_gain(a, k), gain_b = log_efficiency_gain(b, k),
                 prior = sqr(differ * (gain_a + gain_b) / 2);
    if (significantly_different(of_a[k], of_b[k])) sum += log_variance_ratio({of_a[k]}, {of_b[k]});
    else
      sum += log_squared_ratio(independent_error(a, k), independent_error(b, k)) +
             (gain_b - gain_a) * prior / (prior + noise);
    sum -= doublings * expected * (gain_a + before) / (doubled + 1);
  }
  return sum;
}

} // namespace mc::detail
