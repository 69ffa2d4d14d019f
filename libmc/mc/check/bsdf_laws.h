#pragma once
/// The laws of scattering functions.

#include <mc/check/check_subject.h>
#include <mc/check/laws/bsdf/bsdf_law.h>

namespace mc {

/// A BSDF with fixed wo as a subject on the sphere of wi; see bsdf_distribution.
Subject bsdf_subject(const AnyBsdf& bsdf, const Vec3<double>& wo, const BsdfOptions& options = {});

/// A BSDF over scalar S with fixed wo as a subject on the sphere of wi; see any_bsdf and bsdf_distribution. A phase function is
/// a BSDF without the cosine.
template <Real S, BsdfOver<S> Bsdf>
Subject bsdf_subject(const Bsdf& bsdf, const Vec3<S>& wo, const BsdfOptions& options = {}) {
  return bsdf_subject(any_bsdf<S>(bsdf), Vec3<double>(wo.template cast<double>()), options);
}

/// Everything check_subject finds for one wo, that sample is a function of its random numbers, and the physics:
///   sign        : f finite and >= 0, for sampled wi and for uniform ones
///   support     : pdf > 0 wherever f > 0 at uniform wi, or the estimator would miss light
///   reciprocity : f(wo, wi) = f(wi, wo), with the squared index across the surface; delta lobes by their shares of the
///                 energy
///   energy      : at most 1 (exactly 1 where lossless) in every channel, at wo and at 16 more directions a side,
///                 one-sided at five standard errors, and once more with all samples where these find the most; the
///                 white furnace values are figures of the report
/// Directions on the other side than wo are only looked from where samples cross the surface: a BSDF of one side may be
/// undefined there.
Report check_bsdf(const AnyBsdf& bsdf, const Vec3<double>& wo, const BsdfOptions& options = {});

template <Real S, class Bsdf> Report check_bsdf(const Bsdf& bsdf, const Vec3<S>& wo, const BsdfOptions& options = {}) {
  static_assert(detail::samples_directions<Bsdf, S>, "a BSDF needs sample(wo, uc, u) const or sample(wo, u) const");
  static_assert(detail::has_eval<Bsdf, S>, "a BSDF needs eval(wo, wi) const");
  static_assert(detail::has_direction_pdf<Bsdf, S>, "a BSDF needs pdf(wo, wi) const, a number");
  if constexpr (BsdfOver<Bsdf, S>)
    return check_bsdf(any_bsdf<S>(bsdf), Vec3<double>(wo.template cast<double>()), options);
  else return {};
}

} // namespace mc
