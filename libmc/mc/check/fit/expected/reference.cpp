#include <mc/check/fit/expected/reference.h>

#include <mc/core/types.h>
#include <mc/random/pcg.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mc {
namespace {

constexpr std::size_t points_of_stratum = 8; // of the pilot, at most
constexpr std::size_t most_strata = 1 << 18;
constexpr double cap_over_pilot = 16, cap_over_seen = 4, lobe_over_pilot = 4;

double volume(const UnitBox& box, int dim) {
  double product = 1;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) product *= box.hi[d] - box.lo[d];
  return product;
}

Subject::Coordinates random_point(const UnitBox& box, int dim, Pcg& random) {
  Subject::Coordinates v{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
    v[d] = box.lo[d] + (box.hi[d] - box.lo[d]) * random.uniform<double>();
  return v;
}

// Where an axis of a box is cut: at the breaks inside, and evenly between them until there are `least` intervals.
std::vector<double> cut_axis(double lo, double hi, const std::vector<double>& breaks, std::size_t least) {
  std::vector<double> ends{lo};
  for (auto b = std::upper_bound(breaks.begin(), breaks.end(), lo); b != breaks.end() && *b < hi; ++b)
    ends.push_back(*b);
  ends.push_back(hi);
  const std::size_t parts = (least + ends.size() - 2) / (ends.size() - 1);
  if (parts < 2) return ends;
  std::vector<double> finer;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (std::size_t k = 0; k < parts; ++k)
      finer.push_back(ends[i] + (ends[i + 1] - ends[i]) * static_cast<double>(k) / static_cast<double>(parts));
  finer.push_back(hi);
  return finer;
}

// Calls evaluate(box) twice for each part of a box.
template <class F>
void add_pairs(const UnitBox& whole, int dim, const std::array<std::vector<double>, 3>& breaks, std::size_t per_axis,
               F&& evaluate, EstimatedMass& mass) {
  std::array<std::vector<double>, 3> ends{{{0, 1}, {0, 1}, {0, 1}}};
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
    ends[d] = cut_axis(whole.lo[d], whole.hi[d], breaks[d], per_axis);
  for (std::size_t i = 0; i + 1 < ends[0].size(); ++i)
    for (std::size_t j = 0; j + 1 < ends[1].size(); ++j)
      for (std::size_t k = 0; k + 1 < ends[2].size(); ++k) {
        const UnitBox box{{ends[0][i], ends[1][j], ends[2][k]}, {ends[0][i + 1], ends[1][j + 1], ends[2][k + 1]}};
        const double a = evaluate(box), b = evaluate(box), size = volume(box, dim);
        const double variance = sqr(0.5 * size * (a - b));
        mass.value += 0.5 * size * (a + b);
        mass.variance += variance;
        mass.variance_square += sqr(variance);
        mass.largest = std::max(mass.largest, size * std::max(a, b));
      }
}

} // namespace

EstimatedMass estimate_mass(const Subject& s, const std::vector<UnitBox>& boxes, std::size_t per_axis,
                            std::uint64_t seed) {
  Pcg random(seed);
  EstimatedMass mass;
  const auto evaluate = [&](const UnitBox& box) {
    const double density = density_inside(s, random_point(box, s.dim, random));
    return density >= 0 && density <= std::numeric_limits<double>::max() ? density : 0.0;
  };
  for (const UnitBox& box : boxes) add_pairs(box, s.dim, s.breaks, per_axis, evaluate, mass);
  return mass;
}

double density_inside(const Subject& s, Subject::Coordinates v) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) v[d] = std::clamp(v[d], 0x1p-60, 1 - 0x1p-53);
  return s.density(v);
}

// Splits cells into strata; points are indices into the pilot.
struct Reference::Builder {
  const Subject& subject;
  const Pilot& pilot;
  Reference& reference;
  Pcg random;
  using Points = std::span<std::uint32_t>;

  double at(std::uint32_t point, std::size_t axis) const { return pilot.points[point][axis]; }

