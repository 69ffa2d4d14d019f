#include <mc/check/fit/tests/cell_masses.h>

#include <algorithm>
#include <cmath>

namespace mc {
namespace {

// Where a box is cut along an axis when the pilot fills only [lo, hi] of it: in steps that grow by a factor of four, so
// that a lobe far narrower than the box cannot slip between the nodes.
std::vector<double> cuts_beside(double lo, double hi, const UnitBox& box, std::size_t axis) {
  std::vector<double> cuts;
  const double size = hi - lo;
  if (!(size > 0)) return cuts;
  double step = size;
  for (double at = lo - size; at > box.lo[axis] + step; at -= step) {
    cuts.push_back(at);
    step *= 4;
  }
  std::reverse(cuts.begin(), cuts.end());
  step = size;
  for (double at = hi + size; at < box.hi[axis] - step; at += step) {
    cuts.push_back(at);
    step *= 4;
  }
  return cuts;
}

// Boxes cut along an axis, at the ascending cuts that lie inside each.
std::vector<UnitBox> cut_boxes(const std::vector<UnitBox>& boxes, std::size_t axis, const std::vector<double>& cuts) {
  std::vector<UnitBox> finer;
  for (UnitBox box : boxes) {
    for (const double at : cuts) {
      if (!(at > box.lo[axis] && at < box.hi[axis])) continue;
      finer.push_back(box);
      finer.back().hi[axis] = box.lo[axis] = at;
    }
    finer.push_back(box);
  }
  return finer;
}

// The smallest box around the pilot's points in each cell.
std::vector<UnitBox> extents(const Partition& partition, const Pilot& pilot) {
  std::vector<UnitBox> extent(static_cast<std::size_t>(partition.size()), UnitBox{{2, 2, 2}, {-1, -1, -1}});
  for (const Subject::Coordinates& v : pilot.points) {
    UnitBox& e = extent[static_cast<std::size_t>(partition.cell(v))];
    for (std::size_t d = 0; d < 3; ++d) {
      e.lo[d] = std::min(e.lo[d], v[d]);
      e.hi[d] = std::max(e.hi[d], v[d]);
    }
  }
  return extent;
}

Cell empty_cell(const Subject& s, const Pilot& pilot, const UnitBox& box) {
  Cell c;
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
    c.rank_lo[d] = pilot.rank(d, box.lo[d]);
    c.rank_hi[d] = box.hi[d] < 1 ? pilot.rank(d, box.hi[d]) : 1.0;
  }
  return c;
}

} // namespace

int tree_depth(double samples) { return std::clamp(static_cast<int>(std::log2(std::max(samples, 1.0) / 200)), 0, 12); }

CellMasses integrate_cells(const Subject& s, const Pilot& pilot, double n, std::size_t max_evaluations) {
  const double points = static_cast<double>(pilot.points.size()), draws = static_cast<double>(pilot.tally.draws);
  CellMasses result{Partition(pilot.points, s.dim, tree_depth(n * points / draws)), {}, {}};
  const std::vector<UnitBox> extent = extents(result.partition, pilot);
  std::vector<UnitBox> pieces;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < extent.size(); ++i) {
    const UnitBox box = result.partition.box(static_cast<int>(i));
    result.cells.push_back(empty_cell(s, pilot, box));
    std::vector<UnitBox> parts{box};
    for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d)
      parts = cut_boxes(parts, d, cuts_beside(extent[i].lo[d], extent[i].hi[d], box, d));
    pieces.insert(pieces.end(), parts.begin(), parts.end());
    owner.insert(owner.end(), parts.size(), i);
  }
  CubatureGoal goal;
  goal.total_error = 0.06 / std::sqrt(n);
  goal.box_error = [n](double value) { return 0.04 * std::sqrt(std::max(value, 1 / n) / n); };
  goal.max_evaluations = max_evaluations;
  result.integrals = integrate_boxes(s.density, s.dim, pieces, goal);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    result.cells[owner[i]].p += result.integrals.boxes[i].value;
    result.cells[owner[i]].error += result.integrals.boxes[i].error;
  }
  return result;
}

} // namespace mc
