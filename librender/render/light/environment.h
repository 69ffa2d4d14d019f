#pragma once
/// Environment maps.

#include <render/core/transform.h>
#include <render/light/concept.h>
#include <render/texture/texels.h>

#include <mc/table/table_dist_2d.h>

#include <memory>

namespace render {

/// Radiance from a latitude-longitude image.
///   u      : atan2(d_x, -d_z) / 2 pi for the local direction d. -z is at the left edge, +x at a quarter of the width.
///   v      : acos(d_y) / pi. +y is at the top row.
///   Le     : bilinear between texel centres; u repeats, v ends at the poles.
///   sample : selects a texel in proportion to its mean luminance times its solid angle; uniform in (u, v) within.
///   pdf    : density in (u, v) over 2 pi^2 sin(theta) [1/sr].
///   throws : Error unless all texels are finite and >= 0, and some texel is not black. Error unless scale is finite
///            and > 0. Error unless to_world is a rotation up to 1e-3; a mirroring is allowed.
class Environment {
 public:
  /// A light of an image, rotated by `to_world`, with radiance times `scale`.
  Environment(std::shared_ptr<const Texels> texels, const Transform& to_world = {}, double scale = 1);

  Spectrum Le(const Vec3& wi, const SurfacePoint* light_point) const {
    return light_point ? Spectrum(Spectrum::Zero()) : radiance(place(wi));
  }
  std::optional<LightSample> sample(const Vec3&, const Vec2& u) const;
  Float pdf(const Vec3&, const Vec3& wi, const SurfacePoint* light_point) const {
    return light_point ? Float(0) : density(place(wi));
  }
  std::optional<EmissionSample> sample_emission(const EmissionTargets& targets, const Vec2& u, const Vec2& v) const {
    return sample_infinite_emission(*this, targets, u, v);
  }
  double emission_pdf(const EmissionTargets& targets, const Vec3& ref, const Vec3& wi,
                      const SurfacePoint* light_point) const {
    return double(pdf(ref, wi, light_point)) * targets.parallel_pdf(ref, wi);
  }
  /// Luminous power [W] into a ball of this radius.
  double power(double radius) const { return mc::pi<double> * mc::sqr(radius) * flux_; }
  double irradiance(const Vec3&) const { return flux_; }
  bool is_delta() const { return false; }
  bool is_infinite() const { return true; }
  bool is_sampled() const { return true; }

 private:
  Vec2 place(const Vec3& wi) const; ///< Image coordinates (u, v) of a direction.
  Spectrum radiance(const Vec2& uv) const;
  Float density(const Vec2& uv) const; ///< Density [1/sr].

  std::shared_ptr<const Texels> texels_;
  Eigen::Matrix<Float, 3, 3> to_local_;
  Float scale_;
  std::shared_ptr<const mc::TableDist2D<Float>> table_; ///< Shared by copies.
  double flux_ = 0;                                     ///< Integral of luminance over the sphere.
};

} // namespace render
