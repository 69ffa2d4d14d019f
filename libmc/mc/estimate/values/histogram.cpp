#include <mc/core/error.h>
#include <mc/estimate/values/histogram.h>

#include <algorithm>
#include <cmath>

namespace mc {

VectorIntegral integrate_histogram(const std::function<double(std::span<const double>)>& f, int dim, std::size_t bins,
                                   const BinFunction& bin_of, IntegrateOptions options) {
  require(f != nullptr && bin_of != nullptr, "integrate: the integrand is an empty function; it must be callable");
  require(bins >= 1 && bins <= 10'000, "integrate: {} bins; between 1 and 10000 are possible", bins);
  options.auxiliary_outputs = bins;
  const VectorIntegrand parts = [&](std::span<const double> u, std::span<double> values) {
    std::fill(values.begin(), values.end(), 0.0);
    values[0] = f(u);
    if (const std::size_t bin = bin_of(u, values[0]); bin < bins) values[1 + bin] = values[0];
  };
  return integrate_unit(parts, static_cast<int>(1 + bins), dim, options);
}

std::size_t octave_bin(double top, double value, std::size_t bins) {
  const double size = std::abs(value);
  if (!(size < top)) return 0;
  if (size == 0) return bins - 1;
  const int below = static_cast<int>(std::ceil(std::log2(top) - std::log2(size)));
  return std::min(static_cast<std::size_t>(std::max(below, 1)), bins - 1);
}

} // namespace mc
