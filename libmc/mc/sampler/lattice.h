#pragma once
/// Rank-1 lattice points.

#include <mc/sampler/concept.h>
#include <mc/sampler/owen_scramble.h>

#include <array>

namespace mc {

/// Rank-1 lattice sequence with a random shift: coordinate j of point i is frac(phi(i) z_j + shift_j).
///   phi        : The radical inverse of the index in base 2. The first 2^k points are a complete lattice, and any
///                count is valid.
///   dimensions : Dimensions from Lattice::dimensions on are independent hashed numbers.
///   strata     : Among any 2^k consecutive indices aligned to 2^k, k <= 32, each of the 2^k intervals of the shifted
///                one-dimensional grid contains one point.
///   use        : Best for smooth periodic integrands. Prefer Sobol if f(0) != f(1). The vector z is optimised for
///                counts up to 2^16, and larger counts are valid but less even.
///   Source     : Sequence [HickernellEtAl00], shift [CranleyPatterson76]. z is from a randomised
///                component-by-component search [SloanReztsov02] over the shift-averaged error of 2^6 to 2^16 points,
///                with weight 0.15 / (1 + j^2 / 4) for dimension j.
class Lattice {
 public:
  /// The generating vector z.
  static constexpr std::array<std::uint32_t, 32> generator{
      1,      1029519, 1019311, 847137, 613851, 984953, 333077, 576759, 481383, 663435, 510119,
      631621, 105641,  370371,  45717,  996983, 370619, 723165, 651101, 606695, 348567, 687571,
      383161, 859021,  921247,  235095, 289293, 233011, 25639,  311607, 149325, 801821};
  /// Number of dimensions of the construction.
  static constexpr std::uint32_t dimensions = static_cast<std::uint32_t>(generator.size());

  /// The random shift that `seed` selects.
  explicit Lattice(std::uint64_t seed = 0) : seed_(seed) {}

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    const std::uint64_t shift = hash(seed_, dim);
    if (dim >= dimensions) return mix64(shift ^ index);
    // 32-bit overflow takes the fraction
    const std::uint32_t x = reverse_bits(static_cast<std::uint32_t>(index)) * generator[dim];
    return (std::uint64_t{x} << 32) + shift;
  }

 private:
  std::uint64_t seed_;
};

} // namespace mc
