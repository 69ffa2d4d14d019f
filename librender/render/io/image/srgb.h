#pragma once
/// The transfer curve of sRGB.

#include <cmath>

namespace render {

/// Linear value of an encoded value; maps 0 to 0 and 1 to 1. The exact curve of IEC 61966-2-1, not a power of 2.2.
inline double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}
/// Encoded value of a linear value. The two curves of the standard are inverse to each other within 1e-5 of the range.
inline double linear_to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

} // namespace render
