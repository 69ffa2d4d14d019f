#pragma once
/// Decomposition of an integral into bins.

#include <mc/estimate/integrate.h>

#include <cstddef>
#include <functional>
#include <span>

namespace mc {

/// Bin of a point u of the unit cube where the integrand has the value `value`. Numbers beyond the last bin mean no
/// bin.
using BinFunction = std::function<std::size_t(std::span<const double> u, double value)>;

/// Integral of f over the unit cube, with its part from each of `bins` bins, from the same evaluations. outputs[0] is
/// the integral, with the same bits as integrate_unit() without a histogram. outputs[1 + k] is the part of bin k, with
/// its own error bar.
///   throws : As integrate_unit().
VectorIntegral integrate_histogram(const std::function<double(std::span<const double>)>& f, int dim, std::size_t bins,
                                   const BinFunction& bin_of, IntegrateOptions options = {});

/// Bin by magnitude: 0 for |value| >= top, k for top / 2^k <= |value| < top / 2^(k-1), and the last of `bins` for all
/// smaller values.
std::size_t octave_bin(double top, double value, std::size_t bins);

} // namespace mc
