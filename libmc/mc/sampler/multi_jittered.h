#pragma once
/// Correlated multi-jittered sampling.

#include <mc/core/error.h>
#include <mc/random/permute.h>
#include <mc/sampler/concept.h>

#include <cmath>

namespace mc {

/// `count` points that are well spread in each pair of dimensions (0,1), (2,3), ... Each pair is jittered on a grid of
/// columns x rows and also Latin in both axes. All columns share one shuffle, which keeps neighbours apart. Pairs are
/// shuffled independently.
///   even dimension : At most one point in each of columns * rows >= count equal intervals. Exactly one point if count
///                    is the product columns * rows, as for any square.
///   odd dimension  : Exactly one point in each of count equal intervals, for any count.
///   index  : Each further block of `count` indices is another independent set.
///   throws : Error unless count is in [1, 2^31].
///   Source : [Kensler13].
class MultiJittered {
 public:
  /// A set of `count` points, randomised by `seed`.
  explicit MultiJittered(std::uint32_t count, std::uint64_t seed = 0) : count_(count), seed_(seed) {
    require(count >= 1 && count <= 1u << 31, "MultiJittered: count {} must be in [1, 2^31]", count);
    columns_ = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(count)));
    rows_ = (count + columns_ - 1) / columns_;
  }

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    const std::uint64_t set = index / count_, key = hash(seed_, set, dim / 2), jitter = hash(~seed_, index, dim);
    const std::uint32_t s = permute(static_cast<std::uint32_t>(index % count_), count_, key);
    if (dim % 2 == 1) return jittered(s, count_, jitter);
    const std::uint32_t column = permute(s % columns_, columns_, key + 1), row = permute(s / columns_, rows_, key + 2);
    return jittered(std::uint64_t{column} * rows_ + row, std::uint64_t{columns_} * rows_, jitter);
  }

  /// Number of points in a set.
  std::uint32_t count() const { return count_; }
  /// Number of columns of the grid.
  std::uint32_t columns() const { return columns_; }
  /// Number of rows of the grid.
  std::uint32_t rows() const { return rows_; }

 private:
  std::uint32_t count_, columns_, rows_;
  std::uint64_t seed_;
};

} // namespace mc
