#pragma once
/// Latin hypercube sampling.

#include <mc/core/error.h>
#include <mc/random/permute.h>
#include <mc/sampler/concept.h>

namespace mc {

/// `count` points of which, in every dimension, each of the `count` equal intervals holds exactly one, jittered;
/// dimensions are shuffled independently, so any number of them may be used. The variance of the additive part of an
/// integrand vanishes. That holds for bits(); rounded to float a point may reach the next interval.
///   An index >= count starts another independent set of `count` points.
///   throws : Error unless count >= 1
///   Source : [McKayBeckmanConover79]
class LatinHypercube {
 public:
  explicit LatinHypercube(std::uint32_t count, std::uint64_t seed = 0) : count_(count), seed_(seed) {
    require(count >= 1, "LatinHypercube: count {} must be at least 1", count);
  }

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    const auto i = static_cast<std::uint32_t>(index % count_);
    return jittered(permute(i, count_, hash(seed_, index / count_, dim)), count_, hash(~seed_, index, dim));
  }

  std::uint32_t count() const { return count_; }

 private:
  std::uint32_t count_;
  std::uint64_t seed_;
};

} // namespace mc
