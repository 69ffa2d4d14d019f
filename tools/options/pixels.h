#pragma once
/// Sizes and parts of pictures, as words say them.

#include <render/pixel_points.h>

#include <string>
#include <utility>

namespace carlo {

/// Width and height of "640x480".
///   throws : Error for anything else, and where one is not positive
std::pair<int, int> size_in(const std::string& text);

/// "X,Y,WIDTH,HEIGHT". Whether it lies inside the picture is for the renderer to say.
///   throws : Error for anything else
render::Crop crop_in(const std::string& text);

} // namespace carlo
