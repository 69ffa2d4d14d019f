#pragma once
/// Vectors of eight numbers.

#include <render/core/types.h>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace render {

/// Eight Floats; the compiler maps them to the widest registers available. The alignment is fixed for all instruction
/// sets: code for one set reads data that code for another set wrote.
typedef Float Lanes __attribute__((vector_size(8 * sizeof(Float)), aligned(8 * sizeof(Float))));
/// Eight doubles, with the same alignment for all instruction sets.
typedef double EightDoubles __attribute__((vector_size(8 * sizeof(double)), aligned(8 * sizeof(double))));

namespace detail {

/// Bit i is set if a <= b in lane i.
inline unsigned less_equal(const Lanes& a, const Lanes& b) {
#if defined(__AVX__)
  if constexpr (sizeof(Float) == 4) {
    return static_cast<unsigned>(_mm256_movemask_ps(
        _mm256_cmp_ps(reinterpret_cast<const __m256&>(a), reinterpret_cast<const __m256&>(b), _CMP_LE_OQ)));
  }
#elif defined(__SSE2__)
  if constexpr (sizeof(Float) == 4) {
    const auto *four_a = reinterpret_cast<const __m128*>(&a), *four_b = reinterpret_cast<const __m128*>(&b);
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(four_a[0], four_b[0])) |
                                 _mm_movemask_ps(_mm_cmple_ps(four_a[1], four_b[1])) << 4);
  }
#endif
  unsigned mask = 0;
  for (int i = 0; i < 8; ++i) mask |= static_cast<unsigned>(a[i] <= b[i]) << i;
  return mask;
}

/// The larger of t and old in each lane; old if t is NaN, as the max instruction does.
inline Lanes larger(const Lanes& t, const Lanes& old) {
#if defined(__AVX__)
  if constexpr (sizeof(Float) == 4)
    return reinterpret_cast<const Lanes&>(static_cast<const __m256&>(
        _mm256_max_ps(reinterpret_cast<const __m256&>(t), reinterpret_cast<const __m256&>(old))));
#endif
  return t > old ? t : old;
}
/// The smaller of t and old in each lane; old if t is NaN.
inline Lanes smaller(const Lanes& t, const Lanes& old) {
#if defined(__AVX__)
  if constexpr (sizeof(Float) == 4)
    return reinterpret_cast<const Lanes&>(static_cast<const __m256&>(
        _mm256_min_ps(reinterpret_cast<const __m256&>(t), reinterpret_cast<const __m256&>(old))));
#endif
  return t < old ? t : old;
}

/// Square root.
inline double square_root(double x) { return std::sqrt(x); }
/// Square root of each lane.
inline EightDoubles square_root(const EightDoubles& x) {
#if defined(__AVX512F__)
  return reinterpret_cast<const EightDoubles&>(static_cast<const __m512d&>(
      _mm512_mask_sqrt_pd(reinterpret_cast<const __m512d&>(x), 0xff, reinterpret_cast<const __m512d&>(x))));
#else
  EightDoubles root;
  for (int i = 0; i < 8; ++i) root[i] = std::sqrt(x[i]); // the compiler vectorizes this loop
  return root;
#endif
}

/// Bit i is set if the comparison of doubles holds in lane i.
template <class Mask>
requires(sizeof(Mask) == sizeof(EightDoubles)) unsigned lane_bits(const Mask& mask) {
#if defined(__AVX512DQ__)
  return _mm512_movepi64_mask(reinterpret_cast<const __m512i&>(mask));
#elif defined(__AVX__)
  const auto* four = reinterpret_cast<const __m256d*>(&mask);
  return static_cast<unsigned>(_mm256_movemask_pd(four[0]) | _mm256_movemask_pd(four[1]) << 4);
#else
  unsigned bits = 0;
  for (int i = 0; i < 8; ++i) bits |= unsigned(mask[i] != 0) << i;
  return bits;
#endif
}

} // namespace detail
} // namespace render
