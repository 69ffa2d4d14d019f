#include <mc/check/fit/expected/estimated_mass.h>

#include <mc/check/fit/interior_density.h>
#include <mc/check/fit/pilot.h>
#include <mc/core/types.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc {

double EstimatedMass::conservative_variance() const { return variance + 3 * std::sqrt(2 * variance_square); }

double EstimatedMass::variance_with_jumps(std::size_t passes) const {
  const double n = static_cast<double>(passes);
  return conservative_variance() + sqr(n * jump) * hidden_jump_variance(4 * n);
}

double hidden_jump_variance(double points) { return std::min(32 / ((points + 1) * (points + 2) * (points + 3)), 1.0); }

void EstimatedMass::add_part(double volume, std::span<const double, 4> density) {
  const double a = 0.5 * (density[0] + density[1]), b = 0.5 * (density[2] + density[3]);
  const double off = volume * (a - b), mean = 0.5 * volume * (a + b), square = sqr(0.5 * off);
  value += mean;
  variance += square;
  variance_square += sqr(square);
  largest = std::max(largest, mean);
  jump = std::max(jump, std::abs(off));
}

bool may_split(const Subject& s, const UnitBox& box, std::size_t axis, double place,
               const Subject::Coordinates& beside) {
  const double least = std::min(place - box.lo[axis], box.hi[axis] - place);
  return least > 0 && least >= min_resolved_steps * rounding_step(s, beside, axis);
}

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

namespace {

// Cuts an axis of a box at the breaks inside, and evenly between them into at least `least` intervals.
void cut_axis(double lo, double hi, const std::vector<double>& breaks, std::size_t least, std::vector<double>& ends) {
  ends.assign(1, lo);
  const auto cut_to = [&](double end, std::size_t parts) {
    const double begin = ends.back();
    for (std::size_t k = 1; k < parts; ++k)
      ends.push_back(begin + (end - begin) * static_cast<double>(k) / static_cast<double>(parts));
    ends.push_back(end);
  };
  const auto first = std::upper_bound(breaks.begin(), breaks.end(), lo),
             last = std::lower_bound(first, breaks.end(), hi);
  const auto intervals = static_cast<std::size_t>(last - first) + 1;
  const std::size_t parts = (least + intervals - 1) / intervals;
  for (auto b = first; b != last; ++b) cut_to(*b, parts);
  cut_to(hi, parts);
}

} // namespace

void AntitheticPoints::add(const UnitBox& whole, int dim, const PerAxis<std::vector<double>>& breaks,
                           std::size_t per_axis, Pcg& random) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d)
    cut_axis(whole.lo[d], whole.hi[d], breaks[d], per_axis, ends[d]);
  const auto last = static_cast<std::size_t>(dim) - 1;
  PerAxis<std::size_t> part{}; // along each axis
  for (std::size_t d = 0;;) {
    UnitBox box;
    for (std::size_t axis = 0; axis <= last; ++axis) {
      box.lo[axis] = ends[axis][part[axis]];
      box.hi[axis] = ends[axis][part[axis] + 1];
    }
    volumes.push_back(volume(box, dim));
    for (int pair = 0; pair < 2; ++pair) {
      points.push_back(random_point(box, dim, random));
      points.push_back(mirrored(points.back(), box, dim));
    }
    for (d = last; ++part[d] + 1 == ends[d].size(); --d) {
      part[d] = 0;
      if (d == 0) return;
    }
  }
}

BoxMaxima add_box(const Subject& s, const UnitBox& box, std::size_t per_axis, Pcg& random, EstimatedMass& mass) {
  AntitheticPoints paired;
  paired.add(box, s.dim, s.breaks, per_axis, random);
  std::vector<double> densities(paired.points.size());
  interior_densities(s, paired.points, densities);
  BoxMaxima seen;
  for (double& d : densities) {
    d = d >= 0 && d <= std::numeric_limits<double>::max() ? d : 0.0;
    seen.density = std::max(seen.density, d);
  }
  for (std::size_t i = 0; i < paired.volumes.size(); ++i) {
    seen.volume = std::max(seen.volume, paired.volumes[i] / 4);
    mass.add_part(paired.volumes[i], std::span<const double, 4>(&densities[4 * i], 4));
  }
  return seen;
}

void LinearFit::add(const Subject::Coordinates& v, double density, double part) {
  const double size = 4 * part; // volume of the box
  Difference point{};
  for (std::size_t i = 0; i < dim_; ++i) point[i] = size * v[i];
  point[dim_] = size * density;
  half_ = !half_;
  if (half_) return differences_.push_back(point);
  Difference& d = differences_.back();
  for (std::size_t i = 0; i <= dim_; ++i) d[i] -= point[i];
  for (std::size_t i = 0; i < dim_; ++i)
    for (std::size_t j = 0; j <= dim_; ++j) products_[i][j] += d[i] * d[j];
}

double LinearFit::largest_residual() {
  // Gauss-Seidel iteration, which also converges for a singular matrix.
  PerAxis<double> slope{};
  const auto residual = [&](const Difference& d) {
    double r = d[dim_];
    for (std::size_t i = 0; i < dim_; ++i) r -= slope[i] * d[i];
    return r;
  };
  for (int sweep = 0; sweep < 16; ++sweep)
    for (std::size_t i = 0; i < dim_; ++i)
      if (products_[i][i] > 0) slope[i] += residual(products_[i]) / products_[i][i];
  double largest = 0;
  for (const Difference& d : differences_) largest = std::max(largest, std::abs(residual(d)));
  differences_.clear();
  products_ = {};
  return largest;
}

} // namespace mc
