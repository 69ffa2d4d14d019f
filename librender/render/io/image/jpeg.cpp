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

namespace render::formats {

// The library takes zeros for what a file lacks: the mark at the end is looked for first, so that no truncated picture
// is taken for a whole one.
Image read_jpeg(const std::string& path) {
  const std::string file = mc::read_file(path);
  const std::size_t end = file.find_last_not_of(std::string_view("\0\n\r ", 4));
  mc::require(file.starts_with("\xff\xd8"), "not a JPEG file: it does not begin with ff d8");
  mc::require(end != std::string::npos && end >= 3 && file.compare(end - 1, 2, "\xff\xd9") == 0,
              "the JPEG ends early: its last bytes are not ff d9");
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
