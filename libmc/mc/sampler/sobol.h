#pragma once
/// Sobol's sequence in many dimensions.

#include <mc/sampler/concept.h>
#include <mc/sampler/owen_scramble.h>

#include <algorithm>
#include <array>
#include <span>

namespace mc {

/// Owen-scrambled Sobol' points: a (t,s)-sequence in base 2 with an independent scrambling of each dimension.
/// Dimensions from Sobol::dimensions on are independent hashed numbers.
///   error  : The RMS error of the mean of a smooth integrand is near N^-3/2 if N is a power of two, and never much
///            larger than for independent points.
///   index  : Below 2^32.
///   Source : [Sobol67], direction numbers of [JoeKuo08] (new-joe-kuo-6, "D6") as tabulated in Boost.Random, scrambling
///            [Owen95].
class Sobol {
 public:
  /// Number of dimensions of the construction.
  static constexpr std::uint32_t dimensions = 1024;

  /// The scrambling that `seed` selects.
  explicit Sobol(std::uint64_t seed = 0) : seed_(seed), columns_(direction_numbers()) {}

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    const std::uint64_t key = hash(seed_, dim);
    const std::uint64_t low = mix64(key ^ index);
    if (dim >= dimensions) return low;
    // The 64-bit reversal moves the scrambled 32-bit word to the upper half.
    const std::uint32_t last_first = reversed(static_cast<std::uint32_t>(index), dim);
    const std::uint64_t x = reverse_bits64(owen_scramble_reversed(last_first, static_cast<std::uint32_t>(key >> 32)));
    return x | (low & 0xffffffffu);
  }

  /// Coordinate `dim` of point `index` before scrambling, in units of 2^-32.
  std::uint32_t unscrambled(std::uint32_t index, std::uint32_t dim) const { return reverse_bits(reversed(index, dim)); }
  /// The same with its bits in reverse order, as owen_scramble_reversed() takes it: the exclusive or of the columns
  /// that the bits of the index select. Reads all 32 columns, because a branch for each bit would be mispredicted.
  std::uint32_t reversed(std::uint32_t index, std::uint32_t dim) const {
    std::uint32_t x = 0;
    for (std::uint32_t k = 0; k < 32; ++k) x ^= column(k, dim) & (0u - (index >> k & 1u));
    return x;
  }
  /// Writes reversed() of points base, base + 1, ... to x. base must be a multiple of a power of two that is at least
  /// x.size().
  void fill_reversed(std::uint32_t base, std::uint32_t dim, std::span<std::uint32_t> x) const {
    x[0] = reversed(base, dim);
    // Each step doubles the number of points: the second half differs from the first by one column.
    std::size_t half = 1;
    for (std::uint32_t k = 0; half < x.size(); ++k, half *= 2) {
      const std::uint32_t* __restrict const from = x.data();
      std::uint32_t* __restrict const to = x.data() + half;
      const std::uint32_t next = column(k, dim);
      for (std::size_t i = 0; i < std::min(half, x.size() - half); ++i) to[i] = from[i] ^ next;
    }
  }

  /// Coordinate `dim` of points first, first + 1, ... Equal to coordinate<S>() bit by bit, but computes several points
  /// at a time.
  template <Real S> void fill(std::uint64_t first, std::uint32_t dim, std::span<S> out) const {
    if (dim >= dimensions) {
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = open_uniform<S>(bits(first + i, dim));
      return;
    }
    // Point i + k of an aligned block that starts at i is the exclusive or of points i and k.
    constexpr std::size_t block = 64;
    std::array<std::uint32_t, block> offsets;
    fill_reversed(0, dim, offsets);
    const std::uint64_t key = hash(seed_, dim);
    const auto scramble = static_cast<std::uint32_t>(key >> 32);
    for (std::size_t done = 0; done < out.size();) {
      const std::uint64_t index = first + done;
      const std::size_t skip = index % block, n = std::min(block - skip, out.size() - done);
      const std::uint32_t base = reversed(static_cast<std::uint32_t>(index - skip), dim);
      for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t x = reverse_bits(owen_scramble_reversed(base ^ offsets[skip + i], scramble));
        if constexpr (std::same_as<S, float>) out[done + i] = std::max(static_cast<float>(x >> 8) * 0x1p-24f, 0x1p-25f);
        else out[done + i] = open_uniform<S>((std::uint64_t{x} << 32) | (mix64(key ^ (index + i)) & 0xffffffffu));
      }
      done += n;
    }
  }

 private:
  // Column k of the generator matrix of a dimension: reversed(2^k, dim).
  std::uint32_t column(std::uint32_t k, std::uint32_t dim) const { return columns_[std::size_t{dim} * 32 + k]; }

  /// Table of dimensions x 32 columns, each with its leading bit last. Built once per process.
  static const std::uint32_t* direction_numbers();

  std::uint64_t seed_;
  const std::uint32_t* columns_;
};

} // namespace mc
