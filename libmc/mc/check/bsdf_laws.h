#pragma once
/// Checks of scattering functions: statistical tests, determinism and the laws of physics.

#include <mc/check/check_subject.h>
#include <mc/check/laws/bsdf/bsdf_law.h>

namespace mc {

/// Returns the density of wi for a fixed wo as a subject on the sphere; see bsdf_distribution.
Subject bsdf_subject(const AnyBsdf& bsdf, const Vec3<double>& wo, const BsdfOptions& options = {});

/// Returns the density of wi for a fixed wo as a subject on the sphere, for a BSDF over scalar S; see any_bsdf. A phase
/// function is a BSDF without the cosine.
template <Real S, BsdfOver<S> Bsdf>
Subject bsdf_subject(const Bsdf& bsdf, const Vec3<S>& wo, const BsdfOptions& options = {}) {
  return bsdf_subject(any_bsdf<S>(bsdf), Vec3<double>(wo.template cast<double>()), options);
}

/// Tests sample and pdf for one wo like check_subject, tests that sample is deterministic and correct at the ends and
/// branches of u, and tests these laws:
///   sign        : f is finite and >= 0 for sampled and for uniform wi.
///   support     : pdf > 0 wherever f > 0, at uniform wi. Otherwise an estimator loses light.
///   reciprocity : f(wo, wi) = f(wi, wo). Across the surface the squared ratio of the indices enters. Delta lobes are
///                 compared by the share of the energy that they carry.
///   energy      : the white furnace albedo is at most 1 in every channel; exactly 1 for a lossless BSDF. The law tests
///                 wo and 16 more directions on each side, one-sided at five standard errors. It repeats the brightest
///                 direction with as many samples as wo. The report lists the albedos as figures.
/// Directions on the side opposite to wo are tested only if samples cross the surface: a one-sided BSDF may be
/// undefined there.
Report check_bsdf(const AnyBsdf& bsdf, const Vec3<double>& wo, const BsdfOptions& options = {});

/// The same for a BSDF over scalar S. A BSDF that lacks a required member does not compile.
template <Real S, class Bsdf> Report check_bsdf(const Bsdf& bsdf, const Vec3<S>& wo, const BsdfOptions& options = {}) {
  static_assert(detail::samples_directions<Bsdf, S>, "a BSDF needs sample(wo, uc, u) const or sample(wo, u) const");
  static_assert(detail::has_eval<Bsdf, S>, "a BSDF needs eval(wo, wi) const");
  static_assert(detail::has_direction_pdf<Bsdf, S>, "a BSDF needs pdf(wo, wi) const, a number");
  static_assert(
      detail::checks_members<Bsdf, S>(),
      "the sample has a member that is not checked: name it f if it is eval(wo, wi), or weight if it is f |cos "
      "wi| / pdf; the other members are wi, pdf, delta and transmission");
  if constexpr (BsdfOver<Bsdf, S> && detail::checks_members<Bsdf, S>())
    return check_bsdf(any_bsdf<S>(bsdf), Vec3<double>(wo.template cast<double>()), options);
  else return {};
}

} // namespace mc
