#pragma once
/// Whether two pictures agree: error metrics, and t-tests with the variances of their pixels.

#include <render/film/image.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// Names of the channels for messages.
inline constexpr std::array channel_names = {"red", "green", "blue"};

/// A number that measures the difference of two pictures.
struct Metric {
  std::string_view name;
  double value;
};

/// mse, rmse, mae, relmse, max and mean_ratio over all pixels and channels. b is the reference of relative metrics.
std::vector<Metric> difference_metrics(const render::Image& a, const render::Image& b);

/// The test with the smallest p-value.
struct LargestDeviation {
  double p = 1, t = 0, dof = 0, difference = 0, error = 0;
  int x = 0, y = 0, channel = 0; ///< the pixel, or the first pixel of the block
};

/// Welch's t-tests of every pixel and of every block of 16x16 pixels.
struct DifferenceTests {
  LargestDeviation pixel, block;
  double tests = 0; ///< number of tests

  /// Sidak's p-value of all tests together.
  double family_p() const;
};

/// Tests whether two pictures differ beyond their noise. Both must pass require_comparable. A picture without variances
/// counts as exact; at least one must have them.
///   pixels    : a pixel takes the mean variance of its 3x3 neighbourhood, since a pixel that missed a rare bright path
///               underestimates its own variance. Its degrees of freedom are those of the neighbourhood, but at most
///               the sum of the two pixels' own, and at most 3: one rare bright path can dominate a pixel.
///   blocks    : detect differences that are small in every pixel.
///   tolerance : difference relative to b that counts as agreement.
DifferenceTests test_difference(const render::Image& a, const render::Image& b, double tolerance);

/// The largest relative difference of a pixel.
struct LargestRatio {
  double ratio = 0, difference = 0;
  int x = 0, y = 0, channel = 0;
};

/// Largest |a - b| over b, where dark pixels count as the mean of b. Both must pass require_comparable.
LargestRatio largest_ratio(const render::Image& a, const render::Image& b);

/// Throws Error unless both pictures have one size and finite pixels. The names stand in the message.
void require_comparable(const std::string& name_a, const render::Image& a, const std::string& name_b,
                        const render::Image& b);

/// Throws Error where the t-tests lack a usable variance: it is not finite, below 0, or too small for a float.
void require_variance(const std::string& name, const render::Image& image);

} // namespace carlo
