#include <render/io/image/formats.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <sstream>

namespace render::formats {

// Portable float map: "PF", width height, scale (negative: little endian; its size multiplies the values), then rows
// from the bottom up.
// Written through mc::write_file by the caller's temporary name, so a full disk is noticed.
void write_pfm(const std::string& path, const Image& image) {
  static_assert(std::endian::native == std::endian::little);
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", image.width, image.height);
  bytes.reserve(bytes.size() + image.pixels.size() * 12);
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const float value = static_cast<float>(image.at(x, y)[c]);
        char raw[4];
        std::memcpy(raw, &value, 4);
        bytes.append(raw, 4);
      }
  mc::write_file(path, bytes);
}

Image read_pfm(const std::string& path) {
  const std::string bytes = mc::read_file(path);
  std::istringstream header(bytes.substr(0, 128));
  std::string magic;
  int width = 0, height = 0;
  double scale = 0;
  header >> magic >> width >> height >> scale;
  mc::require(header && (magic == "PF" || magic == "Pf"),
              "not a PFM file: it does not start with PF, a size and a scale");
  mc::require(width > 0 && height > 0 && scale != 0 && std::isfinite(scale),
              "PFM header says {}x{}, scale {}; all must be finite and non-zero", width, height, scale);
  const int channels = magic == "PF" ? 3 : 1;
  const std::size_t start = static_cast<std::size_t>(header.tellg()) + 1;
  const double needed = 4.0 * channels * width * height;
  mc::require(double(bytes.size()) >= double(start) + needed, "PFM data ends early: {} bytes of {}",
              bytes.size() - std::min(start, bytes.size()), needed);
  Image image(width, height);
  const char* raw = bytes.data() + start;
  for (int y = height - 1; y >= 0; --y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c, raw += 4) {
        std::uint32_t word;
        std::memcpy(&word, raw, 4);
        if (scale > 0) word = __builtin_bswap32(word);
        const Float value = Float(std::abs(scale) * double(std::bit_cast<float>(word)));
        if (channels == 3) image.at(x, y)[c] = value;
        else image.at(x, y).setConstant(value);
      }
  return image;
}

} // namespace render::formats
