#pragma once
/// Many pictures in one.

#include <render/film/image.h>

#include <string>
#include <vector>

namespace carlo {

/// A picture of at most `side` x `side` pixels. Each pixel is the mean of the pixels of `image` that it covers.
render::Image thumbnail(const render::Image& image, int side);

/// Texts of a contact sheet.
struct SheetLabels {
  std::vector<std::string> cells{};   ///< below each picture; as many as pictures, or none
  std::vector<std::string> columns{}; ///< above each column; none for no such line
  std::vector<std::string> rows{};    ///< left of each row; none for no such column
};

/// The pictures in rows of `columns` on a dark ground. Each is in the middle of a cell, which is `side` pixels wide and
/// as high as the highest picture of its row, and as the label of the row.
render::Image contact_sheet(const std::vector<render::Image>& pictures, int columns, int side,
                            const SheetLabels& labels = {});

} // namespace carlo
