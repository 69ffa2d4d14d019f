#pragma once
/// Resolution of scene coordinates in Float.

#include <render/scene/scene.h>

#include <cmath>
#include <limits>
#include <optional>

namespace render {

/// Resolution of the coordinates of a surface, relative to its size.
struct FloatResolution {
  double size = 0;     ///< Diagonal of the bounding box [scene units].
  double distance = 0; ///< Largest absolute coordinate of the bounding box.
  double step = 0;     ///< Distance to the next Float at this coordinate.
  double ratio = 0;    ///< step / size; infinite for size 0.
};

/// Resolution of the surface with the largest ratio; all 0 without surfaces.
FloatResolution coarsest_resolution(const Scene& scene);

/// carlo warns above this ratio: rounding moves the corners of a surface by a thousandth of its size. Its light and
/// shadow move by about as much.
inline constexpr double max_resolution_ratio = 1e-3;

/// Shortest length with a normal Float as its square. Areas and the densities of points on lights need such squares.
inline const double min_length = std::sqrt(double(std::numeric_limits<Float>::min()));
/// Longest length with a finite Float as its square.
inline const double max_length = std::sqrt(double(std::numeric_limits<Float>::max()));

/// A length of the scene outside [min_length, max_length], or none. It is the diagonal of a light's bounds if that is
/// too short. It is the diagonal of all surfaces' bounds if that is too long.
std::optional<double> length_out_of_range(const Scene& scene);

} // namespace render
