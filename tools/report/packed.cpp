#include <report/packed.h>

#include <mc/core/error.h>

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string_view>

namespace carlo {

namespace {

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (k < n ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::vector<std::uint8_t> compressed(const std::vector<std::uint8_t>& bytes) {
  uLongf size = compressBound(bytes.size());
  std::vector<std::uint8_t> stream(size);
  const int status = compress2(stream.data(), &size, bytes.data(), bytes.size(), Z_BEST_COMPRESSION);
  mc::require(status == Z_OK, "zlib cannot compress {} bytes", bytes.size());
  stream.resize(size);
  return stream;
}

} // namespace

std::string packed(const std::string& head, const std::vector<float>& numbers) {
  std::vector<std::uint8_t> bytes(head.begin(), head.end());
  for (unsigned shift = 0; shift < 32; shift += 8)
    for (const float number : numbers)
      bytes.push_back(static_cast<std::uint8_t>(std::bit_cast<std::uint32_t>(number) >> shift));
  return base64(compressed(bytes));
}

} // namespace carlo
