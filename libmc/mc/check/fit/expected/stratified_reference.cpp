#include <mc/check/fit/expected/stratified_reference.h>

#include <mc/check/fit/interior_density.h>
#include <mc/core/types.h>
#include <mc/random/pcg.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mc {
namespace {

constexpr std::size_t points_of_stratum = 16; // largest number of pilot points
constexpr std::size_t most_strata = 1 << 18;
constexpr double cap_over_pilot = 16, cap_over_seen = 4, lobe_over_pilot = 4;

} // namespace

PilotCells::PilotCells(const Subject& s, const Pilot& pilot, int depth)
    : partition(pilot.points, s.dim, depth,
                [&s](const UnitBox& box, std::size_t axis, double position, const Subject::Coordinates& beside) {
                  return may_split(s, box, axis, position, beside);
                }),
      cell_of_point(partition.find_cells(pilot.points)) {}

std::vector<double> PilotCells::rounding_shares(const Subject& s, const Pilot& pilot) const {
  constexpr double steps = 2;
  struct Faces {
    UnitBox box;
    Subject::Coordinates near{}; // distance from the faces that rounding bridges
  };
  std::vector<std::optional<Faces>> faces(static_cast<std::size_t>(partition.size()));
  std::vector<double> shares(faces.size(), 0.0);
  for (std::size_t i = 0; i < pilot.points.size(); ++i) {
    const std::uint32_t cell = cell_of_point[i];
    const Subject::Coordinates& v = pilot.points[i];
    const bool first = !faces[cell];
    if (first) faces[cell].emplace().box = partition.box(static_cast<int>(cell));
    auto& [box, near] = *faces[cell];
    for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
      if (first) near[d] = steps * rounding_step(s, v, d);
      if (v[d] - box.lo[d] >= near[d] && box.hi[d] - v[d] >= near[d]) continue;
      Subject::Coordinates beyond = v;
      beyond[d] = v[d] - box.lo[d] < near[d] ? std::nextafter(box.lo[d], -1.0) : box.hi[d];
      if (beyond[d] < 0 || beyond[d] >= 1) continue;
      for (const std::size_t side : {std::size_t{cell}, static_cast<std::size_t>(partition.cell(beyond))})
        shares[side] += 1 / (steps * static_cast<double>(pilot.stats.draws));
    }
  }
  return shares;
}

// Splits cells into strata.
struct StratifiedReference::Builder {
  const Subject& subject;
  const Pilot& pilot;
  StratifiedReference& reference;
  Pcg random;
  struct Point {
    Subject::Coordinates v;
    double density;
  };
  using Points = std::span<Point>;
  std::vector<Point> all;        ///< pilot points, sorted by cell
  std::vector<std::size_t> ends; ///< ends of the cells in `all`

  Builder(const Subject& s, const Pilot& p, const PilotCells& cells, StratifiedReference& r, std::uint64_t seed)
      : subject(s), pilot(p), reference(r), random(seed), all(p.points.size()),
        ends(static_cast<std::size_t>(cells.partition.size()) + 1) {
    for (const std::uint32_t c : cells.cell_of_point) ++ends[c + 1];
    for (std::size_t c = 1; c < ends.size(); ++c) ends[c] += ends[c - 1];
    for (std::size_t i = all.size(); i-- > 0;) all[--ends[cells.cell_of_point[i] + 1]] = {p.points[i], p.densities[i]};
    // Each end has decreased to the begin of its cell.
    ends.erase(ends.begin());
    ends.push_back(all.size());
  }
  Points of_cell(std::size_t cell) { return Points(all).subspan(ends[cell], ends[cell + 1] - ends[cell]); }

  // Returns the shortest binary fraction near the median of the points.
  std::optional<double> middle(Points points, const UnitBox& box, std::size_t axis) const {
    const auto n = static_cast<std::ptrdiff_t>(points.size());
    const auto upper = points.begin() + n / 2;
    const auto less = [&](const Point& a, const Point& b) { return a.v[axis] < b.v[axis]; };
    std::nth_element(points.begin(), upper, points.end(), less);
    const double lo = std::max_element(points.begin(), upper, less)->v[axis], hi = upper->v[axis];
    if (!(lo < hi)) return {};
    const double position = shortest_binary_fraction(lo, hi);
    return may_split(subject, box, axis, position, upper->v) ? std::optional(position) : std::nullopt;
  }

