#include <render/texture/bitmap.h>

#include <algorithm>
#include <cmath>

namespace render {

Bitmap::Bitmap(std::shared_ptr<const Texels> texels, const UvMap& map, Wrap wrap, TexelFilter filter)
    : texels_(std::move(texels)), map_(map), wrap_(wrap), filter_(filter),
      texels_per_uv_(std::sqrt(std::abs(map.scale().prod()) * texels_->width * texels_->height)) {
  texels_->require_all("bitmap", "is not finite; repair the picture",
                       [](const Spectrum& s) { return s.isFinite().all(); });
  if (filter == TexelFilter::trilinear) pyramid_ = std::make_shared<const ImagePyramid>(texels_);
}

Float Bitmap::least() const {
  Float least = mc::infinity<Float>;
  for (const Spectrum& s : texels_->values) least = std::min(least, s.minCoeff());
  return least;
}

void Bitmap::require_reflectance(std::string_view what) const {
  Float largest = -mc::infinity<Float>;
  for (const Spectrum& s : texels_->values) largest = std::max(largest, s.maxCoeff());
  texels_->require_all(
      what,
      fmt::format("must lie in [0, 1]; clip or scale the picture, whose values reach from {} to {}", least(), largest),
      [](const Spectrum& s) { return (s >= 0).all() && (s <= 1).all(); });
}

namespace {

// The coordinate in [0, 1], or in [0, 1) where the image repeats.
double wrapped(double x, Wrap wrap) {
  switch (wrap) {
  case Wrap::repeat: return UvMap::fraction(x);
  case Wrap::clamp: return x > 0 ? std::min(x, 1.0) : 0; // 0 for NaN
  case Wrap::mirror: break;
  }
  const double folded = 2 * UvMap::fraction(x / 2);
  return folded <= 1 ? folded : 2 - folded;
}

// The two texels next to a coordinate in [0, 1], and the weight of the second texel. One texel counts twice at the edge
// of an image that does not repeat, and everywhere without interpolation.
struct Neighbours {
  std::size_t first, second;
  Float weight;
  Neighbours(double x, int n, Wrap wrap, TexelFilter filter) {
    const double place = wrapped(x, wrap) * n;
    if (filter == TexelFilter::nearest) {
      first = second = static_cast<std::size_t>(std::min(static_cast<int>(place), n - 1));
      weight = 0;
      return;
    }
    const bool repeats = wrap == Wrap::repeat;
    const double shifted = place - 0.5, below = std::floor(shifted);
    weight = Float(shifted - below);
    const std::size_t last = static_cast<std::size_t>(n - 1);
    if (below < 0) {
      first = repeats ? last : 0;
      second = 0;
      return;
    }
    first = static_cast<std::size_t>(below);
    second = first + 1;
    if (first == last) second = repeats ? 0 : last;
  }
};

} // namespace

Spectrum Bitmap::eval(const Vec2d& uv, Float footprint) const {
  const Vec2d p = map_.unwrapped(uv);
  const double texels = double(footprint) * texels_per_uv_;
  if (!pyramid_ || !(texels > 1)) return interpolate(*texels_, p);
  // Level i averages over 2^i texels.
  const std::size_t last = pyramid_->size() - 1;
  const double level = std::min(std::log2(texels), double(last));
  const auto i = static_cast<std::size_t>(level);
  const auto weight = Float(level - double(i));
  const Spectrum fine = interpolate(pyramid_->level(i), p);
  return weight == 0 ? fine : Spectrum((1 - weight) * fine + weight * interpolate(pyramid_->level(i + 1), p));
}

Spectrum Bitmap::interpolate(const Texels& image, const Vec2d& p) const {
  const Neighbours x(p[0], image.width, wrap_, filter_), y(p[1], image.height, wrap_, filter_);
  const auto row = [&](std::size_t j) -> Spectrum {
    const Spectrum* texels = &image.values[j * static_cast<std::size_t>(image.width)];
    return (1 - x.weight) * texels[x.first] + x.weight * texels[x.second];
  };
  return (1 - y.weight) * row(y.first) + y.weight * row(y.second);
}

} // namespace render
