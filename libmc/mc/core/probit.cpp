#include <mc/core/probit.h>

#include <mc/core/error.h>

#include <algorithm>
#include <cstddef>

// Compiled for several instruction sets, of which the machine chooses. Without fused operations all give the same bits.
namespace mc {

namespace {

using detail::central_probit, detail::centre_edge, detail::tail_probit;

// The tails, about a seventh of uniform numbers, are collected and computed together.
template <class S> [[gnu::always_inline]] inline void probits_of(const S* u, S* x, std::size_t n) {
  constexpr std::size_t block = 256;
  std::array<S, block> q, tail;
  std::array<std::uint32_t, block> place;
  for (std::size_t first = 0; first < n; first += block) {
    const std::size_t count = std::min(block, n - first);
    std::size_t tails = 0;
    for (std::size_t i = 0; i < count; ++i) q[i] = u[first + i] - S(0.5);
    for (std::size_t i = 0; i < count; ++i) {
      place[tails] = static_cast<std::uint32_t>(i);
      tails += !(std::abs(q[i]) <= centre_edge<S>);
    }
    for (std::size_t k = 0; k < tails; ++k) tail[k] = u[first + place[k]];
    for (std::size_t i = 0; i < count; ++i) x[first + i] = central_probit(q[i]);
    for (std::size_t k = 0; k < tails; ++k) {
      const S upper = 1 - tail[k], v = tail[k] < S(0.5) ? tail[k] : upper, value = tail_probit(v);
      tail[k] = tail[k] < S(0.5) ? value : -value;
    }
    for (std::size_t k = 0; k < tails; ++k) x[first + place[k]] = tail[k];
  }
}

#if defined(__x86_64__)
template <class S>
[[gnu::target("avx512f,avx512dq,avx512vl"), gnu::flatten]] void with_avx512(const S* u, S* x, std::size_t n) {
  probits_of(u, x, n);
}
template <class S> [[gnu::target("avx2"), gnu::flatten]] void with_avx2(const S* u, S* x, std::size_t n) {
  probits_of(u, x, n);
}
#endif

template <class S> [[gnu::flatten]] void with_baseline(const S* u, S* x, std::size_t n) { probits_of(u, x, n); }

template <class S> auto best() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return &with_avx512<S>;
  if (__builtin_cpu_supports("avx2")) return &with_avx2<S>;
#endif
  return &with_baseline<S>;
}

template <class S> void checked_probits(std::span<const S> u, std::span<S> x) {
  require(u.size() == x.size(), "probits: {} numbers and {} results; as many are needed", u.size(), x.size());
  static const auto run = best<S>();
  run(u.data(), x.data(), u.size());
}

} // namespace

void probits(std::span<const float> u, std::span<float> x) { checked_probits(u, x); }
void probits(std::span<const double> u, std::span<double> x) { checked_probits(u, x); }

} // namespace mc
