#pragma once
/// Sums that the tasks of a run accumulate.

#include <mc/estimate/diagnostics/axis_profile.h>
#include <mc/estimate/diagnostics/integrand_diagnostics.h>
#include <mc/estimate/moments.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mc::detail {

/// Moments of values of any size, in units of a power of two, so that squares of tiny or huge values do not underflow
/// or overflow. Values between 2^-256 and 2^256 are added unscaled.
class ScaledMoments {
 public:
  /// Adds a block of values with indices from `first` on, and modifies them. `largest` is an upper bound of their
  /// absolute values.
  void add(std::span<double> values, std::uint64_t first, double largest);
  /// Adds the values of other moments.
  void merge(const ScaledMoments& other);

  /// Mean of the values.
  double mean() const;
  /// Standard error of the mean.
  double std_error() const;
  double std_deviation() const; ///< Standard deviation of the values.
  /// Moments in units of the power of two.
  const Moments& moments() const { return moments_; }

 private:
  void rescale(int exponent);
  /// Whether all values are 0, or there are none.
  bool only_zeros() const { return moments_.mean() == 0 && moments_.variance() == 0; }

  Moments moments_;
  int exponent_ = 0;
};

/// Moments and diagnostics of every output. Optionally also the points with their values, and the moments of batches of
/// values.
struct Sums {
  /// Number of batches.
  static constexpr std::size_t batch_count = 32;

  std::vector<ScaledMoments> outputs;               ///< Moments of each output.
  std::vector<IntegrandDiagnostics> diagnostics;    ///< Diagnostics of each output.
  std::vector<double> points = {}, values = {};     ///< Recorded points and values.
  std::vector<ScaledMoments> batches = {};          ///< batch_count moments for each output.
  AxisProfile profile = {};                         ///< Profile of the first points.
  std::optional<std::uint64_t> first_infinite = {}; ///< Index of the first point with an infinite value.

  /// Replaces infinite values by 0 and counts them. Points have indices from `first` on and represent `volumes` of the
  /// cube.
  void zero_infinite_values(std::span<double> all_values, std::span<const double> volumes, std::uint64_t first);

  /// Adds values of an output with indices from `first` on: 32 to a batch, cyclically.
  void add_to_batches(std::size_t output, std::span<const double> values, std::uint64_t first, double largest);
  /// Adds the sums of other points.
  void merge(const Sums& other);
};

/// Diagnostics of each output over all sums, added to `before`.
std::vector<IntegrandDiagnostics> merged_diagnostics(const std::vector<Sums>& all,
                                                     std::vector<IntegrandDiagnostics> before = {});

} // namespace mc::detail
