#include <render/film/tone_mapping.h>

#include <mc/core/text.h>

#include <cmath>

namespace render {

namespace {

using Color = Eigen::Array3d;

Color reinhard(const Color& c) {
  const double y = luminance(c);
  return y > 0 && std::isfinite(y) ? Color(c / (1 + y)) : c;
}

// [Hable10]: shoulder, linear part and toe. White is at 2 x = 11.2.
double hable(double x) {
  constexpr double a = 0.15, b = 0.5, c = 0.1, d = 0.2, e = 0.02, f = 0.3;
  return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

Color filmic(const Color& c) {
  static const double white = hable(11.2);
  // Values far beyond white map to 1; for infinite x the formula would be inf / inf.
  return c.unaryExpr([](double x) { return x > 1e3 ? 1.0 : hable(2 * std::max(x, 0.0)) / white; });
}

} // namespace

ToneCurve tone_curve_from(std::string_view name) {
  return static_cast<ToneCurve>(mc::index_of("tone curve", name, tone_curve_names));
}

Eigen::Array3d tone_map(const Spectrum& radiance, const ToneMapping& tone) {
  Color c = radiance.cast<double>() * std::exp2(tone.exposure);
  if (tone.curve == ToneCurve::reinhard) c = reinhard(c);
  if (tone.curve == ToneCurve::filmic) c = filmic(c);
  return c.unaryExpr([](double x) { return std::clamp(x, 0.0, 1.0); });
}

double auto_exposure(const Image& image) {
  double logarithms = 0;
  std::size_t bright = 0;
  for (const Spectrum& p : image.pixels) {
    const double y = double(luminance(p));
    if (!(y > 0) || !std::isfinite(y)) continue;
    logarithms += std::log2(y);
    ++bright;
  }
  return bright > 0 ? std::log2(0.18) - logarithms / double(bright) : 0;
}

} // namespace render
