#pragma once
/// Fourier analysis of observed minus expected counts. It detects structure finer than the cells: waves, lattices and
/// grids of any offset and direction.

#include <mc/check/fit/pilot.h>
#include <mc/check/fit/weighted_counts.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/subject.h>

#include <algorithm>
#include <complex>
#include <vector>

namespace mc {

/// Counts observed and expected samples on a fine grid of the unit cube: 3^10 bins in one dimension, 729^2 in two, 81^3
/// in three, 27^4, 9^5 and 9^6 in more. Powers of 3, because random numbers are multiples of powers of 2 or 10: bins of
/// such a width would each contain the same number of lattice points. Few samples or coarsely rounded coordinates
/// reduce the number of bins, since a lattice of rounding steps is no fault.
///   step : mean width of the rounding steps of the coordinates.
class SpectrumTest {
 public:
  SpectrumTest(int dim, double samples, double step);

  void add_sample(const Subject::Coordinates& v, double weight) { observed_[bin(v)] += weight; }
  /// Adds a random point that represents a share of the expected samples.
  void add_expected(const Subject::Coordinates& v, double share) { expected_[bin(v)] += share; }
  /// Expects the same count in all bins, instead of random points.
  void expect_uniform() { std::fill(expected_.begin(), expected_.end(), 1.0); }

  /// Returns two Checks that spend half of `share` each, both given the sum of the samples. The second is missing if no
  /// band has enough independent coefficients; both if the steps leave fewer than 8 bins on an axis.
  ///   waves  : the largest squared Fourier coefficient of observed - expected. Each is exponentially distributed.
  ///   bands  : the mean squared coefficient between K/2 and K periods, K = 2, 4, ..., a chi-square that needs no
  ///            aligned cells. An uneven density correlates neighbouring coefficients, which reduces the degrees of
  ///            freedom.
  ///   all    : sums over all samples and random points.
  ///   Source : [Rayleigh1880], [Bartlett63].
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
  std::size_t size_;                        ///< number of bins on an axis
  std::vector<double> observed_, expected_; // floats would not count beyond 2^24
};

/// Returns the mean width of the rounding steps at the pilot's points, on the axis where it is largest. Each width
/// counts at most `most`.
double mean_step(const Subject& subject, const Pilot& pilot, double most);

/// Returns the first (n + 1) / 2 coefficients of the discrete Fourier transform of each row of n = 3^m real numbers.
/// The rows are contiguous.
std::vector<std::complex<float>> fourier_transform(const std::vector<float>& x, std::size_t n);

/// Replaces `count` rows of n = 3^m numbers by their discrete Fourier transforms, sum of x_j exp(-2 pi i j k / n). The
/// numbers of a row are `stride` apart, the rows `distance`.
///   error  : a few float epsilons of the root mean square, times log n.
///   Source : [CooleyTukey65].
void fourier_transform(std::complex<float>* x, std::size_t n, std::size_t stride, std::size_t count = 1,
                       std::size_t distance = 0);

} // namespace mc
