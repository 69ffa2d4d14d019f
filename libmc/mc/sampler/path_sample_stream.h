#pragma once
/// The numbers of one random walk of unknown length, a light path say, that may split.

#include <mc/random/pcg.h>
#include <mc/sampler/padded_sobol.h>
#include <mc/sampler/stratified.h>

#include <array>
#include <cstdint>

namespace mc {

/// Walk `index` of `count`: its first pairs come from a well-spread set of `count` points in pairs of dimensions, which
/// is where spreading pays; single numbers and later pairs are independent, at the price of a generator's step.
///   made from : Pairs, which holds what all walks of a set share and must outlive them, and the index
///   next      : one number in [0,1);  next2 : two
///   branch(i, n) : the stream of branch i of n where the walk splits. The branches of all walks share one point set,
///               n times as large; where that has too many points to count, their numbers are independent.
/// A pure function of (seed of the set, index, branches taken).
template <Real S, class Pairs> class PathSampleStream {
 public:
  using Points = Pairs;
  static constexpr std::uint32_t pairs = Pairs::pairs;

  PathSampleStream(const Points& points, std::uint32_t index)
      : PathSampleStream(points, hash(points.seed, index), index, 0, 1) {}
  PathSampleStream branch(std::uint32_t i, std::uint32_t n) const {
    bool fits = true;
    if constexpr (pairs > 0) fits = points_->can_branch(index_, std::uint64_t{scale_} * n, n);
    return PathSampleStream(*points_, hash(seed_, i), index_ * n + i, fits ? pair_ : pairs, fits ? scale_ * n : scale_);
  }
  S next() { return random_.uniform<S>(); }
  Vec2<S> next2() {
    if constexpr (pairs > 0)
      if (pair_ < pairs) return points_->template pair<S>(index_, pair_++, scale_);
    return random_.point<S, 2>();
  }

 private:
  PathSampleStream(const Points& points, std::uint64_t seed, std::uint32_t index, std::uint32_t pair,
                   std::uint32_t scale)
      : seed_(seed), random_(seed), points_(&points), index_(index), pair_(pair), scale_(scale) {}

  std::uint64_t seed_;
  Pcg random_;
  const Points* points_;
  std::uint32_t index_, pair_;
  std::uint32_t scale_; ///< how many times as large as at first the point set is
};

/// No pairs: all numbers are independent.
struct IndependentPairs {
  static constexpr std::uint32_t pairs = 0;
  std::uint64_t seed;
  IndependentPairs(std::uint64_t s, std::uint32_t) : seed(s) {}
};

/// The first pairs of PaddedSobol, for any count.
struct SobolPairs {
  static constexpr std::uint32_t pairs = 6;
  std::uint64_t seed;
  std::array<PaddedSobol::PairKey, pairs> keys;

  SobolPairs(std::uint64_t s, std::uint32_t) : seed(s) {
    for (std::uint32_t i = 0; i < pairs; ++i) keys[i] = PaddedSobol{seed}.pair_key(i);
  }
  template <Real S> Vec2<S> pair(std::uint32_t index, std::uint32_t number, std::uint32_t) const {
    return keys[number].point<S>(index);
  }
  /// Whether the set has points for n branches of walk `index`: its sequence has as many as indices can count, however
  /// many a set is said to have.
  bool can_branch(std::uint32_t index, std::uint64_t, std::uint32_t n) const {
    return (std::uint64_t{index} + 1) * n <= std::uint64_t{1} << 32;
  }
};

/// The first pairs of Stratified, for sets of `count` points.
struct StratifiedPairs {
  static constexpr std::uint32_t pairs = 6;
  std::uint64_t seed;
  std::uint32_t count;

  StratifiedPairs(std::uint64_t s, std::uint32_t n) : seed(s), count(n) {}
  template <Real S> Vec2<S> pair(std::uint32_t index, std::uint32_t number, std::uint32_t scale) const {
    return point<S, 2>(Stratified(count * scale, seed), index, 2 * number);
  }
  /// Whether there are strata for the set times `scale`, of which every walk takes part.
  bool can_branch(std::uint32_t, std::uint64_t scale, std::uint32_t) const { return count * scale <= 1u << 31; }
};

template <Real S> using IndependentPathStream = PathSampleStream<S, IndependentPairs>;
template <Real S> using SobolPathStream = PathSampleStream<S, SobolPairs>;
template <Real S> using StratifiedPathStream = PathSampleStream<S, StratifiedPairs>;

} // namespace mc
