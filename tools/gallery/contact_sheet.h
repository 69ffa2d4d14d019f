#pragma once
/// Arranges many pictures in one small picture.

#include <render/film/image.h>

#include <vector>

namespace carlo {

/// A picture of at most `side` x `side` pixels. Each pixel is the mean of the pixels of `image` that it covers.
render::Image thumbnail(const render::Image& image, int side);

/// The pictures in rows of `columns` on a grey background. Each picture is centred in a cell that is `side` pixels wide
/// and as high as the highest picture of its row.
render::Image contact_sheet(const std::vector<render::Image>& thumbnails, int columns, int side);

} // namespace carlo
