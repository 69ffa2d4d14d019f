#include <mc/core/error.h>
#include <mc/core/parallel.h>
#include <mc/estimate/integrate/run.h>

#include <algorithm>
#include <cmath>

namespace mc::detail {

namespace {
constexpr std::uint64_t chunk = 4096; // points per task: fixed, so sums do not depend on the number of threads
constexpr std::uint64_t block = 256;  // points drawn at once
} // namespace

void Sums::merge(const Sums& other) {
  if (outputs.empty()) *this = other;
  else {
    for (std::size_t k = 0; k < outputs.size(); ++k) outputs[k].merge(other.outputs[k]);
    for (std::size_t i = 0; i < power.size(); ++i) power[i] += other.power[i];
  }
}

Sums Run::evaluate(const PointSet& set, std::uint64_t first, std::uint64_t last, const ImportanceGrid* grid,
                   std::span<const double> learn) const {
  if (o.cancel && o.cancel->load()) throw Cancelled{};
  const auto d = static_cast<std::size_t>(dim);
  Sums sums{std::vector<Moments>(outputs), std::vector<double>(learn.empty() ? 0 : d * ImportanceGrid::bins)};
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
    for (std::size_t k = 0; k < outputs; ++k) sums.outputs[k].add(std::span(columns).subspan(k * block, n), first);
  }
  return sums;
}

std::vector<Sums> Run::evaluate_all(const std::vector<PointSet>& sets, std::uint64_t first, std::uint64_t count,
                                    const ImportanceGrid* grid, std::span<const double> learn) {
  const std::uint64_t chunks = (count + chunk - 1) / chunk;
  std::vector<Sums> parts(sets.size() * chunks), results(sets.size());
  parallel_for(parts.size(), o.threads, [&](std::size_t i) {
    const std::uint64_t begin = first + i % chunks * chunk;
    parts[i] = evaluate(sets[i / chunks], begin, std::min(begin + chunk, first + count), grid, learn);
  });
  for (std::size_t i = 0; i < parts.size(); ++i) results[i / chunks].merge(parts[i]);
  for (std::size_t r = 0; r < sets.size(); ++r)
    for (const Moments& m : results[r].outputs) require_finite(m, sets[r], grid);
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

Means Run::means(const std::vector<Sums>& replicates) const {
  Means all;
  for (std::size_t k = 0; k < outputs; ++k) {
    Moments m;
    for (const Sums& s : replicates) m.add(s.outputs[k].mean());
    all.push_back({m.mean(), sqr(m.std_error()), static_cast<double>(replicates.size() - 1)});
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

Estimate Run::estimate(const Mean& m) const { return Estimate::student(m.value, std::sqrt(m.variance), m.dof, calls); }

bool Run::converged(const Means& all) const {
  for (const Mean& m : all)
    if (const double error = estimate(m).std_error; !(error <= o.abs_error || error <= o.rel_error * std::abs(m.value)))
      return false;
  return true;
}

void Run::report(const Means& all) const {
  if (o.progress) o.progress({estimate(all.front()), calls, seconds()});
}

} // namespace mc::detail
