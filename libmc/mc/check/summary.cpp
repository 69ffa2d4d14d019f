#include <mc/check/summary.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mc {

std::vector<WorstCell> worst_cells(const Subject& s, const std::vector<UnitBox>& boxes, const std::vector<Cell>& cells,
                                   double scale) {
  const auto z = [&](std::size_t i) {
    const double expected = scale * cells[i].p;
    return (cells[i].observed - expected) / std::sqrt(std::max(expected, 0.5));
  };
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto five = order.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(order.size(), 5));
  std::partial_sort(order.begin(), five, order.end(),
                    [&](std::size_t a, std::size_t b) { return std::abs(z(a)) > std::abs(z(b)); });
  std::vector<WorstCell> worst;
  for (auto i = order.begin(); i != five; ++i) {
    WorstCell w{{}, {}, cells[*i].observed, scale * cells[*i].p, z(*i), {}};
    if (*i < boxes.size()) {
      w.lo = boxes[*i].lo;
      w.hi = boxes[*i].hi;
      Subject::Coordinates centre;
      for (std::size_t d = 0; d < 3; ++d) centre[d] = 0.5 * (w.lo[d] + w.hi[d]);
      if (s.describe_point) w.where = s.describe_point(centre);
    } else {
      w.where = fmt::format("outcome {}", *i - boxes.size());
    }
    worst.push_back(std::move(w));
  }
  return worst;
}

void add_counts(const std::vector<UnitBox>& boxes, const std::vector<Cell>& cells, double scale, Evidence& evidence) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    CellCount c{{}, {}, cells[i].observed, scale * cells[i].p};
    if (i < boxes.size()) {
      c.lo = boxes[i].lo;
      c.hi = boxes[i].hi;
    }
    (i < boxes.size() ? evidence.cells : evidence.outcomes).push_back(c);
  }
}

std::vector<Axis> named_axes(const Subject& s) {
  std::vector<Axis> axes;
  if (s.dim > 0) axes = s.axes;
  for (int i = static_cast<int>(axes.size()); i < s.dim; ++i) axes.push_back({fmt::format("v{}", i)});
  return axes;
}

} // namespace mc
