#pragma once
/// The choice of a direction where a path meets a surface.

#include <render/integrator/strategy.h>
#include <render/scene/scene.h>

#include <mc/core/frame.h>
#include <mc/table/discrete.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/mixture_n.h>

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

/// A chosen direction.
struct Direction {
  Vec3 d;          ///< in the world
  Spectrum weight; ///< f |cos| / density
  Float pdf;       ///< [1/sr] among the directions that are no delta lobe's; 0: of a delta lobe, met by nothing else
  Float eta;       ///< see BsdfSample
};

/// A mixture of the BSDF and the targets of a strategy, each equally likely.
///   choose : a direction, and its weight under the density of the whole mixture
///   pdf    : that density [1/sr], delta lobes excluded: sum of share / n pdf_i(wi) over the targets, and
///            (1 - share) pdf_bsdf(wi) where share < 1
///   A delta lobe is only ever found by following the BSDF, so a BSDF with such a lobe is followed by half of the
///   directions at least; where share = 1 its other lobes are left to the targets.
class Directions {
 public:
  Directions(const Scene& scene, const Strategy& strategy);

  template <class B, class Stream> std::optional<Direction> choose(const Vertex<B>& at, Stream& stream) const {
    if (!targets_ || at.bsdf.is_delta()) return followed(at, stream);
    const Vec2 u = stream.next2(); // u[0] also makes the choices, which are then as well spread as the directions
    const auto part = aimed(at.bsdf).sample_index(u[0]);
    if (part.index == 0) return mixed_follow(at, Vec2(part.u_remapped, u[1]), part.pmf, stream.next());
    if (shapes_.empty()) {
      Vec3 wi = mc::UniformHemisphere<Float>{}.sample({part.u_remapped, u[1]});
      if (at.wo.z() < 0) wi.z() = -wi.z();
      return weighted(at, wi, at.frame.to_world(wi), 0);
    }
    const auto target = targets_->sample_index(part.u_remapped);
    const auto s = shapes_[target.index]->sample(at.point.p, {target.u_remapped, u[1]});
    if (!s) return {};
    return weighted(at, at.frame.to_local(s->wi), s->wi, part.pmf * target.pmf * s->pdf);
  }

  /// wi in the frame, d the same in the world.
  template <class B> Float pdf(const Vertex<B>& at, const Vec3& wi, const Vec3& d) const {
    if (!targets_) return at.bsdf.pdf(at.wo, wi);
    const auto& aims = aimed(at.bsdf);
    const Float own = follows_ ? aims.pmf(0) * at.bsdf.pdf(at.wo, wi) : Float(0);
    if (shapes_.empty()) return own + (wi.z() * at.wo.z() >= 0 ? aims.pmf(1) / (2 * mc::pi<Float>) : Float(0));
    return own +
           aims.pmf(1) * mc::mixture_pdf(*targets_, [&](std::size_t i) { return shapes_[i]->pdf(at.point.p, d); });
  }

 private:
  // Outcome 1 aims, 0 follows the BSDF.
  template <class B> const mc::Bernoulli<Float>& aimed(const B& bsdf) const {
    return bsdf.has_delta() ? aims_for_delta_ : aims_;
  }

  template <class B, class Stream> static std::optional<Direction> followed(const Vertex<B>& at, Stream& stream) {
    const Float uc = stream.next();
    const auto s = at.bsdf.sample(at.wo, uc, stream.next2());
    if (!s) return {};
    return Direction{at.frame.to_world(s->wi), s->f * (std::abs(s->wi.z()) / s->pdf), s->delta ? Float(0) : s->pdf,
                     s->eta};
  }

  // The BSDF's part of the mixture, of probability pmf.
  template <class B>
  std::optional<Direction> mixed_follow(const Vertex<B>& at, const Vec2& u, Float pmf, Float uc) const {
    const auto s = at.bsdf.sample(at.wo, uc, u);
    if (!s) return {};
    const Vec3 d = at.frame.to_world(s->wi);
    if (s->delta) return Direction{d, s->f * (std::abs(s->wi.z()) / (s->pdf * pmf)), 0, s->eta};
    if (!follows_) return {};
    auto direction = weighted(at, s->wi, d, 0);
    if (direction) direction->eta = s->eta;
    return direction;
  }

  // `least`: what the technique that found the direction knows of its density. Rounding may carry a direction off the
  // shape that it aims at, as pdf() sees it.
  template <class B>
  std::optional<Direction> weighted(const Vertex<B>& at, const Vec3& wi, const Vec3& d, Float least) const {
    const Float density = std::max(pdf(at, wi, d), least);
    if (!(density > 0)) return {};
    return Direction{d, at.bsdf.eval(at.wo, wi) * (std::abs(wi.z()) / density), density, 1};
  }

  std::vector<const Shape*> shapes_;                  ///< to aim at; none: the hemisphere, if there is a target
  std::optional<mc::UniformDiscrete<Float>> targets_; ///< the choice of one; none: the BSDF is always followed
  mc::Bernoulli<Float> aims_, aims_for_delta_;
  bool follows_; ///< directions of lobes that are no delta come from the BSDF too
};

} // namespace render
