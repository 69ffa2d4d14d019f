#pragma once
/// Random numbers of one random walk of unknown length, such as a light path, that may split.

#include <mc/random/pcg.h>
#include <mc/sampler/padded_sobol.h>
#include <mc/sampler/stratified.h>

#include <array>
#include <cstdint>

namespace mc {

/// Random numbers of walk `index` of `count`. The first pairs of numbers come from a well-spread point set of `count`
/// points. Single numbers and later pairs come from an independent generator, which is fast.
///   Pairs        : The point set that all walks share. It must outlive the streams.
///   branch(i, n) : The stream of branch i where the walk splits into n branches. The branches of all walks share one
///                  point set with n times the points. If that set would be too large, the branches use independent
///                  numbers.
/// The numbers are a pure function of (seed of the set, index, branches taken).
template <Real S, class Pairs> class PathSampleStream {
 public:
  /// The shared point set.
  using Points = Pairs;
  /// Number of pairs from the point set.
  static constexpr std::uint32_t pairs = Pairs::pairs;

  /// The stream of walk `index`.
  PathSampleStream(const Points& points, std::uint32_t index)
      : PathSampleStream(points, hash(points.seed, index), index, 0, 1) {}
  /// The stream of branch i of n.
  PathSampleStream branch(std::uint32_t i, std::uint32_t n) const {
    bool fits = true;
    if constexpr (pairs > 0) fits = points_->can_branch(index_, std::uint64_t{scale_} * n, n);
    return PathSampleStream(*points_, hash(seed_, i), index_ * n + i, fits ? pair_ : pairs, fits ? scale_ * n : scale_);
  }
  /// The next number in [0,1), independent.
  S next() { return random_.uniform<S>(); }
  /// The next two numbers in [0,1).
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
  std::uint32_t scale_; ///< Size of the current point set divided by its initial size.
};

/// Point set without pairs: all numbers are independent.
struct IndependentPairs {
  static constexpr std::uint32_t pairs = 0; ///< Number of pairs from the point set.
  std::uint64_t seed;                       ///< Seed of the set.
  /// The set for `seed`; ignores the count.
  IndependentPairs(std::uint64_t s, std::uint32_t) : seed(s) {}
};

/// Point set of the first pairs of PaddedSobol, for any count.
struct SobolPairs {
  static constexpr std::uint32_t pairs = 6;     ///< Number of pairs from the point set.
  std::uint64_t seed;                           ///< Seed of the set.
  std::array<PaddedSobol::PairKey, pairs> keys; ///< Shared keys of the pairs.

  /// The set for seed `s`; ignores the count.
  SobolPairs(std::uint64_t s, std::uint32_t) : seed(s) {
    for (std::uint32_t i = 0; i < pairs; ++i) keys[i] = PaddedSobol{seed}.pair_key(i);
  }
  /// Pair `number` of point `index`.
  template <Real S> Vec2<S> pair(std::uint32_t index, std::uint32_t number, std::uint32_t) const {
    return keys[number].point<S>(index);
  }
  /// Whether walk `index` can split into n branches. The sequence has points for 2^32 indices, regardless of the count
  /// of the set.
  bool can_branch(std::uint32_t index, std::uint64_t, std::uint32_t n) const {
    return (std::uint64_t{index} + 1) * n <= std::uint64_t{1} << 32;
  }
};

/// Point set of the first pairs of Stratified, for `count` points.
struct StratifiedPairs {
  static constexpr std::uint32_t pairs = 6; ///< Number of pairs from the point set.
  std::uint64_t seed;                       ///< Seed of the set.
  std::uint32_t count;                      ///< Number of points before any branch.

  /// The set of n points for seed `s`.
  StratifiedPairs(std::uint64_t s, std::uint32_t n) : seed(s), count(n) {}
  /// Pair `number` of point `index` of the set with count * scale points.
  template <Real S> Vec2<S> pair(std::uint32_t index, std::uint32_t number, std::uint32_t scale) const {
    return point<S, 2>(Stratified(count * scale, seed), index, 2 * number);
  }
  /// Whether strata exist for a set with count * scale points, which all walks share.
  bool can_branch(std::uint32_t, std::uint64_t scale, std::uint32_t) const { return count * scale <= 1u << 31; }
};

/// Stream of independent numbers.
template <Real S> using IndependentPathStream = PathSampleStream<S, IndependentPairs>;
/// Stream with pairs from PaddedSobol.
template <Real S> using SobolPathStream = PathSampleStream<S, SobolPairs>;
/// Stream with pairs from Stratified.
template <Real S> using StratifiedPathStream = PathSampleStream<S, StratifiedPairs>;

} // namespace mc
