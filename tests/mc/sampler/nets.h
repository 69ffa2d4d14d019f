#pragma once
/// Counts of points in intervals, for the tests of samplers.

#include <mc/sampler/concept.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace test {

/// Smallest and largest number of points of indices [first, first + count) in n equal intervals of dimension dim.
struct Range {
  int least, most;
};
inline bool operator==(const Range& a, const Range& b) { return a.least == b.least && a.most == b.most; }

inline std::size_t interval(std::uint64_t bits, std::uint64_t n) {
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::size_t>((Wide{bits} * n) >> 64);
}

template <mc::Sampler T>
Range occupancy(const T& s, std::uint64_t first, std::uint64_t count, std::uint32_t dim, std::uint64_t n) {
  std::vector<int> hits(n);
  for (std::uint64_t i = 0; i < count; ++i) ++hits[interval(s.bits(first + i, dim), n)];
  return {*std::min_element(hits.begin(), hits.end()), *std::max_element(hits.begin(), hits.end())};
}

/// Same on an nx x ny grid of dimensions (dx, dy).
template <mc::Sampler T>
Range occupancy(const T& s, std::uint64_t first, std::uint64_t count, std::uint32_t dx, std::uint64_t nx,
                std::uint32_t dy, std::uint64_t ny) {
  std::vector<int> hits(nx * ny);
  for (std::uint64_t i = 0; i < count; ++i)
    ++hits[interval(s.bits(first + i, dy), ny) * nx + interval(s.bits(first + i, dx), nx)];
  return {*std::min_element(hits.begin(), hits.end()), *std::max_element(hits.begin(), hits.end())};
}

/// RMS error of the mean of f(u_dim, u_dim+1) over `seeds` samplers made by make(seed).
template <class Make, class F>
double rms_error(const Make& make, std::uint32_t count, int seeds, std::uint32_t dim, double exact, const F& f) {
  double squares = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto s = make(mc::hash(99, seed));
    double sum = 0;
    for (std::uint32_t i = 0; i < count; ++i)
      sum += f(mc::coordinate<double>(s, i, dim), mc::coordinate<double>(s, i, dim + 1));
    squares += mc::sqr(sum / count - exact);
  }
  return std::sqrt(squares / seeds);
}

/// Largest deviation of the moments mean, E u^2 and E (u_d - 1/2)(u_{d+1} - 1/2) of one point over seeds, in standard
/// deviations.
template <class Make> double seed_moments(const Make& make, std::uint64_t index, std::uint32_t dim, int seeds = 20000) {
  double first = 0, second = 0, cross = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto s = make(mc::hash(77, seed));
    const double u = mc::coordinate<double>(s, index, dim), v = mc::coordinate<double>(s, index, dim + 1);
    first += u - 0.5;
    second += u * u - 1.0 / 3;
    cross += (u - 0.5) * (v - 0.5);
  }
  const double n = seeds;
  return std::max({std::abs(first) / std::sqrt(n / 12), std::abs(second) / std::sqrt(n * 4 / 45),
                   std::abs(cross) / (std::sqrt(n) / 12)});
}

} // namespace test
