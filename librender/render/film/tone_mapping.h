#pragma once
/// Tone mapping from radiance to display values.

#include <render/film/image.h>

#include <array>
#include <string_view>

namespace render {

/// Curves that compress bright values to [0, 1].
enum class ToneCurve {
  clamp, ///< min(x, 1) per channel.
  /// Luminance L becomes L / (1 + L) and the hue stays [ReinhardEtAl02, equation 3]; then channels are clamped to 1.
  reinhard,
  filmic ///< Film curve per channel: dark values become darker, 11.2 / 2 is white, .18 becomes .13 [Hable10].
};
/// Names of the curves, in their order.
inline constexpr std::array<std::string_view, 3> tone_curve_names = {"clamp", "reinhard", "filmic"};
/// The curve with this name.
///   throws : Error, with the nearest name, for an unknown name.
ToneCurve tone_curve_from(std::string_view name);

/// Tone curve and exposure.
struct ToneMapping {
  ToneCurve curve = ToneCurve::clamp; ///< Compression of bright values.
  double exposure = 0;                ///< Exposure [stops]: radiance is multiplied by 2^exposure before the curve.
};

/// Tone-mapped linear sRGB in [0, 1] per channel. NaN stays NaN.
Eigen::Array3d tone_map(const Spectrum& radiance, const ToneMapping& tone);

/// Exposure [stops] that maps the geometric mean of the positive luminances to .18, a middle grey; 0 for a black image.
///   Source : [ReinhardEtAl02, equations 1 and 2], without the small constant for black pixels, which would depend on
///            the unit of radiance.
double auto_exposure(const Image& image);

} // namespace render