  // Halfway through the points, at the shortest binary fraction.
  std::optional<double> middle(Points points, const UnitBox& box, std::size_t axis) const {
    const auto n = static_cast<std::ptrdiff_t>(points.size());
    const auto less = [&](std::uint32_t a, std::uint32_t b) { return at(a, axis) < at(b, axis); };
    const auto quantile = [&](std::ptrdiff_t k) {
      std::nth_element(points.begin(), points.begin() + k, points.end(), less);
      return at(points[static_cast<std::size_t>(k)], axis);
    };
    const double lo = quantile(n / 2 - 1), hi = quantile(n / 2);
    if (!(lo < hi)) return {};
    const double place = shortest_binary_fraction(lo, hi);
    if (place > box.lo[axis] && place < box.hi[axis]) return place;
    return {};
  }

  // Whether the density at a point of the pilot says that the box should have held far more of them.
  bool hides_a_lobe(Points points, const UnitBox& box) const {
    double largest = 0;
    for (const std::uint32_t i : points) largest = std::max(largest, pilot.densities[i]);
    const double draws = static_cast<double>(pilot.tally.draws);
    return largest * volume(box, subject.dim) * draws > lobe_over_pilot * static_cast<double>(points.size() + 1);
  }

  void add_stratum(std::size_t node, std::uint32_t cell, Points points, const UnitBox& box) {
    double seen = HUGE_VAL;
    for (int k = 0; k < 2; ++k) {
      const double density = density_inside(subject, random_point(box, subject.dim, random));
      seen = density >= 0 ? std::min(seen, density) : 0.0;
    }
    const double draws = static_cast<double>(pilot.tally.draws);
    const double density = static_cast<double>(points.size() + 1) / (draws * volume(box, subject.dim));
    const double cap = std::max(cap_over_pilot * density, cap_over_seen * seen);
    reference.nodes_[node].axis = -1;
    reference.nodes_[node].index = static_cast<std::uint32_t>(reference.places_.size());
    reference.boxes_.push_back(box);
    reference.places_.push_back({cell, reference.nodes_[node].index, cap, density});
  }

  void split(std::size_t node, std::uint32_t cell, Points points, const UnitBox& box, int level) {
    const auto first = static_cast<std::size_t>(level % subject.dim), dim = static_cast<std::size_t>(subject.dim);
    std::optional<double> place;
    std::size_t axis = first;
    const bool room = reference.places_.size() < most_strata && level < 256;
    if (room && points.size() >= points_of_stratum)
      for (std::size_t i = 0; i < dim && !place; ++i) place = middle(points, box, axis = (first + i) % dim);
    if (room && !place && hides_a_lobe(points, box)) {
      axis = first;
      place = 0.5 * (box.lo[axis] + box.hi[axis]);
      if (!(*place > box.lo[axis] && *place < box.hi[axis])) place.reset();
    }
    if (!place) return add_stratum(node, cell, points, box);
    const auto middle =
        std::partition(points.begin(), points.end(), [&](std::uint32_t i) { return at(i, axis) < *place; });
    const auto below = static_cast<std::size_t>(middle - points.begin());
    const std::size_t children = reference.nodes_.size();
    reference.nodes_[node] = {*place, static_cast<int>(axis), static_cast<std::uint32_t>(children)};
    reference.nodes_.resize(children + 2);
    UnitBox left = box, right = box;
    left.hi[axis] = right.lo[axis] = *place;
    split(children, cell, points.first(below), left, level + 1);
    split(children + 1, cell, points.subspan(below), right, level + 1);
  }
};

Reference::Reference(const Subject& s, const Partition& cells, const Pilot& pilot, std::uint64_t seed)
    : cells_(cells), dim_(s.dim), nodes_(static_cast<std::size_t>(cells.size())) {
  std::vector<std::vector<std::uint32_t>> points(nodes_.size());
  for (std::uint32_t i = 0; i < pilot.points.size(); ++i)
    points[static_cast<std::size_t>(cells.cell(pilot.points[i]))].push_back(i);
  Builder builder{s, pilot, *this, Pcg(seed)};
  for (std::size_t i = 0; i < points.size(); ++i)
    builder.split(i, static_cast<std::uint32_t>(i), points[i], cells.box(static_cast<int>(i)), 0);
}

