#pragma once
/// Mirrors and fuzzy metal.

#include <render/bsdf/concept.h>

#include <mc/warp/ball.h>

#include <algorithm>
#include <cmath>

namespace render {

/// Mirror direction of wo about +z.
inline Vec3 reflect(const Vec3& wo) { return {-wo.x(), -wo.y(), wo.z()}; }

/// A mirror (fuzz 0), or the fuzzy metal of [Shirley16].
///   sample : the mirror direction r plus fuzz times a uniform point of the unit ball, normalised. Directions below the
///            surface are absorbed.
///   pdf    : (t2^3 - t1^3) / (4 pi fuzz^3) [1/sr], where the ray t wi enters the ball of radius fuzz about r at t1 >=
///            0 and leaves it at t2.
///   eval   : albedo pdf / |cos wi|, so that each sample has the weight albedo. It is not reciprocal, as in the book.
///   throws : Error unless albedo and fuzz lie in [0, 1].
///   Source : sampling from [Shirley16]. The density is derived here.
class FuzzyMetal {
 public:
  /// Metal of an albedo and a fuzz.
  explicit FuzzyMetal(const Spectrum& albedo = Spectrum::Constant(Float(0.9)), Float fuzz = 0)
      : albedo_(checked_reflectance("metal: albedo", albedo)), fuzz_(fuzz) {
    mc::require(fuzz >= 0 && fuzz <= 1, "metal: fuzz {} must lie in [0, 1]", fuzz);
  }

  std::optional<BsdfSample> sample(const Vec3& wo, Float uc, const Vec2& u) const {
    if (wo.z() == 0) return {};
    const Vec3 r = reflect(wo);
    if (fuzz_ == 0) return BsdfSample{r, albedo_ / std::abs(r.z()), 1, true};
    const Vec3 w = r + fuzz_ * mc::UniformBall<Float>{}.sample({uc, u[0], u[1]});
    const Float length = w.norm();
    if (!(length > 0)) return {};
    const Vec3 wi = w / length;
    const Float density = pdf(wo, wi);
    if (!(density > 0)) return {};
    return BsdfSample{wi, albedo_ * (density / std::abs(wi.z())), density};
  }

  Spectrum eval(const Vec3& wo, const Vec3& wi) const {
    const Float density = pdf(wo, wi);
    return density > 0 ? Spectrum(albedo_ * (density / std::abs(wi.z()))) : Spectrum(Spectrum::Zero());
  }

  Float pdf(const Vec3& wo, const Vec3& wi) const {
    if (fuzz_ == 0 || !(wo.z() * wi.z() > 0)) return 0;
    const Vec3 r = reflect(wo);
    const Float middle = r.dot(wi);
    // Squared half length of the chord. |r x wi|^2 is precise for wi close to r.
    const Float chord2 = fuzz_ * fuzz_ - mc::cross<Float>(r, wi).squaredNorm();
    if (!(chord2 > 0)) return 0;
    const Float half = std::sqrt(chord2);
    const Float t2 = middle + half;
    if (!(t2 > 0)) return 0;
    const Float t1 = std::max(middle - half, Float(0));
    // t2^3 - t1^3, factored: the difference t2 - t1 is 2 half without cancellation.
    const Float difference = t1 > 0 ? 2 * half : t2;
    return difference * (t2 * t2 + t2 * t1 + t1 * t1) / (4 * mc::pi<Float> * fuzz_ * fuzz_ * fuzz_);
  }
  Float eta(const Vec3&, const Vec3&) const { return 1; }
  Float albedo(const Vec3&) const { return albedo_.maxCoeff(); }
  Lobes lobes() const { return fuzz_ == 0 ? Lobes::specular() : Lobes::glossy(Float(0.4) * fuzz_); }

 private:
  Spectrum albedo_;
  Float fuzz_;
};

} // namespace render
