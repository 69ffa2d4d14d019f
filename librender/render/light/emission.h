#pragma once
/// First rays of light paths, aimed at the surfaces that cast caustics.

#include <render/core/bounds.h>
#include <render/shape/sphere.h>

#include <mc/core/frame.h>
#include <mc/table/discrete.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/mixture_n.h>

#include <optional>
#include <utility>
#include <vector>

namespace render {

/// The first ray of a light path, with its densities. The throughput of the path is radiance * cosine / (vertex_pdf *
/// ray_pdf).
struct EmissionSample {
  Ray ray; ///< Ray that leaves the light.
  /// Point of the light, with both normals on the emitting side; none for a light at infinity.
  std::optional<SurfacePoint> point;
  /// Radiance along the ray; intensity [W/sr] of a light at a point, irradiance [W/m^2] of a directional light.
  Spectrum radiance = Spectrum::Zero();
  double vertex_pdf = 1; ///< Density of the point [1/area] or of the direction to infinity [1/sr]; 1 for a delta light.
  double ray_pdf = 0;    ///< Density of the direction at the point [1/sr], or of the place across the ray [1/area].
  double cosine = 1;     ///< Cosine of the ray to the normal of an emitting surface; 1 for other lights.
};

/// The first ray from a light at the point p, in the sampled direction.
inline EmissionSample emission_from_point(const Vec3& p, const DirectionSample& s, const Spectrum& intensity) {
  SurfacePoint point;
  point.p = p;
  point.ng = point.ns = s.wi;
  return {{p, s.wi}, point, intensity, 1, double(s.pdf), 1};
}

/// The balls around caustic casters at which light paths aim. Without them, few light paths would cause caustics.
///   from a point : a direction toward the balls with probability `guiding_fraction`, otherwise by the emission. All
///                  balls are equally likely. The balls that an area light overlaps are left out, because nearly all
///                  directions from that light hit them.
///   from infinity : a place on the disk across one of the balls. All balls are equally likely.
class EmissionTargets {
 public:
  static constexpr Float guiding_fraction = Float(0.8); ///< Share of the directions that are aimed at balls.

  /// Targets in a scene with the bounds `scene`.
  ///   balls        : all balls.
  ///   from_outside : the balls that no area light overlaps.
  EmissionTargets(std::vector<Sphere> balls, std::vector<Sphere> from_outside, const Bounds& scene)
      : balls_(std::move(balls)), from_outside_(std::move(from_outside)), scene_(scene),
        guiding_choice_(from_outside_.empty() ? Float(0) : guiding_fraction) {}

  /// All balls.
  const std::vector<Sphere>& balls() const { return balls_; }

  /// Samples a direction at p from the mixture of `emission`, a warp of directions in world space, and the balls.
  /// Returns nothing if the sampled ball has no direction from p.
  template <class Emission>
  std::optional<DirectionSample> sample_direction(const Vec3& p, const Vec2& u, const Emission& emission) const {
    const auto part = guiding_choice_.sample_index(u[0]);
    if (part.index == 0) {
      const Vec3 d = emission.sample({part.u_remapped, u[1]});
      return DirectionSample{d, direction_pdf(p, d, emission)};
    }
    const auto ball = mc::UniformDiscrete<Float>(from_outside_.size()).sample_index(part.u_remapped);
    const auto s = from_outside_[ball.index].sample_direction(p, {ball.u_remapped, u[1]});
    if (!s) return {};
    return DirectionSample{s->wi, mixture_pdf(p, s->wi, emission, [&](std::size_t i) {
                             return i == ball.index ? s->pdf : from_outside_[i].pdf(p, s->wi);
                           })};
  }
  /// Density [1/sr] with which sample_direction() selects d.
  template <class Emission> Float direction_pdf(const Vec3& p, const Vec3& d, const Emission& emission) const {
    return mixture_pdf(p, d, emission, [&](std::size_t i) { return from_outside_[i].pdf(p, d); });
  }

  /// Samples a ray of a light at infinity along -wi. The light selects wi with the density `vertex_pdf`.
  /// Returns nothing if there are no balls, or if rounding moves the ray off all of them.
  std::optional<EmissionSample> sample_parallel(const Vec3& wi, const Spectrum& radiance, double vertex_pdf,
                                                const Vec2& u) const;
  /// Density [1/area], across the line through p along wi, with which sample_parallel() selects this line.
  double parallel_pdf(const Vec3& p, const Vec3& wi) const;

 private:
  template <class Emission, class BallPdf>
  Float mixture_pdf(const Vec3&, const Vec3& d, const Emission& emission, const BallPdf& ball_pdf) const {
    const Float own = guiding_choice_.pmf(0) * emission.pdf(d);
    if (from_outside_.empty()) return own;
    return own + guiding_choice_.pmf(1) * mc::mixture_pdf(mc::UniformDiscrete<Float>(from_outside_.size()), ball_pdf);
  }

  std::vector<Sphere> balls_, from_outside_;
  Bounds scene_;
  mc::Bernoulli<Float> guiding_choice_; ///< Outcome 1 aims at a ball.
};

/// Directions with density cos / pi [1/sr] about a unit normal: the emission of an area light.
struct CosineEmission {
  Vec3 normal; ///< Normal of the emitting side.

  /// Maps u in [0,1)^2 to a direction.
  Vec3 sample(const Vec2& u) const {
    return mc::Frame<Float>::from_z(normal).to_world(mc::CosineHemisphere<Float>{}.sample(u));
  }
  /// Density [1/sr] of the direction d.
  Float pdf(const Vec3& d) const { return std::max(normal.dot(d), Float(0)) / mc::pi<Float>; }
};

} // namespace render
