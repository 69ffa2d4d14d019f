#pragma once
/// Meaning of the integers of 8- and 16-bit images.

#include <render/core/types.h>
#include <render/io/image/srgb.h>

#include <array>
#include <cmath>
#include <optional>

namespace render {

/// Conversion of encoded values in [0, 1] to linear values.
struct Transfer {
  std::optional<double> gamma = {}; ///< Exponent > 0: 1 for linear values, 2.2 for old monitors. None: the sRGB curve.

  /// Linear value of an encoded value.
  double to_linear(double encoded) const { return gamma ? std::pow(encoded, *gamma) : srgb_to_linear(encoded); }
  /// Linear values of the codes 0 to 255.
  std::array<Float, 256> table() const {
    std::array<Float, 256> linear{};
    for (std::size_t i = 0; i < 256; ++i) linear[i] = Float(to_linear(double(i) / 255));
    return linear;
  }
};

} // namespace render
