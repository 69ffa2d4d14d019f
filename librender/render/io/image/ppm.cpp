#include <render/io/image/formats.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace render::formats {

namespace {

constexpr std::string_view white = " \t\r\n\v\f";

// Text and bytes of the file, from the front.
struct Rest {
  std::string_view bytes;

  // The next decimal number, at most `most`. Blanks and comments, from # to the end of the line, may precede it.
  std::size_t number(std::string_view what, std::size_t most) {
    for (;;) {
      bytes.remove_prefix(std::min(bytes.find_first_not_of(white), bytes.size()));
      if (bytes.empty() || bytes.front() != '#') break;
      bytes.remove_prefix(std::min(bytes.find('\n'), bytes.size()));
    }
    std::size_t value = 0, digits = 0;
    for (; digits < bytes.size() && bytes[digits] >= '0' && bytes[digits] <= '9'; ++digits) {
      value = 10 * value + static_cast<std::size_t>(bytes[digits] - '0');
      mc::require(value <= most, "PPM: {} exceeds {}", what, most);
    }
    mc::require(digits > 0, "PPM: a number is missing: {}", what);
    bytes.remove_prefix(digits);
    return value;
  }
};

} // namespace

// Netpbm: P2 and P5 are grey, P3 and P6 are RGB; P2 and P3 are text. Width, height and the largest code follow. Codes
// above 255 are two bytes, the high byte first.
Image read_ppm(const std::string& path, const std::optional<Transfer>& transfer) {
  const std::string bytes = mc::read_file(path);
  mc::require(bytes.size() >= 2 && bytes[0] == 'P' && std::string_view("2356").find(bytes[1]) != std::string::npos,
              "not a PPM or PGM file: it begins with none of P2, P3, P5 and P6");
  const bool is_text = bytes[1] <= '3';
  const std::size_t channels = bytes[1] == '3' || bytes[1] == '6' ? 3 : 1;
  Rest rest{std::string_view(bytes).substr(2)};
  constexpr std::size_t largest_size = 0x7fffffff;
  const std::size_t width = rest.number("the width", largest_size), height = rest.number("the height", largest_size),
                    most = rest.number("the largest code", 65535), code_bytes = most < 256 ? 1 : 2;
  mc::require(width >= 1 && height >= 1 && most >= 1, "PPM says {}x{} pixels up to the code {}; all must be at least 1",
              width, height, most);
  if (!is_text && !rest.bytes.empty()) rest.bytes.remove_prefix(1); // one blank ends the header
  // In text, a code takes a blank and a digit.
  const double codes = double(width) * double(height) * double(channels);
  mc::require(codes * (is_text ? 2.0 : double(code_bytes)) <= double(rest.bytes.size()),
              "PPM says {}x{}, which its {} bytes cannot hold", width, height, bytes.size());
  mc::require_memory(double(sizeof(Spectrum)) * double(width) * double(height),
                     fmt::format("{}x{} pixels", width, height));
  const Transfer curve = transfer.value_or(Transfer());
  std::vector<Float> linear(most + 1);
  for (std::size_t i = 0; i <= most; ++i) linear[i] = Float(curve.to_linear(double(i) / double(most)));
  const auto code = [&] {
    if (is_text) return rest.number("a code", most);
    std::size_t value = 0;
    for (std::size_t i = 0; i < code_bytes; ++i) value = value << 8 | static_cast<unsigned char>(rest.bytes[i]);
    rest.bytes.remove_prefix(code_bytes);
    mc::require(value <= most, "PPM: the code {} exceeds {}", value, most);
    return value;
  };
  Image image(static_cast<int>(width), static_cast<int>(height));
  for (Spectrum& pixel : image.pixels) {
    if (channels == 1) pixel.setConstant(linear[code()]);
    else
      for (int c = 0; c < 3; ++c) pixel[c] = linear[code()];
  }
  return image;
}

} // namespace render::formats
