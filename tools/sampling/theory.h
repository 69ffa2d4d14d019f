#pragma once
/// What the literature says about how fast samplers converge.

#include <integrands/experiments.h>

#include <optional>
#include <string_view>

namespace carlo {

/// RMS error about N^-exponent (ln N)^log_power; or, with at_most, falling no faster: logarithms of a power that is not
/// known slow it down.
struct Rate {
  double exponent = 0, log_power = 0;
  std::string_view source;
  bool at_most = false;

  /// The exponent that a fit about N sees: the logarithm bends the curve.
  double local(double n) const;
};

/// The rate of a sampler or estimator, by its name, on integrands of that class over the unit cube; nothing where none
/// is stated.
///   a surface that is not parallel to the axes meets n^(d-1) of n^d cells: a jump there adds O(1/N) for each of them,
///   a kink O(n^-1 / N), so that no stratification beats N^-(1/2 + 1/(2 d)), N^-(1/2 + 3/(2 d)) [MitchellA96, HeWang15]
std::optional<Rate> theory(std::string_view way, const Smoothness& smoothness, int dim);

} // namespace carlo
