#pragma once
/// Latin hypercube sampling.

#include <mc/core/error.h>
#include <mc/random/permute.h>
#include <mc/sampler/concept.h>

namespace mc {

/// `count` points with one point in each of `count` equal intervals of every dimension, at a random place in the
/// interval.
///   dimensions : Shuffled independently, so any number of dimensions may be used.
///   error    : The additive part of an integrand contributes no variance of order 1 / count.
///   rounding : The strata are exact for bits(). A coordinate rounded to float may reach the next interval.
///   index    : Each further block of `count` indices is another independent set.
///   throws   : Error unless count >= 1.
///   Source   : [McKayBeckmanConover79].
class LatinHypercube {
 public:
  /// A set of `count` points, randomised by `seed`.
  explicit LatinHypercube(std::uint32_t count, std::uint64_t seed = 0) : count_(count), seed_(seed) {
    require(count >= 1, "LatinHypercube: count {} must be at least 1", count);
  }

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    const auto i = static_cast<std::uint32_t>(index % count_);
    return jittered(permute(i, count_, hash(seed_, index / count_, dim)), count_, hash(~seed_, index, dim));
  }

  /// Number of points in a set.
  std::uint32_t count() const { return count_; }

 private:
  std::uint32_t count_;
  std::uint64_t seed_;
};

} // namespace mc
