#pragma once
/// Sizes and parts of pictures, parsed from option values.

#include <render/pixel_points.h>

#include <string>
#include <utility>

namespace carlo {

/// Width and height of "640x480".
///   throws : Error for anything else, and where one is not positive.
std::pair<int, int> parse_size(const std::string& text);

/// The part "X,Y,WIDTH,HEIGHT". The renderer checks that it lies inside the picture.
///   throws : Error for anything else.
render::Crop parse_crop(const std::string& text);

} // namespace carlo
