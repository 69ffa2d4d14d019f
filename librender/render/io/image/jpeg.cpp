#include <render/io/image/formats.h>
#include <render/io/image/srgb.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-compare"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <array>
#include <memory>
#include <string_view>

namespace render::formats {

namespace {

// Whether the mark of the end is there, whatever stands behind it: 0xff and a byte are a mark, most of which have a
// length; between the marks behind the start of a scan is what 0xff 0 or 0xff and the number of a restart may stand in.
bool is_whole(std::string_view file) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(file[i]); };
  bool in_scan = false;
  for (std::size_t at = 2; at + 1 < file.size();) {
    const unsigned mark = byte(at + 1);
    if (byte(at) != 0xff) {
      if (!in_scan) return false;
      ++at;
    } else if (mark == 0xff) { // any number of these may stand before a mark
      ++at;
    } else if (mark == 0 || (mark >= 0xd0 && mark <= 0xd7)) {
      if (!in_scan) return false;
      at += 2;
    } else if (mark == 0xd9) {
      return true;
    } else {
      if (at + 3 >= file.size()) return false;
      in_scan = mark == 0xda;
      at += 2 + (static_cast<std::size_t>(byte(at + 2)) << 8) + byte(at + 3);
    }
  }
  return false;
}

} // namespace

// The library takes zeros for what a file lacks: the mark at the end is looked for first, so that no truncated picture
// is taken for a whole one.
Image read_jpeg(const std::string& path) {
  const std::string file = mc::read_file(path);
  mc::require(file.starts_with("\xff\xd8"), "not a JPEG file: it does not begin with ff d8");
  mc::require(is_whole(file), "the JPEG ends early, or is broken: its mark of the end, ff d9, is not where it belongs");
  const auto* data = reinterpret_cast<const stbi_uc*>(file.data());
  const int size = static_cast<int>(file.size());
  mc::require(file.size() <= 0x7fffffff, "a JPEG of {} bytes is too large", file.size());
  int width = 0, height = 0, channels = 0;
  const bool known = stbi_info_from_memory(data, size, &width, &height, &channels) != 0;
  mc::require(known && width > 0 && height > 0, "broken JPEG: {}", known ? "it has no pixel" : stbi_failure_reason());
  // A block of 64 pixels takes at least a bit.
  mc::require(double(width) * double(height) <= 64 * 8 * double(file.size()),
              "JPEG says {}x{}, which its {} bytes cannot hold", width, height, file.size());
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 3), stbi_image_free);
  mc::require(pixels != nullptr, "broken JPEG: {}", stbi_failure_reason());

  std::array<Float, 256> linear{};
  for (std::size_t i = 0; i < 256; ++i) linear[i] = Float(srgb_to_linear(double(i) / 255));
  Image image(width, height);
  for (std::size_t i = 0; i < 3 * image.pixels.size(); ++i)
    image.pixels[i / 3][static_cast<int>(i % 3)] = linear[pixels.get()[i]];
  return image;
}

} // namespace render::formats
