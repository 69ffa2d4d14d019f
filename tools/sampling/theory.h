#pragma once
/// What the literature says about how fast samplers converge.

#include <integrands/unit_cube_integral.h>

#include <optional>
#include <string>
#include <string_view>

namespace carlo {

/// What a rate says of the exponent of an error's fall.
///   exact    : the exponent itself
///   at_most  : the error falls no faster: logarithms of a power that is not known slow it down
///   at_least : the error falls no slower: all that is proven where nothing is known of the exponent itself
enum class RateBound { exact, at_most, at_least };

/// RMS error about N^-exponent (ln N)^log_power. `source` names keys of libmc/mc/REFERENCES.md, or what implies the
/// rate.
struct ConvergenceRate {
  double exponent = 0, log_power = 0;
  std::string_view source;
  RateBound bound = RateBound::exact;

  /// The exponent that a fit about N sees: the logarithm bends the curve.
  double local_exponent(double n) const;
  /// Whether slopes in [lo, hi], of a fit about N, hold what the rate says.
  bool is_consistent_with(double lo, double hi, double n) const;
  /// The slope with a number of digits: "-0.500", "no steeper than -1.000".
  std::string to_string(int digits) const;
};

/// The rate of a sampler or estimator, by its name, on integrands of that class over the unit cube; nothing where none
/// is stated: for integrands of no class, samplers of no name, and where the variance is infinite.
///   N       : of nets, and of Halton's points in one dimension, a power of two; of multi-jittered points a square
///   surface : one that is not parallel to the axes meets n^(d-1) of n^d cells. A jump there adds O(1/N) for each of
///             them, a kink O(n^-1 / N), so that no stratification beats N^-(1/2 + 1/(2 d)), N^-(1/2 + 3/(2 d))
///             [MitchellA96]; of scrambled nets N^-(1/2 + 1/(4 d - 2)) is proven for jumps at any surface
///             [HeWang15, He18]
///   learned : vegas, tree and auto choose a density by what they measure, so that no exponent is known. A ninth of the
///             points or more are uniform, hence E (f/p)^2 <= 9 E f^2 whatever was learned [OwenZhou00], and a
///             scrambled net has a constant times the variance of independent points at most [PanOwen23]: N^-1/2 or
///             faster
std::optional<ConvergenceRate> theoretical_rate(std::string_view method, const Smoothness& smoothness, int dim);

} // namespace carlo
