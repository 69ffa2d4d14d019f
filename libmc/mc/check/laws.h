#pragma once
/// Checks of distributions: deterministic laws and statistical tests.

#include <mc/check/check_subject.h>
#include <mc/check/laws/law.h>
#include <mc/check/subject/make_distribution.h>
#include <mc/check/subject/make_subject.h>

namespace mc {

/// Returns the checks of every deterministic law that applies to the distribution, and adds the other laws to `untried`
/// if it is not null. Each law gives one or more Checks:
///   boundary          : sample is finite and in the domain, and pdf is positive and finite, at critical values of u.
///                       These are all combinations of the ends, quarters and middle of [0,1) with their neighbours.
///                       find_breaks adds the neighbours of the branches along each axis. Faults of measure zero get a
///                       Check of their own (Fault::measure_zero). Examples are u with a coordinate of exactly 0, and
///                       single u with density 0 but correct neighbours. Samples rounded onto an edge of infinite or
///                       zero density count too, if the density next to it is correct.
///   determinism       : equal u give equal points; equal points give equal pdf and invert, bit for bit. Repeated calls
///                       follow at once and after one, two and three other samples. Different u give different points.
///   batch_consistency : samples and densities of a batch equal the results of single calls, up to rounding (needs
///                       sample_many or sample_stream_many).
///   support           : eval is finite and >= 0, and pdf > 0 wherever eval > 0, at 20000 uniform points of the chart
///                       (needs eval).
///   inverse           : |invert(sample(u)) - u| <= invert_eps eps, at 20000 random u (needs invert).
///   jacobian          : |det d sample / d u| pdf = 1. Differences over 50 digits must agree to 1e-20; without an
///                       oracle, differences in double to 1e-6 (needs invert).
///   precision         : sample and pdf agree with the 50-digit oracle within sample_eps and pdf_eps. The effect of
///                       rounding u is subtracted from the error of sample (needs an oracle).
std::vector<Check> check_deterministic_laws(const AnyDistribution& distribution, const LawOptions& options,
                                            std::vector<UntriedLaw>* untried = nullptr);

/// Returns the distribution with the tolerances of `options`, which the statistical tests use too.
AnyDistribution with_tolerances(AnyDistribution distribution, const LawOptions& options);

/// Tests the deterministic laws, then runs check_subject unless options.statistics.samples is 0.
Report check_laws(const AnyDistribution& distribution, const LawOptions& options = {});

/// The same for a warp, or any struct with Domain, domain(), sample(u) and pdf(x).
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

/// The same for a pair of functions on a domain: sample(u) -> x or an optional x, and pdf(x).
template <Domain D, class Draw, class Pdf>
Report check_laws(const D& domain, Draw sample, Pdf pdf, const LawOptions& options = {}) {
  return check_laws(
      with_tolerances(make_distribution(options.name, domain, std::move(sample), std::move(pdf)), options), options);
}

/// Checks a family of distributions, such as a BSDF over its roughness and directions, at random parameters.
///   count  : number of members, >= 1. All their tests together have options.statistics.alpha.
///   make   : returns a member, make(random), whose name states its parameters.
///   return : the report of the member that failed first; if all passed, of the one with the smallest p.
Report check_random_parameters(int count, const std::function<AnyDistribution(Pcg& random)>& make,
                               const LawOptions& options = {});

} // namespace mc
