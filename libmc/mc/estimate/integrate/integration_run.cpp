#include <mc/core/error.h>
#include <mc/core/parallel.h>
#include <mc/estimate/integrate/integration_run.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc::detail {

namespace {
constexpr std::uint64_t chunk = 4096;  // points per task: fixed, so that sums do not depend on the number of threads
constexpr std::uint64_t block = 256;   // points drawn at once
constexpr double thread_start = 5e-4;  // seconds of work above which other threads pay off
constexpr double most_infinite = 1e-3; // largest volume of infinite values; a larger one is no singularity
constexpr double few_infinite = 8;     // points always allowed to be infinite

// Weight of the values at one point: value * factor - control_coefficients * shift.
struct Weight {
  double factor = 1, shift = 0;
};

// Maps the point to the proposal and returns its weight.
Weight draw(const Proposal& proposal, std::span<double> point, std::span<double> scratch) {
  if (!proposal.density) return {};
  const AdaptedDensity& p = *proposal.density;
  const bool uniform = proposal.part == Proposal::Part::uniform;
  const double jacobian = uniform ? 1 / p.density(point, scratch) : p.map(point);
  if (std::isinf(jacobian)) return {1 / Proposal::uniform_share, 0}; // only the uniform part reaches this point
  if (proposal.part == Proposal::Part::all) return {jacobian, 0};
  const double p_over_q = 1 / (Proposal::uniform_share * jacobian + (1 - Proposal::uniform_share));
  return {jacobian * p_over_q, p_over_q};
}
} // namespace

void Integrand::operator()(std::span<const double> points, std::size_t dim, std::span<double> values) const {
  if (batch) return batch->f(points, values);
  const std::size_t n = points.size() / dim, outputs = values.size() / n;
  if (one)
    for (std::size_t i = 0; i < n; ++i) values[i] = (*one)(points.subspan(i * dim, dim));
  else
    for (std::size_t i = 0; i < n; ++i) (*several)(points.subspan(i * dim, dim), values.subspan(i * outputs, outputs));
}

void IntegrationRun::record_points(Sums& sums, std::span<const double> points, std::span<const double> values) const {
  sums.points.insert(sums.points.end(), points.begin(), points.end());
  for (auto at = values.begin(); at != values.end(); at += static_cast<std::ptrdiff_t>(outputs))
    sums.values.insert(sums.values.end(), at, at + static_cast<std::ptrdiff_t>(primary_outputs()));
}

Sums IntegrationRun::evaluate(const PointSet& set, std::uint64_t first, std::uint64_t last, const Proposal& proposal,
                              Keep keep) const {
  if (options.cancel && options.cancel->load()) throw Cancelled{};
  const auto d = static_cast<std::size_t>(dim);
  Sums sums{std::vector<ScaledMoments>(outputs), std::vector<IntegrandDiagnostics>(outputs)};
  std::vector<double> u(block * d), values(outputs * block), columns(block), factors(block), shifts(block),
      offset_values(block), scratch(d);
  for (; first < last; first += block) {
    const auto n = static_cast<std::size_t>(std::min(block, last - first));
    const std::span<double> points(u.data(), n * d), all(values.data(), n * outputs), column(columns.data(), n);
    fill_points(set, first, dim, points);
    const auto profiled =
        static_cast<std::size_t>(std::clamp<std::uint64_t>(AxisProfile::most, first, first + n) - first);
    sums.profile.add_points(points.first(profiled * d));
    for (std::size_t i = 0; i < n; ++i) {
      const Weight weight = draw(proposal, points.subspan(i * d, d), scratch);
      factors[i] = weight.factor;
      shifts[i] = weight.shift;
    }
    integrand(points, d, all);
    sums.zero_infinite_values(all, {factors.data(), n}, first);
    if (keep == Keep::points) record_points(sums, points, all);
    for (std::size_t k = 0; k < outputs; ++k) {
      for (std::size_t i = 0; i < n; ++i) column[i] = all[i * outputs + k];
      if (!tail_offsets.empty() && tail_offsets[k][0] != 0)
        for (std::size_t j = 0; j < 2; ++j) {
          for (std::size_t i = 0; i < n; ++i) offset_values[i] = column[i] - tail_offsets[k][j];
          sums.diagnostics[k].offset_tails[j].add({offset_values.data(), n},
                                                  {factors.data(), proposal.density ? n : 0});
        }
      if (proposal.density) {
        if (proposal.part == Proposal::Part::uniform) sums.diagnostics[k].uniform_values.add(column);
        sums.diagnostics[k].tail.add(column, {factors.data(), n});
        sums.diagnostics[k].add_to_range(column);
        for (std::size_t i = 0; i < n; ++i) column[i] *= factors[i];
      }
      OctaveHistogram sizes; // of the values before subtraction, which would hide zeros and equal values
      sizes.add(column);
      sums.diagnostics[k].values.merge(sizes);
      double largest = std::max(std::abs(sizes.lo()), std::abs(sizes.hi()));
      if (!proposal.control_coefficients.empty()) {
        for (std::size_t i = 0; i < n; ++i) column[i] -= proposal.control_coefficients[k] * shifts[i];
        largest += 2 * std::abs(proposal.control_coefficients[k]); // no shift is above 8 / 7
      }
      sums.profile.add_values(k, column.first(profiled));
      if (keep == Keep::batches) sums.add_to_batches(k, column, first, largest);
      sums.outputs[k].add(column, first, largest);
    }
  }
  return sums;
}

