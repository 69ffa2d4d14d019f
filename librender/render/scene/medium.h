#pragma once
/// What light goes through.

#include <render/core/types.h>

#include <algorithm>

namespace render {

/// A medium that absorbs alike everywhere and scatters nothing.
///   transmittance(distance) : exp(-sigma_a distance), the share of light that is left; of an infinite distance too
///   throws : Error unless sigma_a [1 / scene unit] is finite and >= 0
///   Source : the law of Beer and Lambert, [PharrJakobHumphreys23] section 11.1
class HomogeneousMedium {
 public:
  explicit HomogeneousMedium(const Spectrum& sigma_a) : sigma_a_(checked_radiance("medium: sigmaA", sigma_a)) {}

  // Not inlined, since few scenes need it.
  [[gnu::noinline]] Spectrum transmittance(Float distance) const {
    return (-sigma_a_ * std::min(distance, std::numeric_limits<Float>::max())).exp(); // 0 times infinity is no number
  }

 private:
  Spectrum sigma_a_;
};

} // namespace render
