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
template <class B> struct Vertex {
  const B& bsdf;
  const SurfacePoint& point;
  mc::Frame<Float> frame; ///< about the shading normal
  Vec3 wo;                ///< in the frame
};

/// Whether the direction (wi in the frame, d in the world) lies on the same side of the true surface as of the one that
/// the shading normal pretends: light must not leak through, nor be lost, where the two disagree.
template <class B> bool is_real(const Vertex<B>& at, const Vec3& wi, const Vec3& d) {
  if (at.point.ns == at.point.ng) return true;
  const Float seen_from = at.frame.to_world(at.wo).dot(at.point.ng);
  return (seen_from * d.dot(at.point.ng) > 0) == (at.wo.z() * wi.z() > 0);
}

/// Where a path goes next.
struct ChosenDirection {
  Vec3 d;          ///< in the world
  Spectrum weight; ///< f |cos| / density
  Float pdf;       ///< [1/sr] among the directions that are no narrow lobe's; 0: of a narrow lobe, met by nothing else
  Float eta;       ///< see BsdfSample
  Float over_bsdf; ///< density over that of following the BSDF alone: large where a small target was aimed at
};

/// Whether the strategy finds every light of the scene: chance never meets a point light or a directional one.
bool finds_all_lights(const Scene& scene, const Strategy& strategy);

/// Whether the strategy leaves out light for good, since every direction goes to lamps or guides while paths are long
/// enough, in edges (-1: no limit), to find light elsewhere: on other surfaces, or in the sky.
bool misses_light(const Scene& scene, const Strategy& strategy, int max_depth);

/// Whether a lamp lies in the sphere, or its box reaches into it.
bool holds_a_lamp(const Scene& scene, const Sphere& sphere);

/// A mixture of the BSDF and the targets of a strategy, each equally likely.
///   choose : a direction, and its weight under the density of the whole mixture
///   pdf    : that density [1/sr], narrow lobes excluded: sum of share / n pdf_i(wi) over the targets, and
///            (1 - share) pdf_bsdf(wi) where share < 1
///   A narrow BSDF is always followed. Where glass and mirrors are the target no BSDF aims more often than it absorbs:
///   what follows it would weigh albedo / (1 - share) at every turn, and of the paths in a white room or in rough glass
///   few would be left to carry all the light. Of those that go round in rough glass three in a thousand came through
///   twenty turns.
///   A delta lobe is only ever found by following the BSDF, so a BSDF with such a lobe is followed by half of the
///   directions at least; where share = 1 its other lobes are left to the targets.
class Directions {
 public:
  Directions(const Scene& scene, const Strategy& strategy);
  /// share : of the directions go to the targets, which must outlive it; where there are none the BSDF is followed
  Directions(std::vector<const Shape*> targets, Float share);

  template <class B, class Stream> std::optional<ChosenDirection> choose(const Vertex<B>& at, Stream& stream) const {
    if (!targets_ || at.bsdf.is_narrow()) return followed(at, stream);
    const Vec2 u = stream.next2(); // u[0] also makes the choices, which are then as well spread as the directions
    const auto part = aims(at).sample_index(u[0]);
    return part.index == 0 ? mixed_follow(at, Vec2(part.u_remapped, u[1]), part.pmf, stream.next())
                           : aim(at, Vec2(part.u_remapped, u[1]), stream);
  }

  /// wi in the frame, d the same in the world.
  template <class B> Float pdf(const Vertex<B>& at, const Vec3& wi, const Vec3& d) const {
    if (!targets_) return at.bsdf.pdf(at.wo, wi);
    return mixed(at, follows_ ? at.bsdf.pdf(at.wo, wi) : Float(0), targets_pdf(at, wi, d));
  }

 private:
  // Outcome 1 aims, 0 follows the BSDF.
  template <class B> mc::Bernoulli<Float> aims(const Vertex<B>& at) const {
    const Float share = at.bsdf.has_delta() ? std::min(share_, Float(0.5)) : share_;
    return mc::Bernoulli<Float>(spares_ ? std::min(share, std::max(1 - at.bsdf.albedo(at.wo), Float(0))) : share);
  }

  template <class B, class Stream> static std::optional<ChosenDirection> followed(const Vertex<B>& at, Stream& stream) {
    const Float uc = stream.next();
    const auto s = at.bsdf.sample(at.wo, uc, stream.next2());
    if (!s) return {};
    const Vec3 d = at.frame.to_world(s->wi);
    if (!is_real(at, s->wi, d)) return {};
    const bool is_narrow = s->delta || at.bsdf.is_narrow();
    return ChosenDirection{d, s->f * (std::abs(s->wi.z()) / s->pdf), is_narrow ? Float(0) : s->pdf, s->eta, 1};
  }

