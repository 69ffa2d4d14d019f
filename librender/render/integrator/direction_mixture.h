#pragma once
/// Sampling of the next direction at a path vertex.

#include <render/integrator/shading_point.h>
#include <render/integrator/strategy.h>

#include <mc/table/discrete.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/mixture_n.h>
#include <mc/warp/sphere.h>

#include <optional>
#include <vector>

// g++ stops inlining if a file instantiates three stream types, and calls of a few instructions are then costly. Debug
// and sanitizer builds leave flatten out, since it makes them very slow to compile.
#if defined(NDEBUG)
#define RENDER_FLAT [[gnu::flatten]]
#else
#define RENDER_FLAT
#endif

namespace render {

/// A sampled next direction.
struct ScatterSample {
  Vec3 d;          ///< Direction in world space.
  Spectrum weight; ///< f |cos| / density.
  /// Density [1/sr] without near-specular lobes; 0 if such a lobe was sampled, which no other technique can sample.
  Float pdf;
  Float eta; ///< Index ratio of a refraction; see BsdfSample.
  /// Density over the density of pure BSDF sampling: large if the direction was aimed at a small target.
  Float guiding_pdf_ratio;
  bool reversible = true; ///< See ShadingSample.
};

/// Whether the strategy can find every light of the scene. Strategies without next-event estimation never find point
/// lights and directional lights.
bool finds_all_lights(const Scene& scene, const Strategy& strategy);

/// Whether the strategy misses indirect light or sky light for good.
/// This is so if all directions go to lights or importance targets and paths may have enough edges for other light.
///   max_depth : largest number of edges; -1 for no limit.
bool misses_light(const Scene& scene, const Strategy& strategy, int max_depth);

/// Whether the ball overlaps the bounding box of an area light.
bool contains_area_light(const Scene& scene, const Ball& ball);

/// Mixture of the BSDF and the targets of a strategy; all n targets are equally likely.
///   sample : a direction with its weight under the density of the whole mixture.
///   pdf    : a / n sum_i pdf_i(wi) + (1 - a) pdf_bsdf(wi) [1/sr] with the guiding fraction a. It excludes delta lobes.
///            For a strategy with guiding fraction 1 there is no BSDF term.
///   Source : [Veach97] section 9.2.4.
/// The fraction a depends on the BSDF:
///   - A near-specular BSDF is always sampled by itself.
///   - A BSDF with a delta lobe has a <= 1/2, since only BSDF sampling finds a delta lobe. With a guiding fraction of 1
///     its other lobes are left to the targets.
///   - If the targets are glass or mirrors, a <= 1 - albedo. Otherwise BSDF samples weigh albedo / (1 - a) at every
///     bounce. In a white room or in rough glass a few paths would then carry all the light.
class DirectionMixture {
 public:
  /// The mixture of a strategy, with its targets in the scene.
  DirectionMixture(const Scene& scene, const Strategy& strategy);
  /// A mixture of the BSDF and given targets.
  ///   guiding_fraction : probability of sampling a target; without targets the BSDF is always sampled.
  ///   targets          : shapes, which must outlive the mixture.
  DirectionMixture(std::vector<const Shape*> targets, Float guiding_fraction);

  /// Samples a direction. Returns nothing if the sample is absorbed.
  template <class B, class Stream>
  RENDER_FLAT std::optional<ScatterSample> sample(const ShadingPoint<B>& isect, Stream& stream) const {
    if (!target_distribution_ || isect.bsdf.lobes().is_near_specular()) return sample_bsdf(isect, stream);
    const Vec2 u = stream.next2(); // u[0] also selects the part of the mixture, so that the selection is stratified
    const auto part = guiding_choice(isect).sample_index(u[0]);
    return part.index == 0 ? sample_bsdf_part(isect, Vec2(part.u_remapped, u[1]), part.pmf, stream.next())
                           : sample_target_part(isect, Vec2(part.u_remapped, u[1]), stream);
  }

  /// Density [1/sr] of a direction, given in the frame (wi) and in world space (d).
  template <class B> Float pdf(const ShadingPoint<B>& isect, const Vec3& wi, const Vec3& d) const {
    if (!target_distribution_) return isect.pdf(wi);
    return combined_pdf(isect, uses_bsdf_ ? isect.pdf(wi) : Float(0), targets_pdf(isect, wi, d));
  }

