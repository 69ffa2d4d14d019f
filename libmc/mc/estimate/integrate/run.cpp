#include <mc/core/error.h>
#include <mc/core/parallel.h>
#include <mc/estimate/integrate/run.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

namespace {
constexpr std::uint64_t chunk = 4096; // points per task: fixed, so sums do not depend on the number of threads
constexpr std::uint64_t block = 256;  // points drawn at once
constexpr double thread_start = 5e-4; // seconds of work that are worth waking other threads
} // namespace

Sums Run::evaluate(const PointSet& set, std::uint64_t first, std::uint64_t last, const ImportanceGrid* grid,
                   std::span<const double> learn) const {
  if (o.cancel && o.cancel->load()) throw Cancelled{};
  const auto d = static_cast<std::size_t>(dim);
  Sums sums{std::vector<ScaledMoments>(outputs), std::vector<Magnitudes>(outputs),
            std::vector<double>(learn.empty() ? 0 : d * ImportanceGrid::bins)};
  std::vector<double> u(block * d), values(outputs), columns(outputs * block);
  std::vector<std::uint8_t> bins(grid ? d : 0);
  for (; first < last; first += block) {
    const auto n = static_cast<std::size_t>(std::min(block, last - first));
    fill_points(set, first, dim, {u.data(), n * d});
    for (std::size_t i = 0; i < n; ++i) {
      const std::span<double> point(u.data() + i * d, d);
      const double jacobian = grid ? grid->map(point, bins) : 1.0;
      f(point, values);
      double power = 0;
      for (std::size_t k = 0; k < outputs; ++k) {
        const double x = values[k] * jacobian;
        columns[k * block + i] = x;
        if (!learn.empty()) power += sqr(x * learn[k]);
      }
      if (!learn.empty())
        for (std::size_t j = 0; j < d; ++j) sums.power[j * ImportanceGrid::bins + bins[j]] += power;
    }
    for (std::size_t k = 0; k < outputs; ++k) {
      const std::span<double> column = std::span(columns).subspan(k * block, n);
      Magnitudes sizes;
      sizes.add(column);
      sums.magnitudes[k].merge(sizes);
      sums.outputs[k].add(column, first, std::max(std::abs(sizes.lo()), std::abs(sizes.hi())));
    }
  }
  return sums;
}

std::vector<Sums> Run::evaluate_all(const std::vector<PointSet>& sets, std::uint64_t first, std::uint64_t count,
                                    const ImportanceGrid* grid, std::span<const double> learn) {
  const std::uint64_t chunks = (count + chunk - 1) / chunk;
  std::vector<Sums> parts(sets.size() * chunks), results(sets.size());
  const auto task = [&](std::size_t i) {
    const std::uint64_t begin = first + i % chunks * chunk;
    parts[i] = evaluate(sets[i / chunks], begin, std::min(begin + chunk, first + count), grid, learn);
  };
  // Threads start when they pay: the first task is timed.
  const auto begin = std::chrono::steady_clock::now();
  task(0);
  const std::chrono::duration<double> once = std::chrono::steady_clock::now() - begin;
  const bool pays = once.count() * static_cast<double>(parts.size() - 1) > thread_start;
  parallel_for(parts.size() - 1, pays ? o.threads : 1, [&](std::size_t i) { task(i + 1); });
  for (std::size_t i = 0; i < parts.size(); ++i) results[i / chunks].merge(parts[i]);
  for (std::size_t r = 0; r < sets.size(); ++r)
    for (const ScaledMoments& m : results[r].outputs) require_finite(m.moments(), sets[r], grid);
  calls += count * sets.size();
  return results;
}

void Run::require_finite(const Moments& m, const PointSet& set, const ImportanceGrid* grid) const {
  if (m.non_finite() == 0) return;
  std::vector<double> u(static_cast<std::size_t>(dim));
  std::vector<std::uint8_t> bins(u.size());
  fill_points(set, m.witness(), dim, u);
  if (grid) grid->map(u, bins);
  std::string point;
  for (const double x : u) point += fmt::format("{}{:.17g}", point.empty() ? "" : ", ", x);
  throw Error(fmt::format("integrate: the integrand is not finite at {} of {} points, the first at u = ({}); it must "
                          "be finite almost everywhere",
                          m.non_finite(), m.non_finite() + m.count(), point));
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

Means Run::means(const std::vector<Sums>& replicates, std::uint64_t points, std::vector<Evidence>& evidence) const {
  evidence.resize(outputs);
  Means all;
  for (std::size_t k = 0; k < outputs; ++k) {
    std::vector<double> values;
    Magnitudes seen;
    for (const Sums& s : replicates) {
      values.push_back(s.outputs[k].mean());
      seen.merge(s.magnitudes[k]);
    }
    all.push_back(replicated(values, static_cast<double>(points), seen, evidence[k]));
  }
  return all;
}

void Run::compare(const Means& a, const Means& b) {
  for (std::size_t k = 0; k < outputs; ++k)
    if (const auto z = deviate(a[k], b[k])) {
      chi2[k] += sqr(*z);
      chi2_dof[k] += 1;
    }
}

bool Run::converged(const Means& all) const {
  for (const Mean& m : all)
    if (const double error = estimate(m, calls).std_error;
        !std::isfinite(error) || !(error <= o.abs_error || error <= o.rel_error * std::abs(m.value)))
      return false;
  return true;
}

void Run::report(const Means& all) const {
  if (o.progress) o.progress({estimate(all.front(), calls), calls, seconds()});
}

} // namespace mc::detail
