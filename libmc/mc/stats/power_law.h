#pragma once
/// How error falls with the number of samples.

#include <cstdint>
#include <span>
#include <vector>

namespace mc {

/// Root-mean-square error at one N, from independent repetitions against the true value.
struct RmsError {
  double n = 0;
  double rms = 0;
  double lo = 0, hi = 0; ///< 95 % confidence interval of the RMS error
  double seconds = 0;    ///< CPU seconds of one repetition, where the caller measures them
  bool is_bound = false; ///< only known to be at most rms = hi, since what it is measured from is not known so well
};

/// The binary exponent of the largest |x|, 0 where all are 0: of ldexp(x, -exponent) no square overflows, and none
/// vanishes that matters beside the largest.
int largest_exponent(std::span<const double> x);

/// E error^4 / (E error^2)^2 of the errors of `estimates`; 0 where there is none. Of long tails, of which few estimates
/// tell, it is too small.
double error_kurtosis(std::span<const double> estimates, double truth);

/// How many errors of normal law tell an RMS error as well as R of this kurtosis do: at most R, at least 1.
double effective_error_count(double r, double kurtosis);

/// RMS error of `estimates` against `truth`.
///   interval : from the chi-square distribution, with as many degrees of freedom as effective_error_count says of their
///              kurtosis, or of `kurtosis`, what is known of it otherwise, where that is larger
///   scale    : of errors of any size, since they are squared in units of the largest number
///   throws   : Error for fewer than 2 estimates, or when one or the truth is not finite
RmsError rms_error(double n, std::span<const double> estimates, double truth, double kurtosis = 0);

/// A power law rms = c N^slope.
struct PowerLaw {
  double slope = 0, lo = 0, hi = 0; ///< with its 95 % confidence interval
  double constant = 0;              ///< c
};

/// Least squares of log rms against log N. The logarithm of an RMS error of R repetitions has variance close to 1 / (2
/// R), whatever N, so all points weigh the same; the interval is the wider of that theory and of the scatter about the
/// line (Student t), since curvature is an error of the law too.
///   throws : Error for fewer than 3 points, no repetitions, an N or an error that is not finite and > 0, or all N
///            equal
PowerLaw fit_power_law(std::span<const RmsError> errors, std::uint32_t repetitions);

} // namespace mc
