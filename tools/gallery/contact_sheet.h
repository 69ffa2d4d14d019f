#pragma once
/// Many pictures as one small one.

#include <render/film/image.h>

#include <vector>

namespace carlo {

/// A picture at most `side` x `side` pixels, each the mean of those of `image` that it covers.
render::Image thumbnail(const render::Image& image, int side);

/// The pictures in rows of `columns`, each in the middle of a cell `side` pixels wide and as high as the highest of its
/// row, on a grey ground.
render::Image contact_sheet(const std::vector<render::Image>& thumbnails, int columns, int side);

} // namespace carlo
