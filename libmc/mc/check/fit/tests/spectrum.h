#pragma once
/// Structure finer than any cell: waves, lattices and grids of any offset and direction in what samples and density
/// leave of each other.

#include <mc/check/fit/pilot.h>
#include <mc/check/fit/weighted_counts.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <algorithm>
#include <complex>
#include <vector>

namespace mc {

/// Counts samples and what is expected of them on a fine grid of the unit cube: 2^16 bins on an axis, 1024^2 on two,
/// 64^3 on three, fewer for few samples and for coordinates that are rounded: a lattice of steps as wide as a bin is no
/// fault.
///   step : mean width of the steps to which coordinates are rounded
class SpectrumTest {
 public:
  SpectrumTest(int dim, double samples, double step);

  void add_sample(const Subject::Coordinates& v, double weight) { observed_[bin(v)] += static_cast<float>(weight); }
  /// A random point that stands for a share of the expected samples.
  void add_expected(const Subject::Coordinates& v, double share) { expected_[bin(v)] += static_cast<float>(share); }
  /// Instead of random points: the same everywhere.
  void expect_uniform() { std::fill(expected_.begin(), expected_.end(), 1.0f); }

  /// Two Checks that spend half of `share` each, both given the sum of the samples.
  ///   waves : the largest of the Fourier coefficients of observed - expected, each exponential in its square
  ///   bands : their mean square between K/2 and K periods, K = 2, 4, ..., a chi-square that needs no aligned cells;
  ///           where the density is uneven, neighbouring coefficients are correlated and there are fewer degrees of
  ///           freedom
  /// None where the steps leave fewer than 8 bins on an axis.
  ///   Source : [Rayleigh1880], [Bartlett63]
  ///   all : sums over all samples and random points
  std::vector<Check> test(const WeightedCounts& all, double share, double alpha, const char* coordinates) const;

 private:
  std::size_t bin(const Subject::Coordinates& v) const {
    std::size_t index = 0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(dim_); ++d) {
      const double scaled = v[d] * static_cast<double>(size_);
      const auto i = static_cast<std::size_t>(static_cast<std::int64_t>(scaled > 0 ? scaled : 0.0));
      index = index * size_ + (i < size_ ? i : size_ - 1);
    }
    return index;
  }

  int dim_;
  std::size_t size_; ///< bins of an axis
  std::vector<float> observed_, expected_;
};

/// The mean over the pilot's points of the steps to which coordinates are rounded, on the axis where it is largest; a
/// point counts at most `most`.
double mean_step(const Subject& subject, const Pilot& pilot, double most);

/// The first n/2 + 1 coefficients of the discrete Fourier transforms of rows of n = 2^m real numbers, which follow each
/// other.
std::vector<std::complex<float>> fourier_transform(const std::vector<float>& x, std::size_t n);

/// In place, the discrete Fourier transforms of `count` rows of n = 2^m numbers: sum of x_j exp(-2 pi i j k / n). The
/// numbers of a row lie `stride` apart, the rows `distance`.
///   error : a few float epsilons of the root mean square, times log n
///   Source : [CooleyTukey65]
void fourier_transform(std::complex<float>* x, std::size_t n, std::size_t stride, std::size_t count = 1,
                       std::size_t distance = 0);

} // namespace mc
