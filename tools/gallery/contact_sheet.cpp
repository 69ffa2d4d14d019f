#include <gallery/contact_sheet.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

using render::Float, render::Image, render::Spectrum;

constexpr int gap = 4; // pixels between cells
const Spectrum ground = Spectrum::Constant(Float(0.01));

// The weighted mean of a row or column of `n` values over the interval [i, i + 1) of `m`.
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

Image contact_sheet(const std::vector<Image>& thumbnails, int columns, int side) {
  const int n = static_cast<int>(thumbnails.size()), rows = (n + columns - 1) / columns;
  std::vector<int> top(static_cast<std::size_t>(rows) + 1, gap); // first pixel of each row
  for (int row = 0; row < rows; ++row) {
    int highest = 0;
    for (int i = row * columns; i < std::min(n, (row + 1) * columns); ++i)
      highest = std::max(highest, thumbnails[static_cast<std::size_t>(i)].height);
    top[static_cast<std::size_t>(row) + 1] = top[static_cast<std::size_t>(row)] + highest + gap;
  }
  Image sheet(std::min(columns, n) * (side + gap) + gap, top.back());
  std::fill(sheet.pixels.begin(), sheet.pixels.end(), ground);
  for (int i = 0; i < n; ++i) {
    const Image& picture = thumbnails[static_cast<std::size_t>(i)];
    const auto row = static_cast<std::size_t>(i / columns);
    const int cell_height = top[row + 1] - gap - top[row];
    const int left = gap + i % columns * (side + gap) + (side - picture.width) / 2,
              up = top[row] + (cell_height - picture.height) / 2;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) sheet.at(left + x, up + y) = picture.at(x, y);
  }
  return sheet;
}

} // namespace carlo
