#include <mc/check/fit/explanations/summary.h>

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
      for (std::size_t d = 0; d < max_chart_dim; ++d) centre[d] = 0.5 * (w.lo[d] + w.hi[d]);
      if (s.describe_point) w.where = s.describe_point(centre);
    } else {
      w.where = fmt::format("outcome {}", *i - boxes.size());
    }
    worst.push_back(std::move(w));
  }
  return worst;
}

namespace {

// The cells [lo, hi) and their counts.
struct Region {
  std::size_t lo = 0, hi = 0;
  double observed = 0, expected = 0, z = 0;
};

// Prefix sums over the cells.
struct PrefixSums {
  std::vector<double> p{0}, variance{0}, observed{0};

  explicit PrefixSums(const std::vector<Cell>& cells) {
    for (const Cell& c : cells) {
      p.push_back(p.back() + c.p);
      variance.push_back(variance.back() + c.variance);
      observed.push_back(observed.back() + c.observed);
    }
  }
  Region region(std::size_t lo, std::size_t hi) const {
    const double n = observed.back(), total = p.back(), q = (p[hi] - p[lo]) / total;
    Region r{lo, hi, observed[hi] - observed[lo], n * q, 0};
    const double spread = n * q * (1 - q) + n * n * (variance[hi] - variance[lo]) / (total * total);
    r.z = (r.observed - r.expected) / std::sqrt(std::max(spread, 0.5));
    return r;
  }
};

// Returns the smallest box that contains the boxes [lo, hi).
UnitBox enclosing_box(const std::vector<UnitBox>& boxes, std::size_t lo, std::size_t hi) {
  UnitBox all = boxes[lo];
  for (std::size_t i = lo; i < hi; ++i)
    for (std::size_t d = 0; d < max_chart_dim; ++d) {
      all.lo[d] = std::min(all.lo[d], boxes[i].lo[d]);
      all.hi[d] = std::max(all.hi[d], boxes[i].hi[d]);
    }
  return all;
}

std::string describe_box(const Subject& s, const UnitBox& box) {
  std::string text = describe_cell(named_axes(s), box.lo, box.hi);
  if (!s.describe_point) return text;
  Subject::Coordinates centre;
  for (std::size_t d = 0; d < max_chart_dim; ++d) centre[d] = 0.5 * (box.lo[d] + box.hi[d]);
  return text + ", about " + s.describe_point(centre) + ",";
}

} // namespace

std::string describe_worst_region(const Subject& s, const std::vector<UnitBox>& boxes, const std::vector<Cell>& cells) {
  constexpr double least_telling = 4; // chance rarely exceeds this in the worst of a few thousand regions
  const PrefixSums sums(cells);
  if (!(sums.p.back() > 0)) return {};
  Region worst;
  const auto consider = [&](std::size_t lo, std::size_t hi) {
    const Region r = sums.region(lo, hi);
    if (std::abs(r.z) > std::abs(worst.z)) worst = r;
  };
  for (std::size_t length = 1; length < std::max<std::size_t>(boxes.size(), 1); length *= 2)
    for (std::size_t lo = 0; lo + length <= boxes.size(); lo += length) consider(lo, lo + length);
  for (std::size_t i = boxes.size(); i < cells.size(); ++i) consider(i, i + 1);
  if (!(std::abs(worst.z) >= least_telling)) return {};
  const std::string counts =
      fmt::format("{:.0f} samples, {:.1f} expected (z = {:.1f})", worst.observed, worst.expected, worst.z);
  if (worst.lo >= boxes.size()) return fmt::format("outcome {} has {}", worst.lo - boxes.size(), counts);
  return fmt::format("{} {} contains {}", worst.hi - worst.lo == 1 ? "cell" : "region",
                     describe_box(s, enclosing_box(boxes, worst.lo, worst.hi)), counts);
}

void add_counts(const std::vector<UnitBox>& boxes, const std::vector<Cell>& cells, double scale, PlotData& evidence) {
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
