#pragma once
/// What the tasks of a run add up.

#include <mc/estimate/diagnostics/axis_profile.h>
#include <mc/estimate/diagnostics/integrand_diagnostics.h>
#include <mc/estimate/moments.h>

#include <cstdint>
#include <optional>
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
  double std_deviation() const; ///< standard deviation of the values
  const Moments& moments() const { return moments_; }

 private:
  void rescale(int exponent);
  /// Or no values at all.
  bool only_zeros() const { return moments_.mean() == 0 && moments_.variance() == 0; }

  Moments moments_;
  int exponent_ = 0;
};

/// Moments of every output and what was seen of it, and, where they are kept, the points and the integrand's values
/// there, and the moments of batches of the values.
struct Sums {
  static constexpr std::size_t batch_count = 32;

  std::vector<ScaledMoments> outputs;
  std::vector<IntegrandDiagnostics> diagnostics;
  std::vector<double> points = {}, values = {};
  std::vector<ScaledMoments> batches = {};          ///< batch_count for each output
  AxisProfile profile = {};                         ///< of its first points
  std::optional<std::uint64_t> first_infinite = {}; ///< index of the first point where the integrand was

  /// Infinite values become 0, of points whose indices start at `first` and which stand for so much of the volume each.
  void zero_infinite_values(std::span<double> all_values, std::span<const double> volumes, std::uint64_t first);

  /// Values of an output whose indices start at `first`: 32 to a batch, in turn.
  void add_to_batches(std::size_t output, std::span<const double> values, std::uint64_t first, double largest);
  void merge(const Sums& other);
};

/// What all of them saw of each output, beside what was seen before.
std::vector<IntegrandDiagnostics> merged_diagnostics(const std::vector<Sums>& all,
                                                     std::vector<IntegrandDiagnostics> before = {});

} // namespace mc::detail
