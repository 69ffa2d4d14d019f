#pragma once
/// Jittered sampling.

#include <mc/core/error.h>
#include <mc/random/permute.h>
#include <mc/sampler/concept.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace mc {

/// `count` jittered points. Takes dimensions in groups of `group` and cuts the cube of each group into `count` boxes of
/// equal volume, about count^(1/group) along each side. Every box contains one point.
///   count  : Any count works, not only perfect powers: the thickness of a stratum is proportional to its number of
///            boxes.
///   dimensions : Groups are shuffled independently, so any number of dimensions may be used.
///   index  : Each further block of `count` indices is another independent set.
///   error  : RMS error of the mean is count^(-1/2 - 1/group) for a Lipschitz integrand of one group. It is count^-3/4
///            for an integrand with a jump along a curve in the square [MitchellA96].
///   throws : Error unless count >= 1 and group >= 1.
class Stratified {
 public:
  /// A set of `count` points in groups of `group` dimensions, randomised by `seed`.
  explicit Stratified(std::uint32_t count, std::uint64_t seed = 0, std::uint32_t group = 2)
      : count_(count), group_(group), seed_(seed) {
    require(count >= 1, "Stratified: count {} must be at least 1", count);
    require(group >= 1, "Stratified: group {} must be at least 1", group);
  }

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    std::uint64_t result = 0;
    descend(index, dim / group_, dim % group_, [&](std::uint32_t axis, const Stratum& s, std::uint32_t n) {
      if (axis == dim % group_) result = inside(s, n, hash(seed_, index, dim));
    });
    return result;
  }

  /// The first u.size() coordinates of a point, equal to coordinate<S>(). Finds the box of each group only once.
  template <Real S> void point(std::uint64_t index, std::span<S> u) const {
    const auto dims = static_cast<std::uint32_t>(u.size());
    for (std::uint32_t first = 0; first < dims; first += group_)
      descend(index, first / group_, std::min(group_, dims - first) - 1,
              [&](std::uint32_t axis, const Stratum& s, std::uint32_t n) {
                u[first + axis] = open_uniform<S>(inside(s, n, hash(seed_, index, first + axis)));
              });
  }

  /// Number of points in a set.
  std::uint32_t count() const { return count_; }

 private:
  struct Stratum {
    std::uint32_t start, size;
  };

  // Calls visit(axis, stratum, n) for axes 0 to `last` of a group. `stratum` is the range of boxes, among the n boxes
  // left, that contains the box of the point.
  template <class Visit>
  void descend(std::uint64_t index, std::uint32_t group, std::uint32_t last, Visit&& visit) const {
    std::uint32_t box = permute(static_cast<std::uint32_t>(index % count_), count_, hash(seed_, index / count_, group));
    std::uint32_t n = count_;
    for (std::uint32_t axis = 0;; ++axis) {
      const Stratum s = stratum(box, n, group_ - axis);
      visit(axis, s, n);
      if (axis == last) return;
      box -= s.start;
      n = s.size;
    }
  }

  // The stratum that contains `box` when n boxes are cut along the first of d remaining dimensions.
  static Stratum stratum(std::uint32_t box, std::uint32_t n, std::uint32_t d) {
    if (d == 1) return {box, 1};
    const auto strata = std::clamp(static_cast<std::uint32_t>(std::lround(root(n, d))), 1u, n);
    const auto start_of = [&](std::uint64_t i) { return static_cast<std::uint32_t>((i * n + strata - 1) / strata); };
    const auto i = static_cast<std::uint32_t>(std::uint64_t{box} * strata / n);
    return {start_of(i), start_of(i + 1) - start_of(i)};
  }

  // The d-th root of n. No integer is the d-th power of half an odd number, so rounding the result is safe for any
  // method.
  static double root(double n, std::uint32_t d) {
    switch (d) {
    case 2: return std::sqrt(n);
    case 3: return std::cbrt(n);
    case 4: return std::sqrt(std::sqrt(n));
    default: return std::pow(n, 1.0 / d);
    }
  }

  // A jittered point in the stratum [start, start + size) of n boxes, as an exact 64-bit binary fraction below 1.
  static std::uint64_t inside(const Stratum& s, std::uint32_t n, std::uint64_t jitter) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>(((Wide{s.start} << 64) + Wide{s.size} * jitter) / n);
  }

  std::uint32_t count_, group_;
  std::uint64_t seed_;
};

} // namespace mc
