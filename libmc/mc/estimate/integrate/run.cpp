#include <mc/core/error.h>
#include <mc/core/parallel.h>
#include <mc/estimate/integrate/run.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc::detail {

namespace {
constexpr std::uint64_t chunk = 4096;  // points per task: fixed, so sums do not depend on the number of threads
constexpr std::uint64_t block = 256;   // points drawn at once
constexpr double thread_start = 5e-4;  // seconds of work that are worth waking other threads
constexpr double most_infinite = 1e-3; // of the volume: more is no singularity
constexpr double few_infinite = 8;     // points

// How the values at one point count: value * factor - centre * shift.
struct Weight {
  double factor = 1, shift = 0;
};

// Moves the point to where the proposal wants it.
Weight draw(const Proposal& proposal, std::span<double> point, std::span<double> scratch) {
  if (!proposal.density) return {};
  const AdaptedDensity& p = *proposal.density;
  const bool uniform = proposal.part == Proposal::Part::of_uniform;
  const double jacobian = uniform ? 1 / p.density(point, scratch) : p.map(point);
  if (std::isinf(jacobian)) return {1 / Proposal::uniform_share, 0}; // where only the uniform part comes
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

void Run::keep_points(Sums& sums, std::span<const double> points, std::span<const double> values) const {
  sums.points.insert(sums.points.end(), points.begin(), points.end());
  for (auto at = values.begin(); at != values.end(); at += static_cast<std::ptrdiff_t>(outputs))
    sums.values.insert(sums.values.end(), at, at + static_cast<std::ptrdiff_t>(leading()));
}

Sums Run::evaluate(const PointSet& set, std::uint64_t first, std::uint64_t last, const Proposal& proposal,
                   Keep keep) const {
  if (o.cancel && o.cancel->load()) throw Cancelled{};
  const auto d = static_cast<std::size_t>(dim);
  Sums sums{std::vector<ScaledMoments>(outputs), std::vector<Seen>(outputs)};
  std::vector<double> u(block * d), values(outputs * block), columns(block), factors(block), shifts(block), over(block),
      scratch(d);
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
    f(points, d, all);
    sums.leave_out_infinite(all, {factors.data(), n}, first);
    if (keep == Keep::points) keep_points(sums, points, all);
    for (std::size_t k = 0; k < outputs; ++k) {
      for (std::size_t i = 0; i < n; ++i) column[i] = all[i * outputs + k];
      if (!floors.empty() && floors[k][0] != 0)
        for (std::size_t j = 0; j < 2; ++j) {
          for (std::size_t i = 0; i < n; ++i) over[i] = column[i] - floors[k][j];
          sums.seen[k].over[j].add({over.data(), n}, {factors.data(), proposal.density ? n : 0});
        }
      if (proposal.density) {
        if (proposal.part == Proposal::Part::of_uniform) sums.seen[k].uniform.add(column);
        sums.seen[k].tail.add(column, {factors.data(), n});
        sums.seen[k].add_to_range(column);
        for (std::size_t i = 0; i < n; ++i) column[i] *= factors[i];
      }
      Magnitudes sizes; // of the values themselves: what is subtracted hides zeros and equal values
      sizes.add(column);
      sums.seen[k].values.merge(sizes);
      double largest = std::max(std::abs(sizes.lo()), std::abs(sizes.hi()));
      if (!proposal.centre.empty()) {
        for (std::size_t i = 0; i < n; ++i) column[i] -= proposal.centre[k] * shifts[i];
        largest += 2 * std::abs(proposal.centre[k]); // no shift is above 8 / 7
      }
      sums.profile.add_values(k, column.first(profiled));
      if (keep == Keep::batches) sums.add_to_batches(k, column, first, largest);
      sums.outputs[k].add(column, first, largest);
    }
  }
  return sums;
}

std::vector<Sums> Run::evaluate_all(const std::vector<PointSet>& sets, std::uint64_t first, std::uint64_t count,
                                    const Proposal& proposal, Keep keep) {
  const std::uint64_t chunks = (count + chunk - 1) / chunk;
  std::vector<Sums> parts(sets.size() * chunks), results(sets.size());
  const auto task = [&](std::size_t i) {
    const std::uint64_t begin = first + i % chunks * chunk;
    parts[i] = evaluate(sets[i / chunks], begin, std::min(begin + chunk, first + count), proposal, keep);
  };
  // Threads start when they pay: the first task is timed.
  const auto begin = std::chrono::steady_clock::now();
  task(0);
  const std::chrono::duration<double> once = std::chrono::steady_clock::now() - begin;
  const bool pays = once.count() * static_cast<double>(parts.size() - 1) > thread_start;
  parallel_for(parts.size() - 1, pays ? o.threads : 1, [&](std::size_t i) { task(i + 1); });
  for (std::size_t i = 0; i < parts.size(); ++i) results[i / chunks].merge(parts[i]);
  calls += count * sets.size();
  // A few points do not tell how much volume they stand for.
  const double most = few_infinite + most_infinite * static_cast<double>(count * sets.size());
  for (std::size_t k = 0; k < outputs; ++k) {
    double infinite = 0;
    for (std::size_t r = 0; r < sets.size(); ++r) {
      const Moments& m = results[r].outputs[k].moments();
      const Seen& seen = results[r].seen[k];
      infinite += seen.infinite_volume;
      if (m.non_finite() > 0) refuse_points(m.non_finite(), count, m.witness(), sets[r], proposal);
      if (infinite > most) refuse_points(seen.infinite, count, *results[r].first_infinite, sets[r], proposal);
    }
  }
  if (floors.empty()) find_floors(results);
  return results;
}

// What has no tail has its largest value close to the quartile.
void Run::find_floors(const std::vector<Sums>& first) {
  constexpr double far = 4;
  floors.resize(outputs);
  if (o.density) return; // the first points may be drawn from it
  for (std::size_t k = 0; k < outputs; ++k) {
    std::vector<double> values;
    for (const Sums& s : first) values.insert(values.end(), s.profile.values(k).begin(), s.profile.values(k).end());
    if (values.empty()) continue;
    std::sort(values.begin(), values.end());
    const double lo = values.front(), hi = values.back(), quarter = values[values.size() / 4],
                 upper = values[3 * values.size() / 4];
    const bool above = hi - upper > far * (upper - lo), below = quarter - lo > far * (hi - quarter);
    if (above) floors[k] = {2 * lo - upper, lo};
    else if (below) floors[k] = {2 * hi - quarter, hi};
    const auto [a, b] = floors[k];
    if (!(std::min(a, b) > 0 || std::max(a, b) < 0)) floors[k] = {}; // all of it may be tail
  }
}

void Run::refuse_points(std::uint64_t bad, std::uint64_t count, std::uint64_t first, const PointSet& set,
                        const Proposal& proposal) const {
  std::vector<double> u(static_cast<std::size_t>(dim));
  std::vector<double> scratch(u.size());
  fill_points(set, first, dim, u);
  draw(proposal, u, scratch);
  std::string point;
  for (const double x : u) point += fmt::format("{}{:.17g}", point.empty() ? "" : ", ", x);
  throw NotFinite(bad, count, std::move(u), fmt::format("u = ({})", point));
}

std::vector<PointSet> Run::sobol_sets(std::uint64_t purpose, std::uint32_t first, std::uint32_t last) const {
  std::vector<PointSet> sets;
  for (std::uint32_t r = first; r < last; ++r) {
    const std::uint64_t seed = hash(o.seed, purpose, r);
    if (purpose == 0 && interlaced()) sets.emplace_back(InterlacedSobol{seed});
    else sets.emplace_back(ScrambledSobol{seed});
  }
  return sets;
}

std::vector<std::vector<double>> Run::replicate_means(const std::vector<Sums>& replicates,
                                                      const std::vector<Sums>& uniform,
                                                      const Proposal& proposal) const {
  std::vector<std::vector<double>> means(outputs);
  for (std::size_t k = 0; k < outputs; ++k)
    for (std::size_t r = 0; r < replicates.size(); ++r) {
      const double mean = replicates[r].outputs[k].mean();
      means[k].push_back(uniform.empty() ? mean
                                         : proposal.centre[k] + (1 - Proposal::uniform_share) * mean +
                                               Proposal::uniform_share * uniform[r].outputs[k].mean());
    }
  return means;
}

Means Run::means(const std::vector<Sums>& replicates, std::uint64_t points, std::vector<Evidence>& evidence,
                 const std::vector<Sums>& uniform, const Proposal& proposal, const std::vector<Seen>& let_go) const {
  evidence.resize(outputs);
  AxisProfile profile;
  if (points <= AxisProfile::most)
    for (const Sums& s : replicates) profile.merge(s.profile);
  const std::vector<std::vector<double>> values = replicate_means(replicates, uniform, proposal);
  Means all;
  for (std::size_t k = 0; k < outputs; ++k) {
    Seen seen = let_go.empty() ? Seen() : let_go[k];
    for (const auto* part : {&replicates, &uniform})
      for (const Sums& s : *part) seen.merge(s.seen[k]);
    if (points <= AxisProfile::most)
      evidence[k].show_step(profile.jump(k, static_cast<std::size_t>(dim), replicates.size()));
    all.push_back(replicated(values[k], static_cast<double>(points), seen, evidence[k]));
    if (k < leading()) all.back().unmet = unmet(seen, all.back().error); // no density follows what is only watched
  }
  return all;
}

void Run::record(Method method, const Means& means, bool learning) {
  rounds.push_back({method, learning, calls, means, learning});
  if (o.progress) o.progress({estimate(means.front(), calls), calls, seconds()});
}

void Run::independent(Method method) {
  const auto last = std::find_if(rounds.rbegin(), rounds.rend(), [&](const Round& r) { return r.method == method; });
  MC_ASSERT(last != rounds.rend());
  last->independent = true;
}

void Run::compare(Round& round, const Means& means) {
  round.chi2.assign(outputs, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < outputs; ++k)
    if (const auto z = deviate(round.means[k], means[k])) {
      round.chi2[k] = sqr(*z);
      chi2[k] += sqr(*z);
      chi2_dof[k] += 1;
    }
}

bool Run::converged(const Means& all) const {
  return std::all_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(leading()), [&](const Mean& m) {
    const double error = estimate(m, calls).std_error;
    return !m.agreed && std::isfinite(error) && (error <= o.abs_error || error <= o.rel_error * std::abs(m.value));
  });
}

} // namespace mc::detail
