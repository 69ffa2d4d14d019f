#pragma once
/// The choice of a direction where a path meets a surface.

#include <render/integrator/strategy.h>
#include <render/scene/scene.h>

#include <mc/core/frame.h>
#include <mc/table/discrete.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/mixture_n.h>
#include <mc/warp/sphere.h>

#include <optional>
#include <vector>

namespace render {

/// Where a path meets a surface whose BSDF is a B.
template <class B> struct ShadingPoint {
  const B& bsdf;
  const SurfacePoint& point;
  mc::Frame<Float> frame; ///< about the shading normal
  Vec3 wo;                ///< in the frame
};

/// Whether the direction (wi in the frame, d in the world) lies on the same side of the true surface as of the one that
/// the shading normal pretends: light must not leak through, nor be lost, where the two disagree.
template <class B> bool same_geometric_side(const ShadingPoint<B>& isect, const Vec3& wi, const Vec3& d) {
  if (isect.point.ns == isect.point.ng) return true;
  const Float seen_from = isect.frame.to_world(isect.wo).dot(isect.point.ng);
  return (seen_from * d.dot(isect.point.ng) > 0) == (isect.wo.z() * wi.z() > 0);
}

/// Where a path goes next.
struct ScatterSample {
  Vec3 d;          ///< in the world
  Spectrum weight; ///< f |cos| / density
  Float pdf;       ///< [1/sr] among the directions that are no narrow lobe's; 0: of a narrow lobe, met by nothing else
  Float eta;       ///< see BsdfSample
  Float guiding_pdf_ratio; ///< density over that of following the BSDF alone: large where a small target was aimed at
};

/// Whether the strategy finds every light of the scene: chance never meets a point light or a directional one.
bool finds_all_lights(const Scene& scene, const Strategy& strategy);

/// Whether the strategy leaves out light for good, since every direction goes to lamps or guides while paths are long
/// enough, in edges (-1: no limit), to find light elsewhere: on other surfaces, or in the sky.
bool misses_light(const Scene& scene, const Strategy& strategy, int max_depth);

/// Whether a lamp lies in the sphere, or its box reaches into it.
bool contains_area_light(const Scene& scene, const Sphere& sphere);

/// A mixture of the BSDF and the targets of a strategy, each equally likely.
///   sample : a direction, and its weight under the density of the whole mixture
///   pdf    : that density [1/sr], narrow lobes excluded: sum of share / n pdf_i(wi) over the targets, and
///            (1 - share) pdf_bsdf(wi) where share < 1
///   A narrow BSDF is always followed. Where glass and mirrors are the target no BSDF aims more often than it absorbs:
///   what follows it would weigh albedo / (1 - share) at every turn, and of the paths in a white room or in rough glass
///   few would be left to carry all the light. Of those that go round in rough glass three in a thousand came through
///   twenty turns.
///   A delta lobe is only ever found by following the BSDF, so a BSDF with such a lobe is followed by half of the
///   directions at least; where share = 1 its other lobes are left to the targets.
class DirectionMixture {
 public:
  DirectionMixture(const Scene& scene, const Strategy& strategy);
  /// guiding_fraction : of the directions go to the targets, which must outlive it; where there are none the BSDF is followed
  DirectionMixture(std::vector<const Shape*> targets, Float guiding_fraction);

  template <class B, class Stream>
  std::optional<ScatterSample> sample(const ShadingPoint<B>& isect, Stream& stream) const {
    if (!target_distribution_ || isect.bsdf.is_near_specular()) return sample_bsdf(isect, stream);
    const Vec2 u = stream.next2(); // u[0] also makes the choices, which are then as well spread as the directions
    const auto part = guiding_choice(isect).sample_index(u[0]);
    return part.index == 0 ? sample_bsdf_part(isect, Vec2(part.u_remapped, u[1]), part.pmf, stream.next())
                           : sample_target_part(isect, Vec2(part.u_remapped, u[1]), stream);
  }

  /// wi in the frame, d the same in the world.
  template <class B> Float pdf(const ShadingPoint<B>& isect, const Vec3& wi, const Vec3& d) const {
    if (!target_distribution_) return isect.bsdf.pdf(isect.wo, wi);
    return combined_pdf(isect, uses_bsdf_ ? isect.bsdf.pdf(isect.wo, wi) : Float(0), targets_pdf(isect, wi, d));
  }

 private:
  // Outcome 1 aims, 0 follows the BSDF.
  template <class B> mc::Bernoulli<Float> guiding_choice(const ShadingPoint<B>& isect) const {
    const Float guiding_fraction = isect.bsdf.has_delta() ? std::min(guiding_fraction_, Float(0.5)) : guiding_fraction_;
    return mc::Bernoulli<Float>(limited_by_absorption_
                                    ? std::min(guiding_fraction, std::max(1 - isect.bsdf.albedo(isect.wo), Float(0)))
                                    : guiding_fraction);
  }

