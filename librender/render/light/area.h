#pragma once
/// Emitting shapes.

#include <render/light/concept.h>
#include <render/shape/shape.h>
#include <render/texture/texture.h>

#include <memory>

namespace render {

/// Emission of a surface: the same radiance in all directions on the side of its normal, or on both sides.
struct Emission {
  Spectrum radiance = Spectrum::Ones(); ///< Emitted radiance.
  bool two_sided = false;               ///< Whether both sides emit.
  std::optional<Texture> texture = {};  ///< Factor of the radiance that varies over the surface; none: 1.
};

/// A shape that emits.
///   sample : a point by the shape's own sampling from the reference point, regardless of the texture.
///   throws : Error unless the radiance is finite and >= 0, the area of the shape is > 0, and the shape has texture
///            coordinates if there is a texture.
class AreaLight {
 public:
  /// A light of a shape.
  AreaLight(std::shared_ptr<const Shape> shape, const Emission& emission);

  Spectrum Le(const Vec3& wi, const SurfacePoint* light_point) const {
    return light_point && (two_sided_ || light_point->ng.dot(wi) < 0) ? radiance_at(*light_point)
                                                                      : Spectrum(Spectrum::Zero());
  }
  std::optional<LightSample> sample(const Vec3& ref, const Vec2& u) const {
    const auto s = shape_->sample(ref, u);
    if (!s) return {};
    return LightSample{s->wi, Le(s->wi, &s->point), s->pdf, s->point};
  }
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint* light_point) const {
    return light_point ? shape_->pdf(ref, wi, *light_point) : Float(0);
  }
  std::optional<EmissionSample> sample_emission(const EmissionTargets& targets, const Vec2& u, const Vec2& v) const {
    auto point = shape_->sample_area(u);
    if (!point) return {};
    Vec2 w = v;
    if (two_sided_) {
      const auto side = mc::Bernoulli<Float>(Float(0.5)).sample_index(v[0]);
      if (side.index == 1) point->ng = -point->ng;
      w[0] = side.u_remapped;
    }
    point->ns = point->ng;
    const auto s = targets.sample_direction(point->p, w, CosineEmission{point->ng});
    const double cosine = s ? double(point->ng.dot(s->wi)) : 0;
    if (!(cosine > 0)) return {};
    return EmissionSample{point->spawn_ray(s->wi),  point, radiance_at(*point), 1 / shape_->area(),
                          double(s->pdf) / sides(), cosine};
  }
  double emission_pdf(const EmissionTargets& targets, const Vec3&, const Vec3& wi,
                      const SurfacePoint* light_point) const {
    if (!light_point) return 0;
    const bool is_back = two_sided_ && light_point->ng.dot(wi) > 0;
    const CosineEmission emission{is_back ? Vec3(-light_point->ng) : light_point->ng};
    return double(targets.direction_pdf(light_point->p, -wi, emission)) / (shape_->area() * sides());
  }
  /// Luminous power [W].
  double power(double) const { return mc::pi<double> * shape_->area() * double(luminance(radiance())) * sides(); }
  double irradiance(const Vec3& ref) const {
    return double(luminance(radiance())) * shape_->projected_solid_angle_bound(ref);
  }
  bool is_delta() const { return false; }
  bool is_infinite() const { return false; }
  bool is_sampled() const { return true; }

  /// Mean radiance of each emitting side.
  const Spectrum& radiance() const { return mean_radiance_; }
  /// Whether both sides emit.
  bool is_two_sided() const { return two_sided_; }
  /// The emitting shape.
  const Shape& shape() const { return *shape_; }

 private:
  double sides() const { return two_sided_ ? 2 : 1; }
  Spectrum radiance_at(const SurfacePoint& point) const {
    return texture_ ? Spectrum(radiance_ * texture_->eval(shape_->uv(point))) : radiance_;
  }

  std::shared_ptr<const Shape> shape_;
  Spectrum radiance_;
  bool two_sided_;
  std::optional<Texture> texture_;
  Spectrum mean_radiance_;
};

} // namespace render
