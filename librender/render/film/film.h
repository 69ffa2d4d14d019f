#pragma once
/// Where samples become an image with an error bar.

#include <render/film/filter.h>
#include <render/film/image.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>

namespace render {

/// The first sample that was not finite: enough to trace it again.
struct InvalidSample {
  int x = 0, y = 0;
  std::uint32_t pass = 0, index = 0;
};

/// What paths from the lights gave to a pixel, see Film::add_light.
struct LightSums {
  double squares = 0, largest = 0; ///< luminances
  Eigen::Array3d channel_largest = Eigen::Array3d::Zero();

  void add(const Eigen::Array3d& value) {
    const double y = luminance(value);
    squares += y * y;
    largest = std::max(largest, y);
    channel_largest = channel_largest.max(value);
  }
  void merge(const LightSums& other);
};

/// What a pixel's samples are like: how far they spread, and whether one of them decides. mc::Moments of luminance and
/// channels with their range beside them would take 216 bytes a pixel for these 128, and divisions at every sample.
struct SampleSums {
  std::uint64_t count = 0;
  double sum = 0, squares = 0, largest = 0; ///< luminances
  Eigen::Array3d channel_sums = Eigen::Array3d::Zero();
  Eigen::Array3d channel_squares = Eigen::Array3d::Zero();
  Eigen::Array3d channel_largest = Eigen::Array3d::Zero();
  Eigen::Array3d channel_smallest = Eigen::Array3d::Constant(mc::infinity<double>);

  void add(const Eigen::Array3d& sample) {
    const double y = luminance(sample);
    ++count;
    sum += y;
    squares += y * y;
    largest = std::max(largest, y);
    channel_sums += sample;
    channel_squares += sample.square();
    channel_largest = channel_largest.max(sample);
    channel_smallest = channel_smallest.min(sample);
  }
  void merge(const SampleSums& other);

  /// Of the mean, were the samples independent.
  Eigen::Array3d variance_of_mean() const;

  /// How many samples like the one that lies farthest off, were it the brightest, make up the squared deviations of
  /// luminance from the mean; infinite where all are equal. Below 2 the pixel is undecided: there were too few samples
  /// of what makes it bright, and its error bar is not known yet.
  ///   light  : what paths from the lights gave, of which each counts `weight` times as much as a sample
  double effective_sample_count(const LightSums& light = {}, double weight = 0) const;

  /// How far samples jump: the largest less the smallest, R, where there are but two values, as at an edge; where these
  /// are spread evenly, as on a slope, 0. In between R sqrt(3 b / 2 - 1 / 2), where b is the square deviation over what
  /// two such values of the same mean have [BhatiaDavis00]; R where a sample is rare, beyond three deviations.
  Eigen::Array3d jump() const;
};

/// What a pixel is, as far as its samples tell.
struct PixelEstimate {
  Eigen::Array3d mean = Eigen::Array3d::Zero();
  Eigen::Array3d variance = Eigen::Array3d::Zero();       ///< of the mean; see Film::estimate
  Eigen::Array3d light_variance = Eigen::Array3d::Zero(); ///< of that what is due to paths from the lights
  std::uint64_t samples = 0;
  int sets = 0; ///< that have samples; fewer than two: the variance is not known
};

/// A mean relative standard error, and what it is below with a confidence of 95 %: few pixels may have most of the
/// noise, and each knows its variance from two sets only. But that of independent samples, of which each pixel has
/// many, bounds it, too; those count that decide, see SampleSums::deciding.
struct RelativeError {
  double value = mc::infinity<double>, bound = mc::infinity<double>;
};

/// Over what the errors of pixels are averaged.
enum class ErrorScope {
  image,      ///< all pixels
  worst_block ///< the 16x16 block where they are largest; blocks at the right and lower edge may be smaller
};
struct RelativeErrors {
  RelativeError image, worst_block;

  const RelativeError& of(ErrorScope which) const { return which == ErrorScope::image ? image : worst_block; }
};

/// What the samples of a film are.
struct FilmOptions {
  std::optional<SplatFilter> splat = {}; ///< where samples count for several pixels, as they come by `splat`
  bool has_light_paths = false;          ///< paths from the lights give something, too: 136 bytes more a pixel
  double noise_area = 1;                 ///< see Image, of samples that share paths; with splats theirs
  bool independent_samples = false;      ///< the samples of a pixel are
};

/// Sums of the samples of every pixel, apart by the independent point sets that they come from: a pixel is the mean of
/// its samples, and how its sets differ tells how far it may be off. Two sets take 56 bytes a pixel, of 192 in all;
/// mc::Moments of each set and channel would take 240.
class Film {
 public:
  /// throws : Error for a non-positive size or number of sets
  Film(int width, int height, int sets, FilmOptions options = {});

  int width() const { return width_; }
  int height() const { return height_; }
  int sets() const { return sets_; }
  bool contains(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < height_; }