  // The BSDF's part of the mixture, of probability pmf.
  template <class B>
  std::optional<ChosenDirection> mixed_follow(const Vertex<B>& at, const Vec2& u, Float pmf, Float uc) const {
    const auto s = at.bsdf.sample(at.wo, uc, u);
    if (!s) return {};
    const Vec3 d = at.frame.to_world(s->wi);
    if (!is_real(at, s->wi, d)) return {};
    if (s->delta) return ChosenDirection{d, s->f * (std::abs(s->wi.z()) / (s->pdf * pmf)), 0, s->eta, pmf};
    if (!follows_) return {};
    const Float density = mixed(at, s->pdf, targets_pdf(at, s->wi, d));
    return ChosenDirection{d, s->f * (std::abs(s->wi.z()) / density), density, s->eta, density / s->pdf};
  }

  // The targets' part.
  template <class B, class Stream>
  std::optional<ChosenDirection> aim(const Vertex<B>& at, const Vec2& u, Stream& stream) const {
    if (shapes_.empty()) {
      const bool through = at.bsdf.transmits();
      Vec3 wi = through ? mc::UniformSphere<Float>{}.sample(u) : mc::UniformHemisphere<Float>{}.sample(u);
      if (!through && at.wo.z() < 0) wi.z() = -wi.z();
      const Vec3 d = at.frame.to_world(wi);
      return aimed_at(at, wi, d, targets_pdf(at, wi, d));
    }
    const auto target = targets_->sample_index(u[0]);
    const auto s = sample_toward(*shapes_[target.index], at.point, {target.u_remapped, u[1]}, stream);
    if (!s) return {};
    const Float density = mc::mixture_pdf(
        *targets_, [&](std::size_t i) { return i == target.index ? s->pdf : shapes_[i]->pdf(at.point.p, s->wi); });
    return aimed_at(at, at.frame.to_local(s->wi), s->wi, density);
  }

  // Rounding carries rays past the outline of a small target. Where light is found by meeting it alone that of these
  // would be lost: another direction takes the place of theirs. A target that none meets is not tried for ever, and of
  // one that is not small nothing is lost but 3e-7: it saves a tenth of the time.
  template <class Stream>
  std::optional<DirectionSample> sample_toward(const Shape& target, const SurfacePoint& from, const Vec2& u,
                                               Stream& stream, int tries = 8) const {
    constexpr Float small = 100; // [1/sr]
    const auto s = target.sample_direction(from.p, u);
    const auto is_met = [&](const Ray& ray) { return target.pdf(ray.o, ray.d) > 0; };
    if (!redraws_ || tries == 0 || !s || s->pdf <= small || is_met(from.spawn_ray(s->wi))) return s;
    return sample_toward(target, from, stream.next2(), stream, tries - 1);
  }

  template <class B>
  std::optional<ChosenDirection> aimed_at(const Vertex<B>& at, const Vec3& wi, const Vec3& d, Float targets) const {
    if (!is_real(at, wi, d)) return {};
    const Float own = at.bsdf.pdf(at.wo, wi), density = mixed(at, own, targets);
    return ChosenDirection{d, at.bsdf.eval(at.wo, wi) * (std::abs(wi.z()) / density), density, at.bsdf.eta(at.wo, wi),
                           density / own};
  }

  // The density of the mixture, from those of its parts.
  template <class B> Float mixed(const Vertex<B>& at, Float own, Float targets) const {
    const auto part = aims(at);
    return (follows_ ? part.pmf(0) * own : Float(0)) + part.pmf(1) * targets;
  }
  template <class B> Float targets_pdf(const Vertex<B>& at, const Vec3& wi, const Vec3& d) const {
    if (shapes_.empty() && at.bsdf.transmits()) return 1 / (4 * mc::pi<Float>);
    if (shapes_.empty()) return wi.z() * at.wo.z() >= 0 ? 1 / (2 * mc::pi<Float>) : Float(0);
    return mc::mixture_pdf(*targets_, [&](std::size_t i) { return shapes_[i]->pdf(at.point.p, d); });
  }

  std::vector<const Shape*> shapes_;                  ///< to aim at; none: the hemisphere, if there is a target
  std::optional<mc::UniformDiscrete<Float>> targets_; ///< the choice of one; none: the BSDF is always followed
  Float share_;
  bool follows_; ///< directions of lobes that are no delta come from the BSDF too
  bool spares_;  ///< no BSDF aims more often than it absorbs
  bool redraws_; ///< where directions miss what they were aimed at, others take their place
};

} // namespace render
