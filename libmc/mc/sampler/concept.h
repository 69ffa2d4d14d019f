#pragma once
/// Samplers: point sets in (0,1)^d as pure functions of (index, dim).

#include <mc/random/uniform.h>

#include <cstdint>
#include <utility>

namespace mc {

/// An immutable point set in the unit cube.
///   bits(index, dim) : Coordinate `dim` of point `index` as a 64-bit binary fraction of [0,1). Any index below 2^32
///                      and any dim are valid.
///   dimensions : Dimensions beyond the construction are independent hashed numbers. They never repeat earlier
///                dimensions.
///   seed : A constructor argument. Each seed gives an independent randomisation of the same construction.
template <class T>
concept Sampler = requires(const T s, std::uint64_t index, std::uint32_t dim) {
  { s.bits(index, dim) } -> std::same_as<std::uint64_t>;
};

/// Point at fraction jitter / 2^64 of interval `i` of `n` equal intervals of [0,1), i < n, as a 64-bit binary fraction.
/// Rounds down, so the result is below 1.
constexpr std::uint64_t jittered(std::uint64_t i, std::uint64_t n, std::uint64_t jitter) {
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>(((Wide{i} << 64) + jitter) / n);
}

/// Coordinate `dim` of point `index`, strictly inside of (0,1).
template <Real S, Sampler T> S coordinate(const T& sampler, std::uint64_t index, std::uint32_t dim) {
  return open_uniform<S>(sampler.bits(index, dim));
}

/// Coordinates dim, dim + 1, ... of point `index`; a plain scalar if N = 1.
template <Real S, int N, Sampler T> Point<S, N> point(const T& sampler, std::uint64_t index, std::uint32_t dim = 0) {
  if constexpr (N == 1) return coordinate<S>(sampler, index, dim);
  else if constexpr (requires { sampler.template point<S, N>(index, dim); })
    return sampler.template point<S, N>(index, dim);
  else {
    Point<S, N> u;
    for (int i = 0; i < N; ++i) u[i] = coordinate<S>(sampler, index, dim + static_cast<std::uint32_t>(i));
    return u;
  }
}

/// Returns the coordinates of one point one after another.
template <Real S, Sampler T> class SampleStream {
 public:
  /// Starts at coordinate `dim` of point `index`.
  SampleStream(T sampler, std::uint64_t index, std::uint32_t dim = 0)
      : sampler_(std::move(sampler)), index_(index), dim_(dim) {}

  /// The next coordinate, in (0,1).
  S next() { return coordinate<S>(sampler_, index_, dim_++); }
  /// The next N coordinates.
  template <int N> Point<S, N> next() {
    const Point<S, N> u = point<S, N>(sampler_, index_, dim_);
    dim_ += N;
    return u;
  }
  /// The dimension that next() returns next.
  std::uint32_t dim() const { return dim_; }
  /// Continues with coordinate `dim`.
  void skip_to(std::uint32_t dim) { dim_ = dim; }

 private:
  T sampler_;
  std::uint64_t index_;
  std::uint32_t dim_;
};

} // namespace mc