 private:
  // Outcome 1 samples a target, outcome 0 the BSDF.
  template <class B> mc::Bernoulli<Float> guiding_choice(const ShadingPoint<B>& isect) const {
    const Float guiding_fraction =
        isect.bsdf.lobes().has_delta ? std::min(guiding_fraction_, Float(0.5)) : guiding_fraction_;
    return mc::Bernoulli<Float>(limited_by_absorption_
                                    ? std::min(guiding_fraction, std::max(1 - isect.bsdf.albedo(isect.wo), Float(0)))
                                    : guiding_fraction);
  }

  template <class B, class Stream>
  static std::optional<ScatterSample> sample_bsdf(const ShadingPoint<B>& isect, Stream& stream) {
    const Float uc = stream.next();
    const auto s = isect.sample(uc, stream.next2());
    if (!s) return {};
    const bool is_near_specular = s->delta || isect.bsdf.lobes().is_near_specular();
    return ScatterSample{
        isect.frame.to_world(s->wi), s->f_cos / s->pdf, is_near_specular ? Float(0) : s->pdf, s->eta, 1, s->reversible};
  }

  // Samples the BSDF, which was selected with probability pmf.
  template <class B>
  std::optional<ScatterSample> sample_bsdf_part(const ShadingPoint<B>& isect, const Vec2& u, Float pmf,
                                                Float uc) const {
    const auto s = isect.sample(uc, u);
    if (!s) return {};
    const Vec3 d = isect.frame.to_world(s->wi);
    if (s->delta) return ScatterSample{d, s->f_cos / (s->pdf * pmf), 0, s->eta, pmf, s->reversible};
    if (!uses_bsdf_) return {};
    const Float density = combined_pdf(isect, s->pdf, targets_pdf(isect, s->wi, d));
    return ScatterSample{d, s->f_cos / density, density, s->eta, density / s->pdf};
  }

  // Samples a target.
  template <class B, class Stream>
  std::optional<ScatterSample> sample_target_part(const ShadingPoint<B>& isect, const Vec2& u, Stream& stream) const {
    if (target_shapes_.empty()) {
      const bool through = isect.bsdf.lobes().transmits;
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

  // Samples a direction toward a target. Rounding makes some rays miss the outline of a small target. If only hits find
  // light, such a miss loses light, so another direction is drawn. The number of tries is limited, since every ray may
  // miss. For large targets the loss is negligible and the test is skipped.
  template <class Stream>
  std::optional<DirectionSample> sample_target_direction(const Shape& target, const SurfacePoint& from, const Vec2& u,
                                                         Stream& stream, int tries = 8) const {
    constexpr Float small = 100; // density [1/sr] above which a target counts as small
    const auto s = target.sample_direction(from.p, u);
    const auto is_met = [&](const Ray& ray) { return target.pdf(ray.o, ray.d) > 0; };
    if (!resamples_misses_ || tries == 0 || !s || s->pdf <= small || is_met(from.spawn_ray(s->wi))) return s;
    return sample_target_direction(target, from, stream.next2(), stream, tries - 1);
  }

  template <class B>
  std::optional<ScatterSample> guided_sample(const ShadingPoint<B>& isect, const Vec3& wi, const Vec3& d,
                                             Float targets) const {
    const Float own = isect.pdf(wi), density = combined_pdf(isect, own, targets);
    return ScatterSample{d, isect.f_cos(wi) / density, density, isect.eta(wi), density / own};
  }

  // Density of the mixture from the densities of its two parts.
  template <class B> Float combined_pdf(const ShadingPoint<B>& isect, Float own, Float targets) const {
    const auto part = guiding_choice(isect);
    return (uses_bsdf_ ? part.pmf(0) * own : Float(0)) + part.pmf(1) * targets;
  }
  template <class B> Float targets_pdf(const ShadingPoint<B>& isect, const Vec3& wi, const Vec3& d) const {
    if (target_shapes_.empty() && isect.bsdf.lobes().transmits) return 1 / (4 * mc::pi<Float>);
    if (target_shapes_.empty()) return wi.z() * isect.wo.z() >= 0 ? 1 / (2 * mc::pi<Float>) : Float(0);
    return mc::mixture_pdf(*target_distribution_,
                           [&](std::size_t i) { return target_shapes_[i]->pdf(isect.point.p, d); });
  }

  /// Shapes to aim at; empty: the hemisphere if target_distribution_ has a value.
  std::vector<const Shape*> target_shapes_;
  std::optional<mc::UniformDiscrete<Float>> target_distribution_; ///< Selects a target; none: only BSDF sampling.
  Float guiding_fraction_;
  bool uses_bsdf_;             ///< Whether non-delta lobes are sampled, too.
  bool limited_by_absorption_; ///< Guiding fraction <= 1 - albedo.
  bool resamples_misses_;      ///< Draws again if a ray misses a small target.
};

} // namespace render