  template <class B, class Stream>
  static std::optional<ScatterSample> sample_bsdf(const ShadingPoint<B>& isect, Stream& stream) {
    const Float uc = stream.next();
    const auto s = isect.bsdf.sample(isect.wo, uc, stream.next2());
    if (!s) return {};
    const Vec3 d = isect.frame.to_world(s->wi);
    if (!same_geometric_side(isect, s->wi, d)) return {};
    const bool is_near_specular = s->delta || isect.bsdf.is_near_specular();
    return ScatterSample{d, s->f * (std::abs(s->wi.z()) / s->pdf), is_near_specular ? Float(0) : s->pdf, s->eta, 1};
  }

  // The BSDF's part of the mixture, of probability pmf.
  template <class B>
  std::optional<ScatterSample> sample_bsdf_part(const ShadingPoint<B>& isect, const Vec2& u, Float pmf,
                                                Float uc) const {
    const auto s = isect.bsdf.sample(isect.wo, uc, u);
    if (!s) return {};
    const Vec3 d = isect.frame.to_world(s->wi);
    if (!same_geometric_side(isect, s->wi, d)) return {};
    if (s->delta) return ScatterSample{d, s->f * (std::abs(s->wi.z()) / (s->pdf * pmf)), 0, s->eta, pmf};
    if (!uses_bsdf_) return {};
    const Float density = combined_pdf(isect, s->pdf, targets_pdf(isect, s->wi, d));
    return ScatterSample{d, s->f * (std::abs(s->wi.z()) / density), density, s->eta, density / s->pdf};
  }

  // The targets' part.
  template <class B, class Stream>
  std::optional<ScatterSample> sample_target_part(const ShadingPoint<B>& isect, const Vec2& u, Stream& stream) const {
    if (target_shapes_.empty()) {
      const bool through = isect.bsdf.transmits();
      Vec3 wi = through ? mc::UniformSphere<Float>{}.sample(u) : mc::UniformHemisphere<Float>{}.sample(u);
      if (!through && isect.wo.z() < 0) wi.z() = -wi.z();
      const Vec3 d = isect.frame.to_world(wi);
      return guided_sample(isect, wi, d, targets_pdf(isect, wi, d));
    }
    const auto target = target_distribution_->sample_index(u[0]);
    const auto s =
        sample_target_direction(*target_shapes_[target.index], isect.point, {target.u_remapped, u[1]}, stream);
    if (!s) return {};
    const Float density = mc::mixture_pdf(*target_distribution_, [&](std::size_t i) {
      return i == target.index ? s->pdf : target_shapes_[i]->pdf(isect.point.p, s->wi);
    });
    return guided_sample(isect, isect.frame.to_local(s->wi), s->wi, density);
  }

  // Rounding carries rays past the outline of a small target. Where light is found by meeting it alone that of these
  // would be lost: another direction takes the place of theirs. A target that none meets is not tried for ever, and of
  // one that is not small nothing is lost but 3e-7: it saves a tenth of the time.
  template <class Stream>
  std::optional<DirectionSample> sample_target_direction(const Shape& target, const SurfacePoint& from, const Vec2& u,
                                                         Stream& stream, int tries = 8) const {
    constexpr Float small = 100; // [1/sr]
    const auto s = target.sample_direction(from.p, u);
    const auto is_met = [&](const Ray& ray) { return target.pdf(ray.o, ray.d) > 0; };
    if (!resamples_misses_ || tries == 0 || !s || s->pdf <= small || is_met(from.spawn_ray(s->wi))) return s;
    return sample_target_direction(target, from, stream.next2(), stream, tries - 1);
  }

  template <class B>
  std::optional<ScatterSample> guided_sample(const ShadingPoint<B>& isect, const Vec3& wi, const Vec3& d,
                                             Float targets) const {
    if (!same_geometric_side(isect, wi, d)) return {};
    const Float own = isect.bsdf.pdf(isect.wo, wi), density = combined_pdf(isect, own, targets);
    return ScatterSample{d, isect.bsdf.eval(isect.wo, wi) * (std::abs(wi.z()) / density), density,
                         isect.bsdf.eta(isect.wo, wi), density / own};
  }

  // The density of the mixture, from those of its parts.
  template <class B> Float combined_pdf(const ShadingPoint<B>& isect, Float own, Float targets) const {
    const auto part = guiding_choice(isect);
    return (uses_bsdf_ ? part.pmf(0) * own : Float(0)) + part.pmf(1) * targets;
  }
  template <class B> Float targets_pdf(const ShadingPoint<B>& isect, const Vec3& wi, const Vec3& d) const {
    if (target_shapes_.empty() && isect.bsdf.transmits()) return 1 / (4 * mc::pi<Float>);
    if (target_shapes_.empty()) return wi.z() * isect.wo.z() >= 0 ? 1 / (2 * mc::pi<Float>) : Float(0);
    return mc::mixture_pdf(*target_distribution_,
                           [&](std::size_t i) { return target_shapes_[i]->pdf(isect.point.p, d); });
  }

  std::vector<const Shape*> target_shapes_; ///< to aim at; none: the hemisphere, if there is a target
  std::optional<mc::UniformDiscrete<Float>>
      target_distribution_; ///< the choice of one; none: the BSDF is always followed
  Float guiding_fraction_;
  bool uses_bsdf_;             ///< directions of lobes that are no delta come from the BSDF too
  bool limited_by_absorption_; ///< no BSDF aims more often than it absorbs
  bool resamples_misses_;      ///< where directions miss what they were aimed at, others take their place
};

} // namespace render