std::vector<Sums> IntegrationRun::evaluate_all(const std::vector<PointSet>& sets, std::uint64_t first,
                                               std::uint64_t count, const Proposal& proposal, Keep keep) {
  const std::uint64_t chunks = (count + chunk - 1) / chunk;
  std::vector<Sums> parts(sets.size() * chunks), results(sets.size());
  const auto task = [&](std::size_t i) {
    const std::uint64_t begin = first + i % chunks * chunk;
    parts[i] = evaluate(sets[i / chunks], begin, std::min(begin + chunk, first + count), proposal, keep);
  };
  // Other threads start only if they pay off, judged by the time of the first task.
  const auto begin = std::chrono::steady_clock::now();
  task(0);
  const std::chrono::duration<double> once = std::chrono::steady_clock::now() - begin;
  const bool pays = once.count() * static_cast<double>(parts.size() - 1) > thread_start;
  parallel_for(parts.size() - 1, pays ? options.threads : 1, [&](std::size_t i) { task(i + 1); });
  for (std::size_t i = 0; i < parts.size(); ++i) results[i / chunks].merge(parts[i]);
  calls += count * sets.size();
  // A few points do not determine the volume that they represent.
  const double most = few_infinite + most_infinite * static_cast<double>(count * sets.size());
  for (std::size_t k = 0; k < outputs; ++k) {
    double infinite = 0;
    for (std::size_t r = 0; r < sets.size(); ++r) {
      const Moments& m = results[r].outputs[k].moments();
      const IntegrandDiagnostics& diagnostics = results[r].diagnostics[k];
      infinite += diagnostics.infinite_volume;
      if (m.non_finite_count() > 0)
        throw_not_finite(m.non_finite_count(), count, m.first_non_finite(), sets[r], proposal);
      if (infinite > most)
        throw_not_finite(diagnostics.infinite_count, count, *results[r].first_infinite, sets[r], proposal);
    }
  }
  if (tail_offsets.empty()) find_tail_offsets(results);
  return results;
}

// Without a tail, the largest value is close to the quartile.
void IntegrationRun::find_tail_offsets(const std::vector<Sums>& first) {
  constexpr double far = 4;
  tail_offsets.resize(outputs);
  if (options.density) return; // the first points may be drawn from the given density
  for (std::size_t k = 0; k < outputs; ++k) {
    std::vector<double> values;
    for (const Sums& s : first) values.insert(values.end(), s.profile.values(k).begin(), s.profile.values(k).end());
    if (values.empty()) continue;
    std::sort(values.begin(), values.end());
    const double lo = values.front(), hi = values.back(), quarter = values[values.size() / 4],
                 upper = values[3 * values.size() / 4];
    const bool above = hi - upper > far * (upper - lo), below = quarter - lo > far * (hi - quarter);
    if (above) tail_offsets[k] = {2 * lo - upper, lo};
    else if (below) tail_offsets[k] = {2 * hi - quarter, hi};
    const auto [a, b] = tail_offsets[k];
    if (!(std::min(a, b) > 0 || std::max(a, b) < 0)) tail_offsets[k] = {}; // the tail may contain the whole range
  }
}

