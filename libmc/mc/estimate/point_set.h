#pragma once
/// Points of the unit cube in blocks, for integrators.

#include <mc/sampler/independent.h>
#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>

#include <span>
#include <variant>

namespace mc {

/// A Sobol' sequence of double precision points, Owen-scrambled by the seed.
struct ScrambledSobol { std::uint64_t seed = 0; };

/// The point sets that integrate() places its calls on.
using PointSet = std::variant<Independent, Stratified, ScrambledSobol>;

/// Writes points first, first + 1, ... to u, the dim coordinates of each side by side; u.size() is a multiple of dim.
///   Independent, Stratified : the bits of coordinate<double>(sampler, index, dim)
///   ScrambledSobol : the leading 32 bits of Sobol(seed) with the middle of their interval below them, so never 0 or 1; a whole
///            block at a time, since neighbours in the sequence share all but their low bits. Indices below 2^32
void fill_points(const PointSet& set, std::uint64_t first, int dim, std::span<double> u);

} // namespace mc
