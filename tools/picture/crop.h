#pragma once
/// Parts of pictures.

#include <render/film/image.h>
#include <render/pixel_points.h>

#include <string>

namespace carlo {

/// Reduces a picture to a part: its pixels, their variances and all layers. The metadata carlo.crop, which is relative
/// to the whole render, becomes that of the part: `carlo render --resume` then accepts the part.
///   name   : of the picture, for the message.
///   throws : Error where the part does not lie inside the picture.
void crop_picture(render::Image& image, const render::Crop& part, const std::string& name);

} // namespace carlo
