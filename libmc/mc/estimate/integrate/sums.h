#pragma once
/// What the tasks of a run add up.

#include <mc/estimate/magnitudes.h>
#include <mc/estimate/moments.h>

#include <cstdint>
#include <span>
#include <vector>

namespace mc::detail {

/// Moments of values of any size: kept in units of a power of two, so that neither tiny nor huge values lose their
/// squares. Values between 2^-256 and 2^256 are added as they are.
class ScaledMoments {
 public:
  /// A block of values, changed in place, whose indices start at `first`; `largest` bounds their absolute values.
  void add(std::span<double> values, std::uint64_t first, double largest);
  void merge(const ScaledMoments& other);

  double mean() const;
  double std_error() const;
  double variation() const; ///< standard deviation of the values
  const Moments& moments() const { return moments_; }

 private:
  void rescale(int exponent);

  Moments moments_;
  int exponent_ = 0;
};

/// Moments and magnitudes of every output, and, where they are recorded, the points and the integrand's values there.
struct Sums {
  std::vector<ScaledMoments> outputs;
  std::vector<Magnitudes> magnitudes;
  std::vector<double> points = {}, values = {};
  void merge(const Sums& other);
};

} // namespace mc::detail
