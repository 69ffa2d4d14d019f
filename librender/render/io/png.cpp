#include <render/io/formats.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <zlib.h>

#include <algorithm>
#include <cmath>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace render::formats {

namespace {

// sRGB transfer curve, IEC 61966-2-1.
std::uint8_t encode(double linear) {
  const double x =
      std::clamp(linear, 0.0, 1.0); // NaN becomes 0: std::clamp leaves it, the conversion below must not see it
  const double srgb = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return std::isfinite(srgb) ? static_cast<std::uint8_t>(std::lround(255 * srgb)) : std::uint8_t{0};
}

void append_word(std::string& bytes, std::uint32_t x) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(x >> shift & 0xff);
}

// A tEXt chunk: length, type, keyword, 0, text, CRC of type and data (PNG specification, section 11.3.4.3).
std::string text_chunk(const std::string& key, const std::string& value) {
  const std::string data = "tEXt" + key + '\0' + value;
  std::string chunk;
  append_word(chunk, static_cast<std::uint32_t>(data.size() - 4));
  chunk += data;
  append_word(chunk, static_cast<std::uint32_t>(
                         crc32(0, reinterpret_cast<const Bytef*>(data.data()), static_cast<uInt>(data.size()))));
  return chunk;
}

} // namespace

void write_png(const std::string& path, const Image& image, double exposure) {
  const double gain = std::exp2(exposure);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 3);
  for (const Spectrum& p : image.pixels)
    for (int c = 0; c < 3; ++c) bytes.push_back(encode(gain * double(p[c])));
  std::string file;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  const int written =
      stbi_write_png_to_func(append, &file, image.width, image.height, 3, bytes.data(), image.width * 3);
  mc::require(written != 0, "cannot encode a {}x{} PNG", image.width, image.height);
  // Text goes after the signature (8 bytes) and the header chunk (25 bytes).
  std::string text;
  for (const auto& [key, value] : image.metadata) text += text_chunk(key, value);
  file.insert(33, text);
  mc::write_file(path, file);
}

} // namespace render::formats
