#pragma once
/// The random numbers of one camera path.

#include <render/core/types.h>

#include <mc/random/pcg.h>
#include <mc/sampler/padded_sobol.h>
#include <mc/sampler/stratified.h>

namespace render {

/// Independent numbers throughout. All streams are pure functions of (key, index): the key is hashed from the seed, the pixel
/// and the pass, the index counts the pixel's points within the pass.
class IndependentStream {
 public:
  IndependentStream(std::uint64_t key, std::uint32_t, std::uint32_t index) : random_(mc::hash(key, index)) {}
  Float next() { return random_.uniform<Float>(); }
  Vec2 next2() { return random_.point<Float, 2>(); }

 private:
  mc::Pcg random_;
};

/// The first pairs of a path (film, lens, the first two vertices) from a well-spread point set of `count` points, which is where
/// it pays; single numbers and later pairs independent.
template <class PointSet> class PairedStream {
 public:
  static constexpr std::uint32_t pairs = 6;

  PairedStream(std::uint64_t key, std::uint32_t count, std::uint32_t index)
      : random_(mc::hash(key, index)), key_(key), count_(count), index_(index) {}
  Float next() { return random_.uniform<Float>(); }
  Vec2 next2() { return pair_ < pairs ? PointSet::pair(key_, count_, index_, pair_++) : random_.point<Float, 2>(); }

 private:
  mc::Pcg random_;
  std::uint64_t key_;
  std::uint32_t count_, index_, pair_ = 0;
};

struct SobolPairs {
  static Vec2 pair(std::uint64_t key, std::uint32_t, std::uint32_t index, std::uint32_t number) {
    return mc::PaddedSobol{key}.pair<Float>(index, number);
  }
};
struct StratifiedPairs {
  static Vec2 pair(std::uint64_t key, std::uint32_t count, std::uint32_t index, std::uint32_t number) {
    return mc::point<Float, 2>(mc::Stratified(count, key), index, 2 * number);
  }
};
using SobolStream = PairedStream<SobolPairs>;
using StratifiedStream = PairedStream<StratifiedPairs>;

} // namespace render
