#include <render/light/area.h>

namespace render {

AreaLight::AreaLight(std::shared_ptr<const Shape> shape, const Emission& emission)
    : shape_(std::move(shape)), radiance_(checked_radiance("area light: radiance", emission.radiance)),
      two_sided_(emission.two_sided), texture_(emission.texture), mean_radiance_(radiance_) {
  mc::require(shape_->area() > 0, "area light: an emitting shape needs an area > 0, but this one has {}",
              shape_->area());
  if (!texture_) return;
  mc::require(shape_->has_uv(), "area light: a textured light needs texture coordinates");
  mc::require(texture_->least() >= 0, "area light: the texture has the value {}; radiance must be >= 0",
              texture_->least());
  constexpr int n = 64;
  Spectrum sum = Spectrum::Zero();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (const auto point = shape_->sample_area({(Float(i) + Float(0.5)) / n, (Float(j) + Float(0.5)) / n}))
        sum += radiance_at(*point);
  mean_radiance_ = sum / Float(n * n);
}

} // namespace render
