#pragma once
/// Parts of an integral by an observable.

#include <integrands/find.h>
#include <report/integrate_output.h>

#include <mc/estimate/integrate.h>

#include <cstdint>
#include <string>
#include <vector>

namespace carlo {

/// Bins, and the integrand of the whole and of each bin.
struct Histogram {
  std::vector<HistogramBin> bins;
  mc::VectorIntegrand f;    ///< fills the whole, then the part of each bin
  bool has_outside = false; ///< the first and the last bin lie outside the range
};

/// The histogram that an option asks for, of the first integrand.
///   x=20         : a variable with constant bounds, bins of equal probability in the cube.
///   r=0:2:20     : any expression between two numbers, bins of equal length, and one bin on each side.
///   r=20         : any other expression, between the extremes of 4096 points.
///   value=20     : the sizes of the values, in powers of 2.
///   throws : Error for other text, an unknown name, a number of bins outside [2, 1000], or an integrand of 0.
Histogram make_histogram(const std::string& option, const IntegrandSet& set, std::uint64_t seed);

/// The integral with its bins; outputs[1 + k] is bin k.
mc::VectorIntegral integrate(const Histogram& histogram, int dim, mc::IntegrateOptions options);

} // namespace carlo
