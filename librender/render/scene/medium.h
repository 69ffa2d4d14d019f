#pragma once
/// Participating media.

#include <render/core/types.h>

#include <algorithm>

namespace render {

/// A homogeneous medium that absorbs and does not scatter.
///   transmittance(distance) : exp(-sigma_a distance); the distance may be infinite.
///   throws : Error unless sigma_a [1 / scene unit] is finite and >= 0.
///   Source : Beer-Lambert law, [PharrJakobHumphreys23] section 11.1.
class HomogeneousMedium {
 public:
  /// A medium with an absorption coefficient [1 / scene unit].
  explicit HomogeneousMedium(const Spectrum& sigma_a) : sigma_a_(checked_radiance("medium: sigmaA", sigma_a)) {}

  /// Transmittance over a distance [scene units]. Not inlined, since few scenes have media.
  [[gnu::noinline]] Spectrum transmittance(Float distance) const {
    // the bound avoids 0 times infinity
    return (-sigma_a_ * std::min(distance, std::numeric_limits<Float>::max())).exp();
  }

 private:
  Spectrum sigma_a_;
};

} // namespace render
