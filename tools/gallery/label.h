#pragma once
/// Text in pictures.

#include <render/film/image.h>

#include <string_view>

namespace carlo {

inline constexpr int label_height = 20; ///< pixels of a line of text

/// Width of a text in pixels.
int label_width(std::string_view text);

/// Draws printable ASCII in white. Its upper left corner is the pixel (left, top). Parts outside of the picture and
/// characters that are not printable ASCII are left out.
void draw_label(render::Image& image, int left, int top, std::string_view text);

} // namespace carlo
