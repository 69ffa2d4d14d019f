#pragma once
// Statistics of images over many seeds.

#include <render/render.h>

#include <mc/estimate/moments.h>
#include <mc/stats/chi_square.h>

#include <gtest/gtest.h>

namespace support {

/// Number of pixels of a that differ in any bit from the pixels of b shifted by (dx, dy).
inline int count_different_pixels(const render::Image& a, const render::Image& b, int dx = 0, int dy = 0) {
  int different = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      different += !(a.at(x, y) == b.at(x + dx, y + dy)).all() ||
                   !(a.variance[a.index(x, y)] == b.variance[b.index(x + dx, y + dy)]).all();
  return different;
}

/// Statistics over 150 seeds from `first` on: the sum of each image and each pixel, in green, and their stated
/// variances.
struct SeedEnsemble {
  mc::Moments sums;
  std::vector<mc::Moments> pixels;
  double variance = 0; ///< stated variance of the sum
  std::vector<double> variances;

  SeedEnsemble(const render::Scene& scene, render::RenderOptions options, std::uint64_t first)
      : pixels(std::size_t(options.width) * std::size_t(options.height)), variances(pixels.size()) {
    constexpr int seeds = 150;
    for (options.seed = first; options.seed < first + seeds; ++options.seed) {
      const render::Image image = render::render(scene, options).image;
      double sum = 0;
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        pixels[i].add(double(image.pixels[i][1]));
        sum += double(image.pixels[i][1]);
        variances[i] += double(image.variance[i][1]) / seeds;
        variance += double(image.variance[i][1]) * image.noise_area / seeds;
      }
      sums.add(sum);
    }
  }
};

/// Images with pixels that share samples have the same expectation as images without sharing, at every pixel, and their
/// stated noise is correct. Alpha is 0.1 % for the sum and for the pixels. The mean of the stated variances agrees with
/// the variance of the pixels within 12 % (four standard errors). The variance of the sum exceeds the stated variance
/// only by chance (.1 %).
///   returns : variance of the pixels divided by the variance without sharing.
inline double expect_same_statistics(const SeedEnsemble& shared, const SeedEnsemble& own) {
  const double error = std::hypot(shared.sums.std_error(), own.sums.std_error());
  EXPECT_LE(std::abs(shared.sums.mean() - own.sums.mean()), 3.29 * error);
  double squares = 0, compared = 0, stated = 0, is = 0, was = 0;
  for (std::size_t i = 0; i < shared.pixels.size(); ++i) {
    const mc::Moments &a = shared.pixels[i], &b = own.pixels[i];
    if (b.variance() > 0) {
      squares += mc::sqr(a.mean() - b.mean()) / (mc::sqr(a.std_error()) + mc::sqr(b.std_error()));
      ++compared;
    } else { // thousands of samples of one colour; a shared path may come from a neighbour with another colour
      EXPECT_NEAR(a.mean() / b.mean(), 1, 0.002) << i;
    }
    stated += shared.variances[i];
    is += a.variance();
    was += b.variance();
  }
  EXPECT_GE(compared, 70);
  EXPECT_GE(mc::chi_square_tail(squares, compared), 0.001);
  EXPECT_NEAR(stated / is, 1, 0.12);
  EXPECT_LE(shared.sums.variance() / shared.variance, 1.36); // chi-square with 149 degrees of freedom
  return is / was;
}

} // namespace support
