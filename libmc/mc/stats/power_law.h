#pragma once
/// Convergence of the error with the number of samples.

#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// RMS error at one N, from independent repetitions compared with the true value.
struct RmsError {
  double n = 0;       ///< Number of samples N of one repetition.
  double rms = 0;     ///< Root-mean-square error.
  double lo = 0,      ///< Lower end of the 95 % confidence interval of the RMS error.
      hi = 0;         ///< Upper end.
  double seconds = 0; ///< CPU seconds of one repetition, if the caller measures them.
  /// Whether rms = hi is only an upper bound, because the reference value is not accurate enough.
  bool is_bound = false;

  /// The fields, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(n, rms, lo, hi, seconds, is_bound); }
};

/// Kurtosis E error^4 / (E error^2)^2 of the errors of `estimates`; 0 if all errors are 0. Too small for heavy tails
/// that few estimates reach.
double error_kurtosis(std::span<const double> estimates, double truth);

/// Number of normal errors that would determine an RMS error as precisely as R errors of this kurtosis do, in [1, R].
double effective_error_count(double r, double kurtosis);

/// RMS error of `estimates` with respect to `truth`.
///   interval : From the chi-square distribution with effective_error_count() degrees of freedom. Uses the larger of
///              the kurtosis of the errors and `kurtosis`, an estimate from other data.
///   scale    : Accepts errors of any size, because squares are taken in units of the largest number.
///   throws   : Error for fewer than 2 estimates, or if an estimate or the truth is not finite.
RmsError rms_error(double n, std::span<const double> estimates, double truth, double kurtosis = 0);

/// A power law rms = c N^slope.
struct PowerLaw {
  double slope = 0,    ///< Exponent.
      lo = 0,          ///< Lower end of its 95 % confidence interval.
      hi = 0;          ///< Upper end.
  double constant = 0; ///< Factor c.
};

/// Fits a power law by least squares of log rms against log N. The log of an RMS error of R repetitions has variance
/// close to 1 / (2 R) for any N, so all points have equal weight. The interval is the wider one of this theory and of
/// the scatter about the line (Student t), because curvature is an error of the law too.
///   throws : Error for fewer than 3 points, no repetitions, an N or an error that is not finite and > 0, or if all N
///            are equal.
PowerLaw fit_power_law(std::span<const RmsError> errors, std::uint32_t repetitions);

} // namespace mc