  // Returns the pilot point with the largest density if the box should contain far more points according to this
  // density; else null.
  const Point* hidden_lobe(Points points, const UnitBox& box) const {
    if (points.empty()) return nullptr;
    const auto lower = [](const Point& a, const Point& b) { return a.density < b.density; };
    const Point& top = *std::max_element(points.begin(), points.end(), lower);
    const double claimed = top.density * volume(box, subject.dim) * static_cast<double>(pilot.stats.draws);
    return claimed > lobe_over_pilot * static_cast<double>(points.size() + 1) ? &top : nullptr;
  }

  // Returns the axis of the box along which a lobe is narrowest, where the density next to its point falls most.
  std::size_t narrowest(const Point& lobe, const UnitBox& box, std::size_t first) {
    const auto dim = static_cast<std::size_t>(subject.dim);
    std::size_t axis = first;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < dim; ++i) {
      const std::size_t d = (first + i) % dim;
      double seen = 0;
      for (int k = 0; k < 2; ++k) {
        Subject::Coordinates v = lobe.v;
        v[d] = box.lo[d] + (box.hi[d] - box.lo[d]) * random.uniform<double>();
        seen += interior_density(subject, v);
      }
      if (seen < least) {
        least = seen;
        axis = d;
      }
    }
    return axis;
  }

  // Whether the box is so narrow that samples of a coarse scalar fall into it by chance.
  bool is_rounded(const UnitBox& box, const Subject::Coordinates& inside) const {
    bool rounded = false;
    for (std::size_t d = 0; d < static_cast<std::size_t>(subject.dim); ++d)
      rounded = rounded || box.hi[d] - box.lo[d] < min_resolved_steps * rounding_step(subject, inside, d);
    return rounded;
  }

  void add_stratum(std::size_t node, std::uint32_t cell, Points points, const UnitBox& box) {
    double seen = HUGE_VAL;
    for (int k = 0; k < 2; ++k) {
      const double density = interior_density(subject, random_point(box, subject.dim, random));
      seen = density >= 0 ? std::min(seen, density) : 0.0;
    }
    const double draws = static_cast<double>(pilot.stats.draws);
    const double density = static_cast<double>(points.size() + 1) / (draws * volume(box, subject.dim));
    const double cap = std::max(cap_over_pilot * density, cap_over_seen * seen);
    reference.nodes_[node].axis = -1;
    reference.nodes_[node].index = static_cast<std::uint32_t>(reference.strata_.size());
    reference.boxes_.push_back(box);
    Subject::Coordinates middle{};
    for (std::size_t d = 0; d < max_chart_dim; ++d) middle[d] = 0.5 * (box.lo[d] + box.hi[d]);
    const bool narrow = is_rounded(box, points.empty() ? middle : points.front().v);
    reference.strata_.push_back({cell, reference.nodes_[node].index, cap, narrow ? 0.0 : density, 0});
  }

  void split(std::size_t node, std::uint32_t cell, Points points, const UnitBox& box, int level) {
    const auto first = static_cast<std::size_t>(level % subject.dim), dim = static_cast<std::size_t>(subject.dim);
    std::optional<double> position;
    std::size_t axis = first;
    const bool room = reference.strata_.size() < most_strata && level < 256;
    if (room && points.size() >= points_of_stratum)
      for (std::size_t i = 0; i < dim && !position; ++i) position = middle(points, box, axis = (first + i) % dim);
    if (const Point* lobe = room && !position ? hidden_lobe(points, box) : nullptr) {
      axis = narrowest(*lobe, box, first);
      position = 0.5 * (box.lo[axis] + box.hi[axis]);
      if (!may_split(subject, box, axis, *position, lobe->v)) position.reset();
    }
    if (!position) return add_stratum(node, cell, points, box);
    const auto middle =
        std::partition(points.begin(), points.end(), [&](const Point& p) { return p.v[axis] < *position; });
    const auto below = static_cast<std::size_t>(middle - points.begin());
    const std::size_t children = reference.nodes_.size();
    reference.nodes_[node] = {*position, static_cast<int>(axis), static_cast<std::uint32_t>(children)};
    reference.nodes_.resize(children + 2);
    UnitBox left = box, right = box;
    left.hi[axis] = right.lo[axis] = *position;
    split(children, cell, points.first(below), left, level + 1);
    split(children + 1, cell, points.subspan(below), right, level + 1);
  }
};

