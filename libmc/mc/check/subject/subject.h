#pragma once
/// Anything that draws points with a claimed density, reduced to the needs of the statistical tests.

#include <mc/check/subject/axis.h>
#include <mc/domain/concept.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mc {

/// A distribution with its claimed density, in chart coordinates: the tests use the unit cube and are independent of
/// the domain. Warps, pairs of functions, BSDFs, tables, plugins and files of samples are all converted to Subjects;
/// see make_subject.h.
struct Subject {
  using Coordinates = PerAxis<double>; ///< A point of the unit cube; unused entries are 0.

  std::string name;       ///< name in the report
  int dim = 0;            ///< dimension of the chart; 0: only discrete outcomes
  std::vector<Axis> axes; ///< meaning of the coordinates; may be empty

  /// One draw, or the reason for its absence.
  ///   failed     : sample returned no value. The rate of failures is tested against 1 - mass; any failure is an error
  ///                unless may_fail is set.
  ///   outside    : a finite point outside the domain, for example a direction that is not a unit vector.
  ///   not_finite : a coordinate is NaN or infinite.
  struct Draw {
    /// Kind of a draw.
    enum class Kind : std::uint8_t {
      point,                  ///< a point of the domain
      atom,                   ///< a discrete outcome
      failed,                 ///< sample returned no value
      outside,                ///< a finite point outside the domain
      not_finite              ///< a coordinate is NaN or infinite
    } kind = Kind::point;     ///< kind of the draw
    bool pdf_positive = true; ///< the claimed density at the drawn point is positive and finite
    bool at_pole = false;     ///< so near a pole at an end of the chart that rounding decides whether the pdf is finite
    int atom = -1;            ///< index of a discrete outcome (delta lobe, table index)
    Coordinates v{};          ///< chart coordinates
    double weight = 1;        ///< stated weight * pdf / f if a weight is stated; 1 when they agree
    double density = -1;      ///< Subject::density at v if the draw already contains it, else negative
  };
  /// Appends n draws of the stream `seed` to `out`. Equal seeds give equal draws.
  std::function<void(std::uint64_t seed, std::size_t n, std::vector<Draw>& out)> draw;

  /// Returns the claimed density in chart coordinates, pdf(from_unit(v)) * jacobian(v). It integrates to 1 - P(atom) -
  /// P(failure).
  std::function<double(const Coordinates& v)> density;
  /// Returns the densities at many points, for subjects that are faster in batches; may be empty.
  std::function<void(std::span<const Coordinates> v, std::span<double> densities)> densities;

  /// Chart coordinates, ascending, where the density may jump along each axis, as between the bins of a table.
  /// Quadrature between them needs few points, and is exact for a constant density. May be empty.
  PerAxis<std::vector<double>> breaks;

  /// Claimed probabilities of the discrete outcomes; empty for a continuous subject.
  std::vector<double> atoms;
  bool may_fail = false; ///< sample may fail, with probability 1 - mass

  double mass_tolerance = 1e-12;  ///< relative rounding error of the claimed density
  double weight_tolerance = 1e-4; ///< largest |weight - 1|, beyond the change of the density when the point is rounded

  /// Returns the images of n draws of the stream `seed` under the subject's own inverse. Draws outside the domain are
  /// left out; a failed inverse gives NaN. May be empty.
  std::function<std::vector<Coordinates>(std::uint64_t seed, std::size_t n)> inverted;
  double invert_error = 0; ///< bound on the error of the inverted coordinates

  double epsilon = 2.220446049250313e-16; ///< machine epsilon of the scalar of the points
  /// Returns the change of chart coordinate `axis` when the point at v changes by one unit in the last place. If empty,
  /// the change is epsilon * v.
  std::function<double(const Coordinates& v, int axis)> resolution;
  /// Describes draw `index` of stream `seed` with all digits, including u; may be empty.
  std::function<std::string(std::uint64_t seed, std::uint64_t index)> describe_draw;
  /// Returns "weight is 0.6, should be 0.5" for draw `index` of stream `seed`, and the likely reason after "; "; may be
  /// empty.
  std::function<std::string(std::uint64_t seed, std::uint64_t index)> describe_weight;
  /// Formats the point of the domain at chart coordinates v; may be empty.
  std::function<std::string(const Coordinates& v)> describe_point;
};

} // namespace mc
