#include <options/pixels.h>

#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/core/types.h>

#include <cmath>
#include <vector>

namespace carlo {

namespace {

// Numbers of pixels between separators; none where one is anything else or too large.
std::vector<int> pixels_in(const std::string& text, char separator) {
  constexpr double most = 1e9;
  std::vector<int> all;
  for (const std::string_view word : mc::split(text, separator)) {
    const double number = mc::parse_double(word).value_or(mc::infinity<double>);
    if (!(std::abs(number) <= most) || number != std::floor(number)) return {};
    all.push_back(static_cast<int>(number));
  }
  return all;
}

} // namespace

std::pair<int, int> parse_size(const std::string& text) {
  const std::vector<int> size = pixels_in(text, 'x');
  mc::require(size.size() == 2 && size[0] > 0 && size[1] > 0,
              "--size '{}' must be WIDTHxHEIGHT in pixels, e.g. 640x480", text);
  return {size[0], size[1]};
}

render::Crop parse_crop(const std::string& text) {
  const std::vector<int> c = pixels_in(text, ',');
  mc::require(c.size() == 4, "--crop '{}' must be X,Y,WIDTH,HEIGHT in pixels, e.g. 100,50,64,64", text);
  return {c[0], c[1], c[2], c[3]};
}

} // namespace carlo
