#pragma once
/// From radiance to what a screen shows.

#include <render/film/image.h>

#include <array>
#include <string_view>

namespace render {

/// How bright values are brought below 1.
enum class ToneCurve {
  clamp,    ///< min(x, 1), per channel
  reinhard, ///< luminance L to L / (1 + L), the colour kept [ReinhardEtAl02, equation 3]; channels then end at 1
  filmic    ///< per channel a film's S: dark ends darker, 11.2 / 2 is white, .18 becomes .13 [Hable10]
};
inline constexpr std::array<std::string_view, 3> tone_curve_names = {"clamp", "reinhard", "filmic"};
/// Throws Error, naming the nearest, for an unknown name.
ToneCurve tone_curve_from(std::string_view name);

struct ToneMapping {
  ToneCurve curve = ToneCurve::clamp;
  double exposure = 0; ///< stops: radiance is multiplied by 2^exposure first
};

/// Linear sRGB in [0, 1] per channel; NaN stays NaN.
Eigen::Array3d tone_map(const Spectrum& radiance, const ToneMapping& tone);

/// The exposure that brings the geometric mean of the luminances that are not 0 to .18, a middle grey; 0 for a black
/// image. Source: [ReinhardEtAl02, equations 1 and 2], whose small constant for black pixels would be one with a unit.
double auto_exposure(const Image& image);

} // namespace render
