#include <mc/check/fit/explanations/rotation.h>

#include <mc/check/fit/explanations/summary.h>
#include <mc/check/fit/tests/fit_test.h>
#include <mc/core/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {
namespace {

// Whether a rotation explains the counts. It must reduce the chi-square by more than chance, and the rest must be
// within chance or small compared with the reduction.
bool explains(double before, double after, double dof, double least_gain) {
  const double gain = before - after;
  return gain >= least_gain && after - dof <= std::max(3 * std::sqrt(2 * dof), 0.25 * gain);
}

// Returns the integral of the density over the cross-section of a box at `at` on the axis, by Gauss's rule in the other
// axes.
double face(const Subject& s, const UnitBox& box, std::size_t axis, double at) {
  static constexpr double node = 0.3872983346207417; // sqrt(3/5) / 2
  static constexpr std::array<double, 3> nodes{-node, 0, node}, weights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  std::vector<std::size_t> others;
  int points = 1;
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d)
    if (d != axis) {
      others.push_back(d);
      points *= 3;
    }
  double sum = 0;
  for (int point = 0; point < points; ++point) {
    Subject::Coordinates v{};
    v[axis] = std::min(at, 1 - 1e-12);
    double weight = 1;
    int rest = point;
    for (const std::size_t d : others) {
      const auto k = static_cast<std::size_t>(rest % 3);
      rest /= 3;
      v[d] = box.lo[d] + (0.5 + nodes[k]) * (box.hi[d] - box.lo[d]);
      weight *= weights[k] * (box.hi[d] - box.lo[d]);
    }
    sum += weight * s.density(v);
  }
  return sum;
}

} // namespace

std::optional<double> find_rotation(const Subject& s, std::size_t axis, const Partition& partition,
                                    const std::vector<Cell>& cells, const std::vector<Partition::Coordinates>& pilot) {
  const auto size = static_cast<std::size_t>(partition.size());
  double n = 0, mass = 0;
  for (std::size_t i = 0; i < size; ++i) {
    n += cells[i].observed;
    mass += cells[i].p;
  }
  if (!(mass > 0) || n == 0 || size < 8) return {};

  double before = 0, dof = 0, score = 0, information = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const double expected = n * cells[i].p / mass;
    if (!(expected >= 5)) continue;
    const UnitBox box = partition.box(static_cast<int>(i));
    const double off = cells[i].observed - expected;
    const double rate = n / mass * (face(s, box, axis, box.lo[axis]) - face(s, box, axis, box.hi[axis]));
    dof += 1;
    before += off * off / expected;
    score += rate * off / expected;
    information += rate * rate / expected;
  }
  const double turn_of_score = score / information; // NaN if no rotation changes the density
  if (std::isfinite(information) && std::abs(turn_of_score) < 0.01 &&
      explains(before, before - score * turn_of_score, dof, 25))
    return turn_of_score;

  // Runs of cells that contain enough of 16 thousand pilot points.
  const std::size_t stride = std::max<std::size_t>(1, pilot.size() / 16384);
  std::size_t run = 1;
  while (run < size && size / run > pilot.size() / stride / 64) run *= 2;
  std::vector<double> p(size / run);
  for (std::size_t i = 0; i < size; ++i) p[i / run] += cells[i].p / mass;
  const auto chi_square = [&](double turn) {
    std::vector<double> count(p.size());
    double m = 0;
    for (std::size_t i = 0; i < pilot.size(); i += stride) {
      Partition::Coordinates v = pilot[i];
      v[axis] = std::min(v[axis] - turn - std::floor(v[axis] - turn), 1 - 0x1p-53);
      ++count[static_cast<std::size_t>(partition.cell(v)) / run];
      ++m;
    }
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += sqr(count[i] - m * p[i]) / std::max(m * p[i], 1.0);
    return sum;
  };
  const double unturned = chi_square(0);
  double best = unturned, turn = 0;
  const auto try_turn = [&](double t) {
    if (const double c = chi_square(t); c < best) {
      best = c;
      turn = t;
    }
  };
  for (int k = 1; k < 72; ++k) try_turn(k / 72.0);
  for (const double step : {1 / 216.0, 1 / 648.0, 1 / 1944.0})
    for (const double t : {turn - step, turn + step}) try_turn(t);
  // The chi-squares of two rotations of the same points differ by about 2 sqrt(dof) by chance; the best of many
  // rotations gains about three times as much.
  const double groups = static_cast<double>(p.size());
  if (!explains(unturned, best, groups, 25 + 10 * std::sqrt(groups))) return {};
  return turn > 0.5 ? turn - 1 : turn;
}

// If a rotation about the pole explains the counts, reports it as the likely cause.
void explain_by_rotation(const FitCounts& counts, std::vector<TestFindings>& findings) {
  const auto of_shape = [](const Check* c) {
    return c->verdict == Verdict::fail && (c->fault == Fault::shape || c->fault == Fault::local);
  };
  const std::vector<Check*> checks = checks_of_cells(findings);
  const Subject& s = counts.setup.subject;
  if (s.dim < 2 || std::none_of(checks.begin(), checks.end(), of_shape)) return;
  const std::vector<Axis> axes = named_axes(s);
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
    if (axes[d].scale != Axis::Scale::azimuth) continue;
    const std::optional<double> turn = find_rotation(s, d, *counts.partition, counts.cells, counts.setup.pilot.points);
    if (!turn) continue;
    prepend_finding(checks, fmt::format("the samples seem rotated by {:.3g} deg in {}", 360 * *turn, axes[d].name));
    for (Check* c : checks)
      if (of_shape(c)) c->fault = Fault::rotation;
  }
}

} // namespace mc
