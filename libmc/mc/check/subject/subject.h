#pragma once
/// Anything that draws points with a claimed density, reduced to what the statistical tests need.

#include <mc/check/subject/axis.h>
#include <mc/domain/concept.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mc {

/// A sampler with its claimed density, seen through the chart of its domain: the tests live on the unit cube and never
/// ask what the domain was. Warps, pairs of lambdas, BSDFs, tables, plugins and files of samples all become Subjects;
/// see make_subject.h for the first two.
struct Subject {
  using Coordinates = std::array<double, 3>; ///< of the unit cube; unused entries are 0

  std::string name;
  int dim = 0;            ///< 0: discrete outcomes only
  std::vector<Axis> axes; ///< what the coordinates stand for; may be empty

  /// One draw, or why there is none.
  ///   failed     : the sampler returned nothing, which counts against 1 - mass and is an error unless may_fail
  ///   outside    : a finite point that is not in the domain, say a direction that is not unit
  ///   not_finite : a NaN or an infinity
  struct Draw {
    enum class Kind : std::uint8_t { point, atom, failed, outside, not_finite } kind = Kind::point;
    bool pdf_positive = true; ///< the claimed density at the drawn point is positive and finite
    int atom = -1;            ///< index of a discrete outcome (delta lobe, table index)
    Coordinates v{};
    double weight = 1;   ///< claimed weight * pdf / f where the sampler states a weight; 1 when they agree
    double density = -1; ///< Subject::density at v where the draw knows it, else negative
  };
  /// Appends n draws of the stream `seed` to `out`. Same seed, same draws.
  std::function<void(std::uint64_t seed, std::size_t n, std::vector<Draw>& out)> draw;

  /// Claimed density in chart coordinates, pdf(from_unit(v)) * jacobian(v): integrates to 1 - P(atom) - P(failure).
  std::function<double(const Coordinates& v)> density;
  /// The same at many points, for a subject that answers many at once faster than one by one; may be empty.
  std::function<void(std::span<const Coordinates> v, std::span<double> densities)> densities;

  /// Chart coordinates, ascending, where the density may jump along each axis, as between the bins of a table: between
  /// them its integral is found from few points, and exactly where it is constant. May be empty.
  std::array<std::vector<double>, 3> breaks;

  /// Claimed probabilities of the discrete outcomes; empty for a continuous subject.
  std::vector<double> atoms;
  bool may_fail = false;

  double mass_tolerance = 1e-12;  ///< rounding error of the claimed density, relative
  double weight_tolerance = 1e-4; ///< largest |weight - 1|, beyond what the density changes as the point is rounded

  /// The points of the unit cube that n draws of the stream `seed` come from, as the sampler's own inverse says of each
  /// that gives a point of the domain, NaN where it finds none; may be empty.
  std::function<std::vector<Coordinates>(std::uint64_t seed, std::size_t n)> inverted;
  double invert_error = 0; ///< bound on the error of its coordinates

  double epsilon = 2.220446049250313e-16; ///< of the scalar that the points are computed in
  /// How far one unit in the last place of the point at v moves chart coordinate `axis`; empty: epsilon times v.
  std::function<double(const Coordinates& v, int axis)> resolution;
  /// The numbers behind draw `index` of stream `seed` in full precision; may be empty.
  std::function<std::string(std::uint64_t seed, std::uint64_t index)> describe_draw;
  /// "weight is 0.6, should be 0.5" for draw `index` of stream `seed`, and the likely reason after "; "; may be empty.
  std::function<std::string(std::uint64_t seed, std::uint64_t index)> describe_weight;
  /// The point of the domain at chart coordinates v; may be empty.
  std::function<std::string(const Coordinates& v)> describe_point;
};

} // namespace mc