StratifiedReference::StratifiedReference(const Subject& s, const Pilot& pilot, const PilotCells& cells,
                                         std::uint64_t seed)
    : dim_(s.dim), cells_(static_cast<std::size_t>(cells.partition.size())), nodes_(1) {
  Builder builder(s, pilot, cells, *this, seed);
  add_cells(cells.partition, 1, 0, UnitBox{}, builder);
  // About four bins per stratum.
  const double bits = std::log2(4 * static_cast<double>(strata_.size())) / dim_;
  guide_size_ = std::size_t{1} << static_cast<int>(bits);
  Bin hi;
  hi.fill(1);
  std::size_t bins = 1;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim_); ++d, bins *= guide_size_)
    hi[d] = static_cast<std::uint32_t>(guide_size_);
  guide_.resize(bins);
  fill_guide(0, {}, hi);
}

// Adds the nodes below a split of the cells, in the order of the cells.
void StratifiedReference::add_cells(const Partition& cells, int split, std::size_t node, const UnitBox& box,
                                    Builder& builder) {
  if (split >= cells.size()) {
    const int cell = split - cells.size();
    return builder.split(node, static_cast<std::uint32_t>(cell), builder.of_cell(static_cast<std::size_t>(cell)), box,
                         0);
  }
  const auto [at, axis] = cells.split(split);
  if (at == Partition::no_split) return add_cells(cells, 2 * split, node, box, builder);
  const std::size_t children = nodes_.size();
  nodes_[node] = {at, static_cast<int>(axis), static_cast<std::uint32_t>(children)};
  nodes_.resize(children + 2);
  const auto [left, right] = Partition::halves(box, cells.split(split));
  add_cells(cells, 2 * split, children, left, builder);
  add_cells(cells, 2 * split + 1, children + 1, right, builder);
}

// Sets the guide for the bins from lo to hi, which the node contains.
void StratifiedReference::fill_guide(std::size_t node, Bin lo, Bin hi) {
  Bin left = hi, right = lo; // bins inside the children; the split cuts the bins between them
  const Node& n = nodes_[node];
  if (n.axis >= 0) {
    const auto axis = static_cast<std::size_t>(n.axis);
    const double at = n.position * static_cast<double>(guide_size_);
    const auto bounded = [&](double b) { return std::clamp(static_cast<std::uint32_t>(b), lo[axis], hi[axis]); };
    left[axis] = bounded(std::floor(at));
    right[axis] = bounded(std::ceil(at));
    if (lo[axis] < left[axis]) fill_guide(n.index, lo, left);
    if (right[axis] < hi[axis]) fill_guide(n.index + 1, right, hi);
    lo[axis] = left[axis];
    hi[axis] = right[axis];
  }
  const auto dim = static_cast<std::size_t>(dim_);
  for (std::size_t d = 0; d < dim; ++d)
    if (lo[d] == hi[d]) return;
  for (Bin at = lo;;) {
    std::size_t index = 0, d = dim - 1;
    for (std::size_t axis = 0; axis < dim; ++axis) index = index * guide_size_ + at[axis];
    guide_[index] = static_cast<std::uint32_t>(node);
    for (; ++at[d] == hi[d]; --d) {
      at[d] = lo[d];
      if (d == 0) return;
    }
  }
}

std::vector<const StratifiedReference::Stratum*>
StratifiedReference::find_strata(std::span<const Subject::Coordinates> points) const {
  std::vector<std::uint32_t> at(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) at[i] = guide_[bin(points[i])];
  // Points that have not reached a stratum come first; no branch depends on their direction.
  std::vector<std::uint32_t> under_way(points.size());
  std::iota(under_way.begin(), under_way.end(), 0u);
  for (std::size_t left = points.size(), now = left; now > 0; now = left) {
    left = 0;
    for (std::size_t k = 0; k < now; ++k) {
      const std::uint32_t i = under_way[k];
      const Node& node = nodes_[at[i]];
      const bool inner = node.axis >= 0;
      at[i] = node.index + (inner & (points[i][inner ? static_cast<std::size_t>(node.axis) : 0] >= node.position));
      under_way[left] = i;
      left += inner;
    }
  }
  std::vector<const Stratum*> found(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) found[i] = &strata_[at[i]];
  return found;
}

} // namespace mc
