#include <render/io/image/formats.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace render::formats {

namespace {

using Pixel = std::array<std::uint8_t, 4>; // blue, green, red, alpha; or grey

// Bytes not read so far.
struct Rest {
  std::string_view bytes;
  std::uint8_t byte() {
    mc::require(!bytes.empty(), "TGA data ends early");
    const auto b = static_cast<std::uint8_t>(bytes.front());
    bytes.remove_prefix(1);
    return b;
  }
  std::size_t word() {
    const std::size_t low = byte();
    return low + 256u * byte();
  }
  void skip(std::size_t count) {
    mc::require(count <= bytes.size(), "TGA data ends early");
    bytes.remove_prefix(count);
  }
  Pixel pixel(std::size_t size) {
    Pixel p{};
    for (std::size_t i = 0; i < size; ++i) p[i] = byte();
    return p;
  }
};

struct Header {
  std::size_t width, height, pixel_bytes;
  bool is_grey, is_packed, is_from_right, is_top_down;
};

// Reads the header, the text and the palette, up to the first pixel.
Header header_of(Rest& rest) {
  const std::size_t text = rest.byte(), has_palette = rest.byte(), type = rest.byte();
  rest.skip(2);
  const std::size_t palette = rest.word(), entry_bits = rest.byte();
  rest.skip(4);
  Header h{};
  h.width = rest.word();
  h.height = rest.word();
  const std::size_t bits = rest.byte(), descriptor = rest.byte();
  mc::require(type == 2 || type == 3 || type == 10 || type == 11,
              "TGA of type {} is not supported; save it in true colour (2 or 10) or grey (3 or 11)", type);
  h.is_grey = type == 3 || type == 11;
  h.is_packed = type >= 10;
  mc::require(h.is_grey ? bits == 8 : bits == 24 || bits == 32, "TGA has {} bits per pixel; save it with {}", bits,
              h.is_grey ? "8" : "24 or 32");
  h.pixel_bytes = bits / 8;
  mc::require(h.width >= 1 && h.height >= 1, "TGA says {}x{}; at least one pixel is needed", h.width, h.height);
  h.is_from_right = (descriptor & 16) != 0;
  h.is_top_down = (descriptor & 32) != 0;
  rest.skip(text + (has_palette == 1 ? palette * ((entry_bits + 7) / 8) : 0));
  return h;
}

} // namespace

Image read_tga(const std::string& path, const std::optional<Transfer>& transfer) {
  const std::string bytes = mc::read_file(path);
  Rest rest{bytes};
  const Header h = header_of(rest);
  // A packet of one byte and one pixel repeats the pixel up to 128 times.
  const double pixels = double(h.width) * double(h.height),
               most =
                   double(rest.bytes.size()) / double(h.pixel_bytes + (h.is_packed ? 1 : 0)) * (h.is_packed ? 128 : 1);
  mc::require(pixels <= most, "TGA says {}x{}, which its {} bytes cannot hold", h.width, h.height, bytes.size());
  mc::require_memory(double(sizeof(Spectrum)) * pixels, fmt::format("{}x{} pixels", h.width, h.height));
  const auto linear = transfer.value_or(Transfer()).table();
  Image image(static_cast<int>(h.width), static_cast<int>(h.height));
  std::size_t left = 0; // pixels left in the packet
  bool repeats = false;
  Pixel pixel{};
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    bool is_new = true;
    if (h.is_packed) {
      if (left == 0) {
        const std::uint8_t code = rest.byte();
        repeats = code >= 128;
        left = 1u + code % 128u;
      } else {
        is_new = !repeats;
      }
      --left;
    }
    if (is_new) pixel = rest.pixel(h.pixel_bytes);
    const std::size_t x = i % h.width, y = i / h.width, column = h.is_from_right ? h.width - 1 - x : x,
                      row = h.is_top_down ? y : h.height - 1 - y;
    Spectrum& value = image.pixels[row * h.width + column];
    if (h.is_grey) value.setConstant(linear[pixel[0]]);
    else value = Spectrum(linear[pixel[2]], linear[pixel[1]], linear[pixel[0]]);
  }
  return image;
}

} // namespace render::formats
