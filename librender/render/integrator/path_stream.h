#pragma once
/// The random numbers of one camera path.

#include <render/core/types.h>

#include <mc/random/pcg.h>
#include <mc/sampler/padded_sobol.h>
#include <mc/sampler/stratified.h>

#include <array>

namespace render {

/// Independent numbers throughout. All streams are pure functions of (key, index): the key is hashed from the seed, the
/// pixel and the pass, the index counts the pixel's points within the pass. What the points share is computed once, in
/// Points, which must outlive the streams. Where a path splits, branch(i, n) is the stream of its branch i of n.
class IndependentStream {
 public:
  struct Points {
    std::uint64_t key;
    Points(std::uint64_t k, std::uint32_t) : key(k) {}
  };
  IndependentStream(const Points& points, std::uint32_t index) : seed_(mc::hash(points.key, index)), random_(seed_) {}
  IndependentStream branch(std::uint32_t i, std::uint32_t) const { return IndependentStream(mc::hash(seed_, i)); }
  Float next() { return random_.uniform<Float>(); }
  Vec2 next2() { return random_.point<Float, 2>(); }

 private:
  explicit IndependentStream(std::uint64_t seed) : seed_(seed), random_(seed) {}

  std::uint64_t seed_;
  mc::Pcg random_;
};

/// The first pairs of a path (film, lens, the first two vertices) from a well-spread point set of `count` points, which
/// is where it pays; single numbers and later pairs independent. The branches of all paths of a pass share one point
/// set, n times as large.
template <class PointSet> class PairedStream {
 public:
  using Points = PointSet;
  static constexpr std::uint32_t pairs = Points::pairs;

  PairedStream(const Points& points, std::uint32_t index)
      : PairedStream(points, mc::hash(points.key, index), index, 0, 1) {}
  PairedStream branch(std::uint32_t i, std::uint32_t n) const {
    return PairedStream(*points_, mc::hash(seed_, i), index_ * n + i, pair_, spread_ * n);
  }
  Float next() { return random_.uniform<Float>(); }
  Vec2 next2() { return pair_ < pairs ? points_->pair(index_, pair_++, spread_) : random_.point<Float, 2>(); }

 private:
  PairedStream(const Points& points, std::uint64_t seed, std::uint32_t index, std::uint32_t pair, std::uint32_t spread)
      : seed_(seed), random_(seed), points_(&points), index_(index), pair_(pair), spread_(spread) {}

  std::uint64_t seed_;
  mc::Pcg random_;
  const Points* points_;
  std::uint32_t index_, pair_;
  std::uint32_t spread_; ///< so many times as large is the point set
};

struct SobolPairs {
  static constexpr std::uint32_t pairs = 6;
  std::uint64_t key;
  std::array<mc::PaddedSobol::PairKey, pairs> keys;

  SobolPairs(std::uint64_t k, std::uint32_t) : key(k) {
    for (std::uint32_t i = 0; i < pairs; ++i) keys[i] = mc::PaddedSobol{key}.pair_key(i);
  }
  Vec2 pair(std::uint32_t index, std::uint32_t number, std::uint32_t) const { return keys[number].point<Float>(index); }
};
struct StratifiedPairs {
  static constexpr std::uint32_t pairs = 6;
  std::uint64_t key;
  std::uint32_t count;

  StratifiedPairs(std::uint64_t k, std::uint32_t n) : key(k), count(n) {}
  Vec2 pair(std::uint32_t index, std::uint32_t number, std::uint32_t spread) const {
    return mc::point<Float, 2>(mc::Stratified(count * spread, key), index, 2 * number);
  }
};
using SobolStream = PairedStream<SobolPairs>;
using StratifiedStream = PairedStream<StratifiedPairs>;

} // namespace render
