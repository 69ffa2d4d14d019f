#include <render/texture/bitmap.h>

namespace render {

Bitmap::Bitmap(std::shared_ptr<const Texels> texels, const UvMap& map) : texels_(std::move(texels)), map_(map) {
  texels_->require_all("bitmap", "is not finite; repair the picture",
                       [](const Spectrum& s) { return s.isFinite().all(); });
}

void Bitmap::require_reflectance(std::string_view what) const {
  Float least = mc::infinity<Float>, largest = -least;
  for (const Spectrum& s : texels_->values) {
    least = std::min(least, s.minCoeff());
    largest = std::max(largest, s.maxCoeff());
  }
  texels_->require_all(
      what,
      fmt::format("must lie in [0, 1]; clip or scale the picture, whose values reach from {} to {}", least, largest),
      [](const Spectrum& s) { return (s >= 0).all() && (s <= 1).all(); });
}

namespace {

// The two texels next to a coordinate in [0, n), which wraps around, and the weight of the second texel.
struct Neighbours {
  std::size_t first, second;
  Float weight;
  Neighbours(double place, int n) {
    const double shifted = place - 0.5, below = std::floor(shifted);
    weight = Float(shifted - below);
    first = static_cast<std::size_t>(below < 0 ? n - 1 : static_cast<int>(below));
    second = first + 1 == static_cast<std::size_t>(n) ? 0 : first + 1;
  }
};

} // namespace

Spectrum Bitmap::eval(const Vec2d& uv) const {
  const Vec2d p = map_(uv);
  const Neighbours x(p[0] * texels_->width, texels_->width), y(p[1] * texels_->height, texels_->height);
  const auto row = [&](std::size_t j) -> Spectrum {
    const Spectrum* texels = &texels_->values[j * static_cast<std::size_t>(texels_->width)];
    return (1 - x.weight) * texels[x.first] + x.weight * texels[x.second];
  };
  return (1 - y.weight) * row(y.first) + y.weight * row(y.second);
}

} // namespace render
