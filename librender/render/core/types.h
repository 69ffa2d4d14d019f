#pragma once
/// librender's scalar, vectors and colours.

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
inline Float luminance(const Spectrum& s) { return Float(0.2126) * s[0] + Float(0.7152) * s[1] + Float(0.0722) * s[2]; }
inline bool is_black(const Spectrum& s) { return s[0] == 0 && s[1] == 0 && s[2] == 0; }

} // namespace render
