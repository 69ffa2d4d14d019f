#include <render/io/image/formats.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>

#include <cstdint>
#include <string_view>

namespace render::formats {

namespace {

// Little-endian number at a place of the file, which the caller has checked.
std::uint32_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

struct Layout {
  std::size_t width, height, start, pixel_bytes, row_bytes;
  bool is_top_down;
};

// The layout that the headers say. BITMAPFILEHEADER is 14 bytes, BITMAPINFOHEADER and its successors at least 40.
Layout layout_of(std::string_view bytes) {
  mc::require(bytes.starts_with("BM"), "not a BMP file: it does not begin with BM");
  mc::require(bytes.size() >= 54, "BMP header ends early: {} bytes of 54", bytes.size());
  const std::uint32_t header = number_at(bytes, 14, 4), bits = number_at(bytes, 28, 2),
                      compression = number_at(bytes, 30, 4);
  mc::require(header >= 40, "BMP has a header of {} bytes, of OS/2; save it again with a newer program", header);
  mc::require(bits == 24 || bits == 32, "BMP has {} bits per pixel; save it with 24 or 32", bits);
  // 32-bit files may name the channels by masks, after the first 40 bytes of the header.
  const bool has_usual_masks = compression == 3 && bits == 32 && bytes.size() >= 66 &&
                               number_at(bytes, 54, 4) == 0xff0000 && number_at(bytes, 58, 4) == 0xff00 &&
                               number_at(bytes, 62, 4) == 0xff;
  mc::require(compression == 0 || has_usual_masks,
              "BMP has the compression {}, or channels in another order; save it uncompressed, with 24 bits",
              compression);
  const auto width = static_cast<std::int32_t>(number_at(bytes, 18, 4)),
             height = static_cast<std::int32_t>(number_at(bytes, 22, 4));
  mc::require(width >= 1 && height != 0 && height > INT32_MIN, "BMP says {}x{}; at least one pixel is needed", width,
              height);
  const std::size_t columns = static_cast<std::size_t>(width), pixel_bytes = bits / 8;
  return {columns,
          static_cast<std::size_t>(height < 0 ? -height : height),
          number_at(bytes, 10, 4),
          pixel_bytes,
          (columns * pixel_bytes + 3) / 4 * 4, // rows begin at multiples of 4 bytes
          height < 0};
}

} // namespace

Image read_bmp(const std::string& path, const std::optional<Transfer>& transfer) {
  const std::string bytes = mc::read_file(path);
  const Layout l = layout_of(bytes);
  // The last row may omit its padding.
  const double needed = double(l.start) + double(l.row_bytes) * double(l.height - 1) + double(l.width * l.pixel_bytes);
  mc::require(l.start >= 54 && needed <= double(bytes.size()),
              "BMP says {}x{} pixels from byte {} on, which its {} bytes cannot hold", l.width, l.height, l.start,
              bytes.size());
  mc::require_memory(double(sizeof(Spectrum)) * double(l.width) * double(l.height),
                     fmt::format("{}x{} pixels", l.width, l.height));
  const auto linear = transfer.value_or(Transfer()).table();
  Image image(static_cast<int>(l.width), static_cast<int>(l.height));
  for (std::size_t y = 0; y < l.height; ++y)
    for (std::size_t x = 0; x < l.width; ++x) {
      const std::size_t at = l.start + y * l.row_bytes + x * l.pixel_bytes;
      Spectrum& pixel = image.pixels[(l.is_top_down ? y : l.height - 1 - y) * l.width + x];
      for (std::size_t c = 0; c < 3; ++c) pixel[static_cast<int>(2 - c)] = linear[number_at(bytes, at + c, 1)];
    }
  return image;
}

} // namespace render::formats
