#pragma once
/// Whether Float can hold a scene.

#include <render/scene/scene.h>

#include <cmath>
#include <limits>
#include <optional>

namespace render {

/// How coarse the coordinates of a surface's points are beside its size.
struct FloatResolution {
  double size = 0;     ///< the diagonal of its bounds [scene units]
  double distance = 0; ///< the largest coordinate in these
  double step = 0;     ///< from one Float there to the next
  double ratio = 0;    ///< step / size; infinite where nothing is left of it
};

/// Of the coarsest surface of a scene; all 0 where there is none.
FloatResolution coarsest_resolution(const Scene& scene);

/// From this ratio on carlo warns: rounding moves the corners of a surface by a thousandth of its size, and so what it
/// lights or shades by about as much.
inline constexpr double max_resolution_ratio = 1e-3;

/// Lengths whose squares a Float holds with all of its digits: areas, and densities of points on lamps.
inline const double min_length = std::sqrt(double(std::numeric_limits<Float>::min()));
inline const double max_length = std::sqrt(double(std::numeric_limits<Float>::max()));

/// The diagonal of a lamp's bounds that is below the least, or of all surfaces' that is above the most; none: neither.
std::optional<double> length_out_of_range(const Scene& scene);

} // namespace render
