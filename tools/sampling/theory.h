#pragma once
/// Convergence rates of samplers from the literature.

#include <integrands/unit_cube_integral.h>

#include <optional>
#include <string>
#include <string_view>

namespace carlo {

/// Relation between a stated rate and the actual exponent of the error.
///   exact    : the exponent itself.
///   at_most  : the error falls no faster; logarithms of an unknown power slow it down.
///   at_least : the error falls no slower; this is all that is proven if the exponent is unknown.
enum class RateBound { exact, at_most, at_least };

/// RMS error proportional to N^-exponent (ln N)^log_power. `source` names keys of libmc/mc/REFERENCES.md, or the
/// argument that implies the rate.
struct ConvergenceRate {
  double exponent = 0, log_power = 0;
  std::string_view source;
  RateBound bound = RateBound::exact;

  /// The exponent that a fit near N measures: the logarithm bends the curve.
  double local_exponent(double n) const;
  /// Whether a slope interval [lo, hi], from a fit near n, is consistent with the rate.
  bool is_consistent_with(double lo, double hi, double n) const;
  /// The slope with this number of digits: "-0.500", "no steeper than -1.000".
  std::string to_string(int digits) const;
};

/// The rate of a named sampler or estimator on integrands of this class over the unit cube. Nothing if no rate is
/// stated: for unclassified integrands, unnamed samplers, and infinite variance.
///   N       : a power of two for nets and for one-dimensional Halton points; a square for multi-jittered points.
///   surface : a surface that is not parallel to the axes intersects n^(d-1) of n^d cells. A jump adds O(1/N) for each
///             of them, a kink adds O(n^-1 / N). So no stratification is faster than N^-(1/2 + 1/(2 d)) for jumps and
///             N^-(1/2 + 3/(2 d)) for kinks [MitchellA96]. For scrambled nets, N^-(1/2 + 1/(4 d - 2)) is proven for
///             jumps at any surface [HeWang15, He18].
///   learned : vegas, tree and auto adapt their density to samples, so the exponent is unknown. At least a ninth of the
///             points are uniform, hence E (f/p)^2 <= 9 E f^2 for any learned density [OwenZhou00]. A scrambled net has
///             at most a constant times the variance of independent points [PanOwen23]. So the rate is N^-1/2 or
///             faster.
std::optional<ConvergenceRate> theoretical_rate(std::string_view method, const Smoothness& smoothness, int dim);

} // namespace carlo
