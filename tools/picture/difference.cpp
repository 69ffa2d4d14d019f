#include <picture/difference.h>

#include <mc/core/error.h>
#include <mc/stats/t_test.h>

#include <algorithm>
#include <cmath>

namespace carlo {

using render::Image;

namespace {

// The noise of an image: whether variances are known, their degrees of freedom, and the number of correlated pixels.
struct ImageNoise {
  double dof, area;
  explicit ImageNoise(const Image& image) : dof(std::max(2.0, double(image.estimates)) - 1), area(image.noise_area) {}
  // An exact image has none.
  double variance(const Image& image, std::size_t i, int c) const {
    return image.variance.empty() ? 0 : double(image.variance[i][c]) * area;
  }
};

/// Sums over a rectangle of pixels, or one pixel, with the variances of these sums.
struct BlockSums {
  double pixels = 0, difference = 0, reference = 0, variance_a = 0, variance_b = 0;
  mc::VarianceSum all; ///< variances of both
};

class Comparison {
 public:
  Comparison(const Image& a, const Image& b, double tolerance)
      : a_(a), b_(b), noise_a_(a), noise_b_(b), tolerance_(tolerance),
        max_pixel_dof_(std::min(noise_a_.dof + noise_b_.dof, 3.0)) {}

  void run() {
    for (int c = 0; c < 3; ++c) {
      // A pixel without any rare event has variance 0; a floor keeps differences far below the typical noise from
      // counting.
      const BlockSums whole = sum(0, 0, a_.width, a_.height, c);
      floor_ = 1e-6 * (whole.variance_a + whole.variance_b) / double(a_.pixels.size());
      for (int y = 0; y < a_.height; ++y)
        for (int x = 0; x < a_.width; ++x) {
          BlockSums sums = sum(x, y, x + 1, y + 1, c);
          const int x0 = std::max(x - 1, 0), y0 = std::max(y - 1, 0), x1 = std::min(x + 2, a_.width),
                    y1 = std::min(y + 2, a_.height);
          const BlockSums around = sum(x0, y0, x1, y1, c);
          sums.variance_a = around.variance_a / around.pixels / noise_a_.area;
          sums.variance_b = around.variance_b / around.pixels / noise_b_.area;
          sums.all = around.all;
          test(sums, x, y, c, result.pixel);
        }
      for (int y = 0; y < a_.height; y += block_size)
        for (int x = 0; x < a_.width; x += block_size) {
          const int x1 = std::min(x + block_size, a_.width), y1 = std::min(y + block_size, a_.height);
          test(sum(x, y, x1, y1, c), x, y, c, result.block);
        }
    }
  }

  DifferenceTests result;
  static constexpr int block_size = 16;

 private:
  BlockSums sum(int x0, int y0, int x1, int y1, int c) const {
    BlockSums sums;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        const std::size_t i = a_.index(x, y);
        ++sums.pixels;
        sums.difference += double(a_.pixels[i][c]) - double(b_.pixels[i][c]);
        sums.reference += double(b_.pixels[i][c]);
        // Correlated pixels count as fewer independent variances.
        const double va = noise_a_.variance(a_, i, c), vb = noise_b_.variance(b_, i, c);
        sums.variance_a += va;
        sums.variance_b += vb;
        sums.all.add(va, noise_a_.dof, noise_a_.area);
        sums.all.add(vb, noise_b_.dof, noise_b_.area);
      }
    return sums;
  }

  // Welch's t-test of the mean of the pixels.
  void test(const BlockSums& sums, int x, int y, int c, LargestDeviation& worst) {
    const double n = sums.pixels;
    ++result.tests;
    const double variance = std::max((sums.variance_a + sums.variance_b) / n, floor_) / n;
    const double difference = sums.difference / n;
    const double excess = std::max(0.0, std::abs(difference) - tolerance_ * std::abs(sums.reference / n));
    if (excess == 0) return;
    double p = 0, t = mc::infinity<double>;
    const double dof = n == 1 ? std::min(sums.all.dof(), max_pixel_dof_) : sums.all.dof();
    if (variance > 0) {
      t = excess / std::sqrt(variance);
      p = mc::student_tail(t, dof);
    }
    if (p < worst.p || (p == worst.p && t > worst.t)) worst = {p, t, dof, difference, std::sqrt(variance), x, y, c};
  }

  const Image &a_, &b_;
  ImageNoise noise_a_, noise_b_;
  double tolerance_, max_pixel_dof_, floor_ = 0;
};

} // namespace

std::vector<Metric> difference_metrics(const Image& a, const Image& b) {
  double square = 0, absolute = 0, relative = 0, peak = 0, mean_a = 0, mean_b = 0;
  const double n = 3.0 * double(a.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double x = double(a.pixels[i][c]), y = double(b.pixels[i][c]), d = x - y;
      square += d * d;
      absolute += std::abs(d);
      relative += d * d / (y * y + 0.01);
      peak = std::max(peak, std::abs(d));
      mean_a += x;
      mean_b += y;
    }
  return {{"mse", square / n},   {"rmse", std::sqrt(square / n)},
          {"mae", absolute / n}, {"relmse", relative / n},
          {"max", peak},         {"mean_ratio", mean_a == mean_b ? 1 : mean_a / mean_b}};
}

double DifferenceTests::family_p() const {
  return -std::expm1(tests * std::log1p(-std::min(std::min(pixel.p, block.p), 1 - 0x1p-53)));
}

DifferenceTests test_difference(const Image& a, const Image& b, double tolerance) {
  Comparison comparison(a, b, tolerance);
  comparison.run();
  return comparison.result;
}

LargestRatio largest_ratio(const Image& a, const Image& b) {
  double mean = 0;
  for (const render::Spectrum& x : b.pixels) mean += double(x.abs().mean()) / double(b.pixels.size());
  LargestRatio worst;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double difference = double(a.at(x, y)[c]) - double(b.at(x, y)[c]);
        const double ratio =
            difference == 0 ? 0 : std::abs(difference) / std::max(std::abs(double(b.at(x, y)[c])), mean);
        if (ratio > worst.ratio) worst = {ratio, difference, x, y, c};
      }
  return worst;
}

void require_comparable(const std::string& name_a, const Image& a, const std::string& name_b, const Image& b) {
  mc::require(a.width == b.width && a.height == b.height, "'{}' is {}x{} but '{}' is {}x{}; the sizes must agree",
              name_a, a.width, a.height, name_b, b.width, b.height);
  for (const auto* image : {&a, &b})
    for (std::size_t i = 0; i < image->pixels.size(); ++i)
      mc::require(image->pixels[i].isFinite().all(), "'{}': pixel ({}, {}) is not finite",
                  image == &a ? name_a : name_b, i % static_cast<std::size_t>(a.width),
                  i / static_cast<std::size_t>(a.width));
}

void require_variance(const std::string& name, const Image& image) {
  double largest = 0, noise = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double variance = double(image.variance[i][c]);
      mc::require(
          std::isfinite(variance) && variance >= 0,
          "'{}': the variance of pixel ({}, {}) in {} is {:.3g}; it must be finite and >= 0 (error metrics need none)",
          name, i % static_cast<std::size_t>(image.width), i / static_cast<std::size_t>(image.width),
          channel_names[static_cast<std::size_t>(c)], variance);
      largest = std::max(largest, std::abs(double(image.pixels[i][c])));
      noise = std::max(noise, variance);
    }
  mc::require(noise > 0 || largest == 0 || largest >= 1e-18,
              "'{}': the largest value is {:.3g}, too small for its variance to be a float; render with brighter light",
              name, largest);
}

} // namespace carlo
