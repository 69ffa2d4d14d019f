#include <mc/check/fit/expected/stratified_reference.h>
#include <mc/check/fit/interior_density.h>
#include <mc/core/types.h>
#include <mc/random/pcg.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc {
namespace {

constexpr double samples_to_a_point = 8; // number of samples per random point

// Points of one cell may miss a jump that points of neighbouring cells show. Each cell gets the largest jump of an
// aligned run of cells.
void share_jumps(std::vector<EstimatedMass>& cells) {
  constexpr std::size_t beside = 64;
  for (std::size_t lo = 0; lo < cells.size(); lo += beside) {
    const std::size_t hi = std::min(lo + beside, cells.size());
    double jump = 0;
    for (std::size_t i = lo; i < hi; ++i) jump = std::max(jump, cells[i].jump);
    for (std::size_t i = lo; i < hi; ++i) cells[i].jump = jump;
  }
}

} // namespace

// One integral, computed in passes over the strata.
struct StratifiedReference::Integration {
  const Subject& subject;
  StratifiedReference& reference;
  const PointVisitor& visit;
  Pcg random;
  PerAxis<std::vector<double>> breaks{};
  std::size_t parts = 1; ///< number of parts of each stratum along an axis
  CellMasses result{};
  LinearFit fit{static_cast<std::size_t>(subject.dim)};
  AntitheticPoints paired{};
  std::vector<std::uint32_t> strata{}; ///< strata of the parts
  std::vector<double> densities{};
  std::vector<EvaluatedPoint> evaluated{};
  std::uint32_t fitted = 0; ///< cell of the points in the fit

  static constexpr std::size_t together = 2048;       // number of points evaluated at once
  static constexpr std::uint32_t fitted_together = 4; // number of cells

  void pass() {
    for (std::uint32_t i = 0; i < reference.strata_.size(); ++i) {
      paired.add(reference.boxes_[i], subject.dim, breaks, parts, random);
      strata.resize(paired.volumes.size(), i);
      if (paired.points.size() >= together) evaluate();
    }
    evaluate();
    close_fit();
    ++result.passes;
  }

  // Returns the number of passes that reduces both variances, summed over all cells, to a tenth of the variance of the
  // counts. The sampled variance decreases with the number of passes, the hidden variance with its cube.
  double passes_wanted(double samples, double most) {
    share_jumps(result.cells);
    double shown = 0, jumps = 0; // relative to the variances of the counts
    for (const EstimatedMass& m : result.cells) {
      if (!(m.value > 0)) continue;
      shown += samples * m.variance / m.value / static_cast<double>(result.cells.size());
      jumps += samples * sqr(m.jump) / m.value / static_cast<double>(result.cells.size());
    }
    double passes = std::max(std::ceil(10 * shown), 1.0);
    while (passes < most && 10 * jumps * hidden_jump_variance(4 * passes) > 1) ++passes;
    return passes;
  }

  void close_fit() {
    double& jump = result.cells[fitted].jump;
    jump = std::max(jump, fit.largest_residual());
  }

  void evaluate() {
    densities.resize(paired.points.size());
    interior_densities(subject, paired.points, densities);
    result.evaluations += densities.size();
    evaluated.clear();
    for (std::size_t i = 0; i < strata.size(); ++i) add_part(reference.strata_[strata[i]], i);
    if (visit) visit(evaluated);
    paired.points.clear();
    paired.volumes.clear();
    strata.clear();
  }

  void add_part(Stratum& stratum, std::size_t part) {
    if (stratum.cell / fitted_together != fitted / fitted_together) close_fit();
    fitted = stratum.cell;
    const double volume = paired.volumes[part] / 4;
    stratum.volume = std::max(stratum.volume, volume);
    const std::span<double, 4> all(&densities[4 * part], 4);
    std::array<double, 4> capped{};
    for (std::size_t k = 0; k < 4; ++k) {
      const Subject::Coordinates& v = paired.points[4 * part + k];
      if (!(all[k] >= 0 && all[k] <= std::numeric_limits<double>::max())) {
        if (!result.invalid_point) result.invalid_point = v;
        all[k] = 0;
      }
      capped[k] = std::min(all[k], stratum.cap);
      fit.add(v, capped[k], volume);
      evaluated.push_back({v, &stratum, all[k], capped[k] * volume});
    }
    result.cells[stratum.cell].add_part(4 * volume, capped);
    result.uncapped.add_part(4 * volume, all);
  }
};

StratifiedReference::CellMasses StratifiedReference::integrate(const Subject& s, const Goal& goal, std::uint64_t seed,
                                                               const PointVisitor& visit) {
  Integration integration{s, *this, visit, Pcg(seed)};
  CellMasses& result = integration.result;
  result.cells.resize(cells_);
  const double most = static_cast<double>(goal.max_points),
               points = std::max(static_cast<double>(goal.min_points),
                                 std::min(most / 8, goal.samples / samples_to_a_point));
  const double each = points / static_cast<double>(4 * strata_.size());
  integration.parts = static_cast<std::size_t>(std::max(1.0, std::floor(std::pow(each, 1.0 / dim_) + 1e-9)));
  double boxes = 1;
  for (const std::vector<double>& axis : s.breaks) boxes *= static_cast<double>(axis.size() + 1);
  if (4 * boxes <= most) integration.breaks = s.breaks;

  // Even for few samples, the mass of the density is needed to a thousandth.
  const double samples = std::max(goal.samples, 1e5);
  integration.pass();
  // All passes have the same weight, and only the sum over all cells determines their number, so that the choice causes
  // no bias.
  const double evaluations = static_cast<double>(result.evaluations), room = std::max(1.0, most / evaluations);
  const double passes =
      std::clamp(integration.passes_wanted(samples, room), std::max(1.0, std::round(points / evaluations)), room);
  while (static_cast<double>(result.passes) < passes && !result.invalid_point) integration.pass();
  share_jumps(result.cells);
  result.take_means();
  return std::move(result);
}

void StratifiedReference::CellMasses::take_means() {
  const double n = static_cast<double>(passes);
  const auto average = [n](EstimatedMass& m) {
    m.value /= n;
    m.variance /= sqr(n);
    m.variance_square /= sqr(sqr(n));
    m.largest /= n;
    m.jump /= n;
  };
  average(uncapped);
  for (EstimatedMass& m : cells) {
    average(m);
    total.largest = std::max(total.largest, m.largest);
    total.jump = std::max(total.jump, m.jump);
    total.value += m.value;
    total.variance += m.variance;
    total.variance_square += m.variance_square;
  }
}

} // namespace mc