std::vector<const Reference::Place*> Reference::places(std::span<const Subject::Coordinates> points) const {
  std::vector<std::uint32_t> at(points.size());
  cells_.find_cells(points, at);
  // Those that have not arrived at a stratum come first; no branch depends on where they go.
  std::vector<std::uint32_t> under_way(points.size());
  std::iota(under_way.begin(), under_way.end(), 0u);
  for (std::size_t left = points.size(), now = left; now > 0; now = left) {
    left = 0;
    for (std::size_t k = 0; k < now; ++k) {
      const std::uint32_t i = under_way[k];
      const Node& node = nodes_[at[i]];
      const bool inner = node.axis >= 0;
      at[i] = node.index + (inner & (points[i][inner ? static_cast<std::size_t>(node.axis) : 0] >= node.at));
      under_way[left] = i;
      left += inner;
    }
  }
  std::vector<const Place*> found(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) found[i] = &places_[at[i]];
  return found;
}

double EstimatedMass::shown_variance() const { return variance + 3 * std::sqrt(2 * variance_square); }

Reference::Masses Reference::integrate(const Subject& s, const Goal& goal, std::uint64_t seed,
                                       const Visit& visit) const {
  Masses result;
  result.cells.resize(static_cast<std::size_t>(cells_.size()));
  result.volumes.resize(places_.size());
  const double each =
      static_cast<double>(std::max(goal.least, std::min(goal.most / 8, std::size_t(goal.samples / 2)))) /
      static_cast<double>(2 * places_.size());
  const auto least = static_cast<std::size_t>(std::max(1.0, std::floor(std::pow(each, 1.0 / dim_) + 1e-9)));
  std::array<std::vector<double>, 3> breaks = s.breaks;
  double boxes = 1;
  for (const std::vector<double>& axis : breaks) boxes *= static_cast<double>(axis.size() + 1);
  if (2 * boxes > static_cast<double>(goal.most)) breaks = {};

  Pcg random(seed);
  const auto evaluate = [&](const UnitBox& box, const Place& place) {
    const Subject::Coordinates v = random_point(box, dim_, random);
    double density = density_inside(s, v);
    ++result.evaluations;
    if (!(density >= 0 && density <= std::numeric_limits<double>::max())) {
      if (!result.bad) result.bad = v;
      density = 0;
    }
    const double capped = std::min(density, place.cap), half = 0.5 * volume(box, dim_);
    result.volumes[place.stratum] = std::max(result.volumes[place.stratum], half);
    if (visit) visit(v, place, density, capped * half);
    return capped;
  };
  const auto pass = [&] {
    for (std::size_t i = 0; i < places_.size(); ++i)
      add_pairs(
          boxes_[i], dim_, breaks, least, [&](const UnitBox& box) { return evaluate(box, places_[i]); },
          result.cells[places_[i].cell]);
  };
  // Passes until the variance of all cells together is a tenth of that of their counts. All passes count alike, and
  // only the sum over all cells decides how many there are, so that the choice biases nothing.
  double wanted = 1;
  while (static_cast<double>(result.passes) < wanted) {
    pass();
    if (++result.passes > 1) continue;
    double ratio = 0;
    for (const EstimatedMass& m : result.cells)
      if (m.value > 0) ratio += goal.samples * m.variance / m.value / static_cast<double>(result.cells.size());
    wanted = std::clamp(std::ceil(10 * ratio), 1.0,
                        std::max(1.0, static_cast<double>(goal.most) / static_cast<double>(result.evaluations)));
  }
  const double passes = static_cast<double>(result.passes);
  for (EstimatedMass& m : result.cells) {
    m.value /= passes;
    m.variance /= sqr(passes);
    m.variance_square /= sqr(sqr(passes));
    m.largest /= passes;
    result.total.largest = std::max(result.total.largest, m.largest);
    result.total.value += m.value;
    result.total.variance += m.variance;
    result.total.variance_square += m.variance_square;
  }
  return result;
}

} // namespace mc
