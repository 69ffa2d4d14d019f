#pragma once
// Reads the text that report/packed.h writes.

#include <zlib.h>

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace support {

inline std::string bytes_of_base64(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  return bytes;
}

/// The bytes of a zlib stream in base64; at most a million.
inline std::string unpacked(std::string_view text) {
  const std::string stream = bytes_of_base64(text);
  std::string bytes(1'000'000, ' ');
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(stream.data()),
                       stream.size()),
            Z_OK);
  bytes.resize(size);
  return bytes;
}

} // namespace support