void IntegrationRun::throw_not_finite(std::uint64_t bad, std::uint64_t count, std::uint64_t first, const PointSet& set,
                                      const Proposal& proposal) const {
  std::vector<double> u(static_cast<std::size_t>(dim));
  std::vector<double> scratch(u.size());
  fill_points(set, first, dim, u);
  draw(proposal, u, scratch);
  std::string point;
  for (const double x : u) point += fmt::format("{}{:.17g}", point.empty() ? "" : ", ", x);
  throw NotFinite(bad, count, std::move(u), fmt::format("u = ({})", point));
}

std::vector<PointSet> IntegrationRun::sobol_sets(std::uint64_t stream_id, std::uint32_t first,
                                                 std::uint32_t last) const {
  std::vector<PointSet> sets;
  for (std::uint32_t r = first; r < last; ++r) {
    const std::uint64_t seed = hash(options.seed, stream_id, r);
    if (stream_id == 0 && uses_interlaced_points()) sets.emplace_back(InterlacedSobol{seed});
    else sets.emplace_back(ScrambledSobol{seed});
  }
  return sets;
}

std::vector<std::vector<double>> IntegrationRun::replicate_means(const std::vector<Sums>& replicates,
                                                                 const std::vector<Sums>& uniform,
                                                                 const Proposal& proposal) const {
  std::vector<std::vector<double>> means(outputs);
  for (std::size_t k = 0; k < outputs; ++k)
    for (std::size_t r = 0; r < replicates.size(); ++r) {
      const double mean = replicates[r].outputs[k].mean();
      means[k].push_back(uniform.empty() ? mean
                                         : proposal.control_coefficients[k] + (1 - Proposal::uniform_share) * mean +
                                               Proposal::uniform_share * uniform[r].outputs[k].mean());
    }
  return means;
}

Means IntegrationRun::means(const std::vector<Sums>& replicates, std::uint64_t points,
                            std::vector<ReplicateHistory>& histories, const std::vector<Sums>& uniform,
                            const Proposal& proposal, const std::vector<IntegrandDiagnostics>& discarded) const {
  histories.resize(outputs);
  AxisProfile profile;
  if (points <= AxisProfile::most)
    for (const Sums& s : replicates) profile.merge(s.profile);
  const std::vector<std::vector<double>> values = replicate_means(replicates, uniform, proposal);
  Means all;
  for (std::size_t k = 0; k < outputs; ++k) {
    IntegrandDiagnostics diagnostics = discarded.empty() ? IntegrandDiagnostics() : discarded[k];
    for (const auto* part : {&replicates, &uniform})
      for (const Sums& s : *part) diagnostics.merge(s.diagnostics[k]);
    if (points <= AxisProfile::most)
      histories[k].add_axis_jump(profile.jump(k, static_cast<std::size_t>(dim), replicates.size()));
    all.push_back(mean_of_replicates(values[k], static_cast<double>(points), diagnostics, histories[k]));
    if (k < primary_outputs())
      // densities do not adapt to auxiliary outputs
      all.back().unsampled_tail_bound = unsampled_tail_bound(diagnostics, all.back().error);
  }
  return all;
}

void IntegrationRun::record(Method method, const Means& means, bool learning) {
  rounds.push_back({method, learning, calls, means, learning});
  if (options.progress) options.progress({estimate(means.front(), calls), calls, seconds()});
}

void IntegrationRun::mark_independent(Method method) {
  const auto last = std::find_if(rounds.rbegin(), rounds.rend(), [&](const Round& r) { return r.method == method; });
  MC_ASSERT(last != rounds.rend());
  last->independent = true;
}

void IntegrationRun::add_chi2(Round& round, const Means& means) {
  round.chi2.assign(outputs, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < outputs; ++k)
    if (const auto z = z_score(round.means[k], means[k])) {
      round.chi2[k] = sqr(*z);
      chi2[k] += sqr(*z);
      chi2_dof[k] += 1;
    }
}

bool IntegrationRun::converged(const Means& all) const {
  return std::all_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(primary_outputs()), [&](const Mean& m) {
    const double error = estimate(m, calls).std_error;
    return !m.zero_spread && std::isfinite(error) &&
           (error <= options.abs_error || error <= options.rel_error * std::abs(m.value));
  });
}

} // namespace mc::detail
