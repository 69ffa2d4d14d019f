#pragma once
/// Whether Float can hold a scene.

#include <render/scene/scene.h>

namespace render {

/// How coarse the coordinates of a surface's points are beside its size.
struct Coarseness {
  double size = 0;     ///< the diagonal of its bounds [scene units]
  double distance = 0; ///< the largest coordinate in these
  double step = 0;     ///< from one Float there to the next
  double ratio = 0;    ///< step / size; infinite where nothing is left of it
};

/// Of the coarsest surface of a scene; all 0 where there is none.
Coarseness coarsest(const Scene& scene);

/// From this ratio on carlo warns: rounding moves the corners of a surface by a thousandth of its size, and so what it
/// lights or shades by about as much.
inline constexpr double too_coarse = 1e-3;

} // namespace render
