#include <mc/check/fit/expected/estimated_mass.h>

#include <limits>

namespace mc {

double EstimatedMass::shown_variance() const { return variance + 3 * std::sqrt(2 * variance_square); }

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

Subject::Coordinates mirrored(const Subject::Coordinates& v, const UnitBox& box, int dim) {
  Subject::Coordinates w{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
    w[d] = std::clamp(box.lo[d] + (box.hi[d] - v[d]), box.lo[d], box.hi[d]);
  return w;
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

Seen add_box(const Subject& s, const UnitBox& box, std::size_t per_axis, Pcg& random, EstimatedMass& mass) {
  Seen seen;
  const auto evaluate = [&](const Subject::Coordinates& v, double stands_for) {
    const double density = density_inside(s, v);
    const double finite = density >= 0 && density <= std::numeric_limits<double>::max() ? density : 0.0;
    seen.density = std::max(seen.density, finite);
    seen.volume = std::max(seen.volume, stands_for);
    return std::array{finite};
  };
  add_pairs<1>(box, s.dim, s.breaks, per_axis, random, evaluate, {&mass});
  return seen;
}

double density_inside(const Subject& s, Subject::Coordinates v) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) v[d] = std::clamp(v[d], 0x1p-60, 1 - 0x1p-53);
  return s.density(v);
}

void LinearFit::add(const Subject::Coordinates& v, double density, double part) {
  std::array<double, 4>& d = differences_.emplace_back();
  const double size = 4 * part; // of the box
  for (std::size_t i = 0; i < dim_; ++i) d[i] = size * v[i];
  d[3] = size * density;
  if (++points_ % 2 != 0) return;
  const std::array<double, 4> mirrored = differences_.back();
  differences_.pop_back();
  for (std::size_t i = 0; i < 4; ++i) differences_.back()[i] -= mirrored[i];
}

double LinearFit::largest_residual() {
  std::array<double, 3> slope{};
  const auto residual = [&](const std::array<double, 4>& d) {
    return d[3] - slope[0] * d[0] - slope[1] * d[1] - slope[2] * d[2];
  };
  for (int sweep = 0; sweep < 16; ++sweep)
    for (std::size_t i = 0; i < dim_; ++i) {
      double product = 0, square = 0;
      for (const std::array<double, 4>& d : differences_) {
        product += d[i] * residual(d);
        square += d[i] * d[i];
      }
      if (square > 0) slope[i] += product / square;
    }
  double largest = 0;
  for (const std::array<double, 4>& d : differences_) largest = std::max(largest, std::abs(residual(d)));
  differences_.clear();
  return largest;
}

} // namespace mc
