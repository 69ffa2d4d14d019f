#pragma once
/// librender's scalar, vectors and colours.

#include <mc/core/error.h>
#include <mc/core/types.h>

namespace render {

#ifdef RENDER_DOUBLE
using Float = double;
#else
using Float = float;
#endif

using Vec2 = mc::Vec2<Float>;
using Vec3 = mc::Vec3<Float>;
using Vec3d = mc::Vec3<double>;

/// Linear sRGB triple: radiance [W/(m^2 sr)] or a reflectance, by context. Products are per channel.
using Spectrum = Eigen::Array<Float, 3, 1>;

/// Luminance Y of linear sRGB (IEC 61966-2-1).
template <class S> S luminance(const Eigen::Array<S, 3, 1>& s) {
  return S(0.2126) * s[0] + S(0.7152) * s[1] + S(0.0722) * s[2];
}
inline bool is_black(const Spectrum& s) { return s[0] == 0 && s[1] == 0 && s[2] == 0; }

/// s itself, for initialisers.
///   throws : Error naming `what` unless all components are finite and >= 0, of a reflectance in [0, 1]
inline const Spectrum& checked_radiance(std::string_view what, const Spectrum& s) {
  mc::require((s >= 0).all() && s.isFinite().all(), "{} ({}, {}, {}) must be finite and >= 0", what, s[0], s[1], s[2]);
  return s;
}
inline const Spectrum& checked_reflectance(std::string_view what, const Spectrum& s) {
  mc::require((s >= 0).all() && (s <= 1).all(), "{} ({}, {}, {}) must lie in [0, 1]", what, s[0], s[1], s[2]);
  return s;
}

} // namespace render
