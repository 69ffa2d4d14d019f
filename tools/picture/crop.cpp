#include <picture/crop.h>

#include <mc/core/error.h>

#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <utility>
#include <vector>

namespace carlo {

namespace {

// The part of the render; nothing where the metadata do not state the part of the picture.
std::string crop_of_part(const std::string& crop, const render::Image& image, const render::Crop& part) {
  constexpr double most = 1e9;
  double x = 0, y = 0, width = 0, height = 0;
  char rest = 0;
  const int read = std::sscanf(crop.c_str(), "%lf,%lf,%lf,%lf%c", &x, &y, &width, &height, &rest);
  const bool is_crop =
      read == 4 && x >= 0 && x <= most && y >= 0 && y <= most && width == image.width && height == image.height;
  return is_crop ? fmt::format("{:.0f},{:.0f},{},{}", x + part.x, y + part.y, part.width, part.height) : std::string();
}

} // namespace

void crop_picture(render::Image& image, const render::Crop& part, const std::string& name) {
  mc::require(part.x >= 0 && part.y >= 0 && part.width > 0 && part.height > 0 && part.width <= image.width - part.x &&
                  part.height <= image.height - part.y,
              "--crop {},{},{},{} must lie within the {}x{} pixels of '{}'", part.x, part.y, part.width, part.height,
              image.width, image.height, name);
  const auto keep = [&]<class T>(std::vector<T>& all) {
    if (all.empty()) return;
    std::vector<T> kept;
    kept.reserve(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
    for (int y = part.y; y < part.y + part.height; ++y) {
      const auto row = all.begin() + static_cast<std::ptrdiff_t>(image.index(part.x, y));
      kept.insert(kept.end(), row, row + part.width);
    }
    all = std::move(kept);
  };
  keep(image.pixels);
  keep(image.variance);
  for (auto& [layer, numbers] : image.layers) keep(numbers);
  if (const auto crop = image.metadata.find("carlo.crop"); crop != image.metadata.end()) {
    crop->second = crop_of_part(crop->second, image, part);
    if (crop->second.empty()) image.metadata.erase(crop);
  }
  image.width = part.width;
  image.height = part.height;
}

} // namespace carlo
