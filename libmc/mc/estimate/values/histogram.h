#pragma once
/// Where an integral comes from.

#include <mc/estimate/integrate.h>

#include <cstddef>
#include <functional>
#include <span>

namespace mc {

/// The bin of a point of the unit cube and the integrand's value there; any number beyond the bins: none.
using BinFunction = std::function<std::size_t(std::span<const double> u, double value)>;

/// The integral over the unit cube of f, and the part of it that comes from each of `bins` bins, from the same calls:
/// outputs[0] is the integral, with the bits of integrate_unit without a histogram, outputs[1 + k] what bin k gives,
/// each with an error bar of its own.
///   throws : as integrate_unit
VectorIntegral integrate_histogram(const std::function<double(std::span<const double>)>& f, int dim, std::size_t bins,
                                   const BinFunction& bin_of, IntegrateOptions options = {});

/// Bins by the size of the values, for integrand values of any sign: 0 for |value| >= top, k for top / 2^k <= |value| <
/// top / 2^(k-1), and the last of `bins` for all below.
std::size_t octave_bin(double top, double value, std::size_t bins);

} // namespace mc