  /// Adds the sum of `count` samples of one of the pixel's point sets. Pixels may be written by different threads; one
  /// pixel by one at a time.
  void add(int x, int y, int set, const Eigen::Array3d& sum, std::uint32_t count);

  /// Adds what samples, of this pixel or another, give to one of its point sets: the sums of their weighted radiance
  /// and of their weights, which are 1 for every sample of the pixel on average.
  void add_splat(int x, int y, int set, const Eigen::Array4d& sum);

  /// Adds what a path from the lights gives to one of a pixel's point sets. It belongs to no sample of the pixel: the
  /// set's mean of it is over what count_light says.
  void add_light_splat(int x, int y, int set, const Eigen::Array3d& value);
  /// Tells that a set has got the light of as many paths as `samples` samples of every pixel have.
  void add_light_path_count(int set, double samples) { light_counts_[static_cast<std::size_t>(set)] += samples; }
  /// Tells of the rays of paths from the lights.
  void add_light_rays(std::uint64_t rays) { light_rays_ += rays; }

  /// Adds the samples of a film of the same kind.
  void merge(const Film& other);

  /// Tells of the samples of a pixel, and of the rays that they took. Splats come from pixels beside the film, too.
  void record_samples(int x, int y, const SampleSums& samples, std::uint64_t rays);

  /// The mean of the pixel's samples. Sets count by their number of samples: with set means m_s of n_s samples, n in
  /// all, the variance of the mean m is sum_s n_s (m_s - m)^2 / ((sets - 1) n).
  ///   The weights of splats vary about 1, and with them what is the same everywhere. So that a sample of a constant
  /// has no noise, n_s m_s is the set's sum less c (w_s - n_s), where w_s is the sum of its weights and c the
  /// weighted mean of the other sets: c does not depend on w_s, and nothing is biased.
  ///   Sets may agree by chance where samples do not, as at an edge, of which each of k sets counts a whole number: one
  /// more or less moves a set's sum by the jump J of the samples. So the variance is at least k f (1 - f) J^2 / n^2,
  /// where f, what rounding left over, did not show in k sets: uniform beforehand, f (1 - f) is then
  /// (k + 1) / ((k + 2) (k + 3)) on average.
  /// Splats bring J^2 from the pixels about, times the squares of their weights.
  ///   Independent samples tell what sets do, and are more: the variance is by theirs, but for splats.
  ///   Light of paths from the lights adds its own mean and the variance of that, found in the same way.
  PixelEstimate estimate(int x, int y) const;
  std::uint64_t rays(int x, int y) const { return rays_[index(x, y)]; }
  /// Of paths from the lights, of as many as a sample of every pixel has; 0 where there are none.
  double light_rays() const;

  /// Means, and their variance where every pixel knows it.
  Image image() const;

  /// The mean relative standard errors: root of the mean over pixels and channels of variance / radiance^2. Radiance is
  /// that of the pixel and its neighbours, 3x3, so that a rare bright sample is not divided by itself; in the dark it
  /// is half of the picture's mean. Infinite while a pixel does not know its variance.
  RelativeErrors relative_errors() const { return relative_errors(image()); }
  /// The same for who has what image() gives.
  RelativeErrors relative_errors(const Image& image) const;

  /// Share of the pixels that are undecided, see SampleSums::deciding; a path from the lights counts as a sample.
  double outlier_dominated() const;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  // J^2 of estimate(): of splats the sum over the pixels about, each times the square of its weight.
  Eigen::Array3d squared_jump(int x, int y) const;

  // Of one of the sets of a pixel, which are those from `first` on.
  Eigen::Array3d set_sum(std::size_t first, std::size_t set) const;

  // Among the pixels whose samples count.
  std::size_t sample_index(int x, int y) const {
    const int reach = options_.splat ? options_.splat->reach() : 0;
    return static_cast<std::size_t>(y + reach) * static_cast<std::size_t>(width_ + 2 * reach) +
           static_cast<std::size_t>(x + reach);
  }

  // Of a pixel whose samples count.
  double effective_sample_count(int x, int y) const;

  // As many samples of every pixel as the paths from the lights go with.
  double light_count() const { return std::accumulate(light_counts_.begin(), light_counts_.end(), 0.0); }

  int width_, height_, sets_;
  FilmOptions options_;
  std::vector<Eigen::Array3d> sums_;  ///< sets_ of every pixel
  std::vector<std::uint32_t> counts_; ///< the same
  std::vector<double> weights_;       ///< the same, of splats; empty where there are none
  std::vector<SampleSums> samples_;   ///< by place
  std::vector<std::uint64_t> rays_;
  std::vector<Eigen::Array3d> light_; ///< as sums_, of paths from the lights; empty where there are none
  std::vector<LightSums> light_sums_; ///< of every pixel
  std::vector<double> light_counts_;  ///< of every set
  std::uint64_t light_rays_ = 0;
};

} // namespace render
