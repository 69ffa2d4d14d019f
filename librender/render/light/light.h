#pragma once
/// Lights.

#include <render/core/dispatch.h>
#include <render/core/types.h>

namespace render {

/// A shape that emits the same radiance in every direction, from the side its normal points to unless two_sided.
struct AreaLight {
  int shape = -1;
  Spectrum radiance = Spectrum::Zero();
  bool two_sided = false;

  /// Emitted radiance toward w (leaving the surface) where the light's geometric normal is ng.
  Spectrum emitted(const Vec3& ng, const Vec3& w) const {
    return two_sided || ng.dot(w) > 0 ? radiance : Spectrum(Spectrum::Zero());
  }
};

/// The same radiance from every direction.
struct ConstantBackground {
  Spectrum radiance = Spectrum::Zero();
  Spectrum eval(const Vec3&) const { return radiance; }
};

/// Linear in the height of the direction: `bottom` at -y, `top` at +y. The sky of [Shirley16] is white to (.5, .7, 1).
struct GradientBackground {
  Spectrum bottom = Spectrum::Ones(), top = Spectrum(Float(0.5), Float(0.7), 1);
  Spectrum eval(const Vec3& d) const {
    const Float t = (d.y() + 1) / 2;
    return (1 - t) * bottom + t * top;
  }
};

struct Background : std::variant<ConstantBackground, GradientBackground> {
  using variant::variant;
  /// Radiance that arrives along the unit direction d away from the scene.
  Spectrum eval(const Vec3& d) const {
    return dispatch(*this, [&](const auto& b) { return b.eval(d); });
  }
};

} // namespace render
