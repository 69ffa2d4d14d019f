#pragma once
/// Scalar, vectors and colours of librender.

#include <mc/core/error.h>
#include <mc/core/types.h>

namespace render {

#ifdef RENDER_DOUBLE
/// Scalar of geometry and radiance: float, or double with RENDER_DOUBLE.
using Float = double;
#else
/// Scalar of geometry and radiance: float, or double with RENDER_DOUBLE.
using Float = float;
#endif

/// 2-D vector of Floats.
using Vec2 = mc::Vec2<Float>;
/// 3-D vector of Floats.
using Vec3 = mc::Vec3<Float>;
/// 3-D vector in double.
using Vec3d = mc::Vec3<double>;

/// Linear sRGB triple: radiance [W/(m^2 sr)] or reflectance, by context. Products are per channel.
using Spectrum = Eigen::Array<Float, 3, 1>;

/// Luminance Y of linear sRGB (IEC 61966-2-1).
template <class S> S luminance(const Eigen::Array<S, 3, 1>& s) {
  return S(0.2126) * s[0] + S(0.7152) * s[1] + S(0.0722) * s[2];
}
/// Whether all channels are 0.
inline bool is_black(const Spectrum& s) { return s[0] == 0 && s[1] == 0 && s[2] == 0; }

/// Returns s, for use in initializers.
///   throws : Error naming `what` unless all components are finite and >= 0.
inline const Spectrum& checked_radiance(std::string_view what, const Spectrum& s) {
  mc::require((s >= 0).all() && s.isFinite().all(), "{} ({}, {}, {}) must be finite and >= 0", what, s[0], s[1], s[2]);
  return s;
}
/// Returns s, for use in initializers.
///   throws : Error naming `what` unless all components lie in [0, 1].
inline const Spectrum& checked_reflectance(std::string_view what, const Spectrum& s) {
  mc::require((s >= 0).all() && (s <= 1).all(), "{} ({}, {}, {}) must lie in [0, 1]", what, s[0], s[1], s[2]);
  return s;
}

} // namespace render
