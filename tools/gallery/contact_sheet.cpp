#include <gallery/contact_sheet.h>
#include <gallery/label.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

using render::Float, render::Image, render::Spectrum;

constexpr int gap = 4; // pixels between cells
const Spectrum ground = Spectrum::Constant(Float(0.01));

// Weighted mean of a row or column of `n` values over the interval [i, i + 1) of `m`.
template <class At> Spectrum mean_of(int i, int m, int n, const At& at) {
  const double lo = double(i) * n / m, hi = double(i + 1) * n / m;
  Spectrum sum = Spectrum::Zero();
  for (int k = static_cast<int>(lo); k < n && k < hi; ++k)
    sum += at(k) * Float(std::min(hi, k + 1.0) - std::max(lo, double(k)));
  return sum / Float(hi - lo);
}

} // namespace

Image thumbnail(const Image& image, int side) {
  const double shrink = std::min(1.0, double(side) / std::max(image.width, image.height));
  Image narrow(std::max(1, static_cast<int>(std::lround(shrink * image.width))), image.height);
  for (int y = 0; y < narrow.height; ++y)
    for (int x = 0; x < narrow.width; ++x)
      narrow.at(x, y) = mean_of(x, narrow.width, image.width, [&](int k) { return image.at(k, y); });
  Image small(narrow.width, std::max(1, static_cast<int>(std::lround(shrink * image.height))));
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x)
      small.at(x, y) = mean_of(y, small.height, image.height, [&](int k) { return narrow.at(x, k); });
  return small;
}

Image contact_sheet(const std::vector<Image>& pictures, int columns, int side, const SheetLabels& labels) {
  const int n = static_cast<int>(pictures.size()), rows = (n + columns - 1) / columns;
  const auto index = [](int i) { return static_cast<std::size_t>(i); };
  int widest = 0;
  for (const std::string& text : labels.rows) widest = std::max(widest, label_width(text) + gap);
  const int left = gap + widest, line = labels.cells.empty() ? 0 : label_height;
  std::vector<int> top(index(rows) + 1, gap + (labels.columns.empty() ? 0 : label_height)); // of each row
  for (int row = 0; row < rows; ++row) {
    int highest = labels.rows.empty() ? 0 : label_height;
    for (int i = row * columns; i < std::min(n, (row + 1) * columns); ++i)
      highest = std::max(highest, pictures[index(i)].height);
    top[index(row) + 1] = top[index(row)] + highest + line + gap;
  }
  Image sheet(left + std::min(columns, n) * (side + gap), top.back());
  std::fill(sheet.pixels.begin(), sheet.pixels.end(), ground);
  const auto draw_centered = [&](int column, int y, const std::string& text) {
    draw_label(sheet, left + column * (side + gap) + (side - label_width(text)) / 2, y, text);
  };
  for (int i = 0; i < n; ++i) {
    const Image& picture = pictures[index(i)];
    const int row = i / columns, column = i % columns;
    const int cell_height = top[index(row) + 1] - gap - line - top[index(row)];
    const int x0 = left + column * (side + gap) + (side - picture.width) / 2,
              y0 = top[index(row)] + (cell_height - picture.height) / 2;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) sheet.at(x0 + x, y0 + y) = picture.at(x, y);
    if (!labels.cells.empty()) draw_centered(column, top[index(row)] + cell_height, labels.cells[index(i)]);
  }
  for (int column = 0; column < static_cast<int>(labels.columns.size()); ++column)
    draw_centered(column, gap / 2, labels.columns[index(column)]);
  for (int row = 0; row < static_cast<int>(labels.rows.size()); ++row)
    draw_label(sheet, gap, (top[index(row)] + top[index(row) + 1] - gap - label_height) / 2, labels.rows[index(row)]);
  return sheet;
}

} // namespace carlo
