#pragma once
/// Points of the unit cube in blocks, for integrators.

#include <mc/sampler/independent.h>
#include <mc/sampler/sobol.h>
#include <mc/sampler/stratified.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

namespace mc {

/// A Sobol' sequence of double precision points, Owen-scrambled by the seed. In one and two dimensions each coordinate interlaces the
/// bits of two of the sequence's: a net of order 2, whose error for n points of a smooth integrand falls like n^-2.5 instead of n^-1.5.
/// In more dimensions interlaced points were no better than plain ones at 10^5 of them, so they stay plain.
///   Source : [Dick11]
struct ScrambledSobol { std::uint64_t seed = 0; };
inline constexpr std::size_t interlaced_dims = 2;

/// The point sets that integrate() places its calls on.
using PointSet = std::variant<Independent, Stratified, ScrambledSobol>;

/// Writes points first, first + 1, ... to u, the dim coordinates of each side by side; u.size() is a multiple of dim.
///   Independent, Stratified : the bits of coordinate<double>(sampler, index, dim)
///   ScrambledSobol : the leading 32 bits of Sobol(seed), or 26 of each of two coordinates where they are interlaced, with the middle of
///            their interval below them, so never 0 or 1; a whole block at a time, since neighbours in the sequence share all but their
///            low bits. Indices below 2^32
void fill_points(const PointSet& set, std::uint64_t first, int dim, std::span<double> u);

} // namespace mc
