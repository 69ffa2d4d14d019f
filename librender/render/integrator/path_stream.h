#pragma once
/// The random numbers of one camera path.

#include <render/core/types.h>

#include <mc/random/pcg.h>
#include <mc/sampler/padded_sobol.h>
#include <mc/sampler/stratified.h>

#include <array>

namespace render {

/// Independent numbers throughout. All streams are pure functions of (key, index): the key is hashed from the seed, the pixel
/// and the pass, the index counts the pixel's points within the pass. What the points share is computed once, in Points.
class IndependentStream {
 public:
  struct Points {
    std::uint64_t key;
    Points(std::uint64_t k, std::uint32_t) : key(k) {}
  };
  IndependentStream(const Points& points, std::uint32_t index) : random_(mc::hash(points.key, index)) {}
  IndependentStream(std::uint64_t key, std::uint32_t count, std::uint32_t index) : IndependentStream(Points(key, count), index) {}
  Float next() { return random_.uniform<Float>(); }
  Vec2 next2() { return random_.point<Float, 2>(); }

 private:
  mc::Pcg random_;
};

/// The first pairs of a path (film, lens, the first two vertices) from a well-spread point set of `count` points, which is where
/// it pays; single numbers and later pairs independent.
template <class PointSet> class PairedStream {
 public:
  using Points = PointSet;
  static constexpr std::uint32_t pairs = Points::pairs;

  PairedStream(const Points& points, std::uint32_t index) : random_(mc::hash(points.key, index)), points_(points), index_(index) {}
  PairedStream(std::uint64_t key, std::uint32_t count, std::uint32_t index) : PairedStream(Points(key, count), index) {}
  Float next() { return random_.uniform<Float>(); }
  Vec2 next2() { return pair_ < pairs ? points_.pair(index_, pair_++) : random_.point<Float, 2>(); }

 private:
  mc::Pcg random_;
  Points points_;
  std::uint32_t index_, pair_ = 0;
};

struct SobolPairs {
  static constexpr std::uint32_t pairs = 6;
  std::uint64_t key;
  std::array<mc::PaddedSobol::PairKey, pairs> keys;

  SobolPairs(std::uint64_t k, std::uint32_t) : key(k) {
    for (std::uint32_t i = 0; i < pairs; ++i) keys[i] = mc::PaddedSobol{key}.pair_key(i);
  }
  Vec2 pair(std::uint32_t index, std::uint32_t number) const { return keys[number].point<Float>(index); }
};
struct StratifiedPairs {
  static constexpr std::uint32_t pairs = 6;
  std::uint64_t key;
  std::uint32_t count;

  StratifiedPairs(std::uint64_t k, std::uint32_t n) : key(k), count(n) {}
  Vec2 pair(std::uint32_t index, std::uint32_t number) const { return mc::point<Float, 2>(mc::Stratified(count, key), index, 2 * number); }
};
using SobolStream = PairedStream<SobolPairs>;
using StratifiedStream = PairedStream<StratifiedPairs>;

} // namespace render
