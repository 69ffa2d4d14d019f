#pragma once
/// The laws that every sampler obeys.

#include <mc/check/check_subject.h>
#include <mc/check/laws/law.h>
#include <mc/check/subject/make_distribution.h>
#include <mc/check/subject/make_subject.h>

namespace mc {

/// The deterministic laws that the sampler has what they need for, each one or more Checks:
///   boundary : sample finite and in the domain, pdf positive and finite, for u in the product of the ends, quarters
///               and the middle of [0,1) with their neighbours, and beside the branches that find_breaks sees on lines
///               along each axis; apart (Fault::measure_zero) sets of measure zero: u with a coordinate of exactly 0,
///               single u whose neighbours are right where the density is 0 at one point, and samples rounded onto the
///               edge of the domain where the density is 0 or infinite, but not beside it
///   determinism : the same u gives the same point, the same point the same pdf and inverse, bit for bit, at once and
///               after one, two and three other samples; other u give other points
///   batch_consistency : samples and densities of many at once are those of one alone, but for rounding (with sample_many)
///   support   : eval finite and >= 0, and pdf > 0 wherever eval > 0, at 20000 uniform points of the chart (with eval)
///   inverse   : invert(sample(u)) = u at 20000 random u, within invert_eps               (with invert)
///   jacobian  : |det d sample / d u| pdf = 1 to 1e-20 by differences over 50 digits, or without an oracle to 1e-6 in
///               double                                                                   (with invert)
///   precision : sample and pdf against the 50-digit oracle, within pdf_eps, and sample_eps beyond what rounding u
///               makes (with an oracle)
std::vector<Check> check_deterministic_laws(const AnyDistribution& distribution, const LawOptions& options);

/// The sampler with the bounds of its contract set for the statistical tests too.
AnyDistribution with_tolerances(AnyDistribution distribution, const LawOptions& options);

/// The deterministic laws, and everything that check_subject does: per-sample laws, mass, chi-squares, tails, KS,
/// cells, inverted samples.
Report check_laws(const AnyDistribution& distribution, const LawOptions& options = {});

/// The same for a warp, or any struct with a domain, sample and pdf.
template <class W> Report check_laws(const W& warp, const LawOptions& options = {}) {
  static_assert(detail::has_domain<W>, "check_laws: a warp needs `using Domain = ...` and domain() const");
  static_assert(!detail::has_domain<W> || detail::has_chart<W>,
                "check_laws: a Domain needs dim, measure and const from_unit, to_unit, jacobian and contains");
  static_assert(!detail::has_chart<W> || detail::has_sample<W>,
                "check_laws: sample(u) const must take u, a point of the unit cube (Domain::UnitPoint), no generator");
  static_assert(!detail::has_chart<W> || detail::has_pdf<W>, "check_laws: a warp needs pdf(x) const");
  if constexpr (ContinuousDistribution<W>)
    return check_laws(with_tolerances(make_distribution(options.name, warp), options), options);
  else return {};
}

/// The same for a pair of functions on a domain: sample(u) -> x or optional x, pdf(x).
template <Domain D, class Draw, class Pdf>
Report check_laws(const D& domain, Draw sample, Pdf pdf, const LawOptions& options = {}) {
  return check_laws(
      with_tolerances(make_distribution(options.name, domain, std::move(sample), std::move(pdf)), options), options);
}

} // namespace mc
