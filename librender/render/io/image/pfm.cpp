#include <render/io/image/formats.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>
#include <mc/core/text.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

namespace render::formats {

// Portable float map: "PF", width, height, scale, then rows from the bottom up. A negative scale means little endian;
// its size multiplies the values.
void write_pfm(std::FILE* stream, const Image& image) {
  static_assert(std::endian::native == std::endian::little);
  mc::write_bytes(stream, fmt::format("PF\n{} {}\n-1.0\n", image.width, image.height));
  std::string bytes;
  for (int y = image.height - 1; y >= 0; --y) {
    bytes.clear();
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const float value = static_cast<float>(image.at(x, y)[c]);
        char raw[4];
        std::memcpy(raw, &value, 4);
        bytes.append(raw, 4);
      }
    mc::write_bytes(stream, bytes);
  }
}

namespace {

// Returns the next word of the header and moves `at` behind it. Blanks separate words; # begins a comment.
std::string_view word_from(std::string_view bytes, std::size_t& at) {
  constexpr const char* white = " \t\r\n";
  at = std::min(bytes.find_first_not_of(white, at), bytes.size());
  while (at < bytes.size() && bytes[at] == '#') {
    at = bytes.find('\n', at);
    at = std::min(bytes.find_first_not_of(white, at), bytes.size());
  }
  const std::size_t begin = at;
  at = std::min(bytes.find_first_of(white, at), bytes.size());
  return bytes.substr(begin, at - begin);
}

} // namespace

Image read_pfm(const std::string& path) {
  const std::string bytes = mc::read_file(path);
  std::size_t start = 0;
  const std::string_view magic = word_from(bytes, start);
  const auto across = mc::parse_double(word_from(bytes, start)), down = mc::parse_double(word_from(bytes, start)),
             said = mc::parse_double(word_from(bytes, start));
  mc::require((magic == "PF" || magic == "Pf") && across && down && said,
              "not a PFM file: it does not start with PF, a size and a scale");
  const auto is_count = [](double n) { return n >= 1 && n <= 0x7fffffff && n == std::floor(n); };
  const double scale = *said;
  mc::require(is_count(*across) && is_count(*down) && scale != 0 && std::isfinite(scale),
              "PFM header says {}x{}, scale {}; it must be whole pixels, > 0, and a scale that is finite and not 0",
              *across, *down, scale);
  const int width = static_cast<int>(*across), height = static_cast<int>(*down), channels = magic == "PF" ? 3 : 1;
  const double needed = 4.0 * channels * width * height;
  // One character ends the header. It is two if other header lines end in two, or if the file size requires it.
  const bool may_end_in_two = bytes.find("\r\n") < start || double(bytes.size() - start) == needed + 2;
  start += may_end_in_two && bytes.compare(start, 2, "\r\n") == 0 ? 2 : 1;
  mc::require(double(bytes.size()) >= double(start) + needed, "PFM data ends early: {} bytes of {}",
              bytes.size() - std::min(start, bytes.size()), needed);
  mc::require(double(bytes.size()) == double(start) + needed,
              "PFM data goes on: {} bytes where {}x{} pixels of {} floats need {}", bytes.size() - start, width, height,
              channels, needed);
  mc::require_memory(double(sizeof(Spectrum)) * width * height, fmt::format("{}x{} pixels", width, height));
  Image image(width, height);
  const char* raw = bytes.data() + start;
  for (int y = height - 1; y >= 0; --y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) {
        std::uint32_t word;
        std::memcpy(&word, raw, 4);
        raw += 4;
        if (scale > 0) word = __builtin_bswap32(word);
        const Float value = Float(std::abs(scale) * double(std::bit_cast<float>(word)));
        if (channels == 3) image.at(x, y)[c] = value;
        else image.at(x, y).setConstant(value);
      }
  return image;
}

} // namespace render::formats
