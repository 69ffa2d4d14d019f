#pragma once
/// Accumulation of samples into an image with error bars.

#include <render/film/filter.h>
#include <render/film/image.h>
#include <render/film/sample_statistics.h>

#include <mc/run/archive.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>

namespace render {

/// Location of a sample that was not finite: enough to trace it again.
struct InvalidSample {
  int x = 0,              ///< Column in the full image.
      y = 0;              ///< Row in the full image.
  std::uint32_t pass = 0, ///< Randomisation of the pixel's points; see PixelPoints.
      index = 0;          ///< Index of the point in the randomisation.

  /// The location, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(x, y, pass, index); }
};

/// Contributions of light paths that no pixel of the film takes; see Film::add_unseen_light.
struct UnseenLight {
  std::uint64_t count = 0; ///< Number of contributions.
  double sum = 0;          ///< Sum of their luminances.

  /// Adds one contribution, unless it is not finite.
  void add(const Spectrum& value) {
    if (!value.isFinite().all()) return;
    ++count;
    sum += double(luminance(value));
  }
  /// Adds other contributions.
  void merge(const UnseenLight& other) {
    count += other.count;
    sum += other.sum;
  }
  /// The sums, see mc/run/archive.h.
  template <class Archive> void archive(Archive& a) { a(count, sum); }
};

/// Estimate of a pixel from its samples.
struct PixelEstimate {
  Eigen::Array3d mean = Eigen::Array3d::Zero();           ///< Mean per channel.
  Eigen::Array3d variance = Eigen::Array3d::Zero();       ///< Variance of the mean; see Film::estimate.
  Eigen::Array3d light_variance = Eigen::Array3d::Zero(); ///< Part of `variance` due to light paths.
  std::uint64_t samples = 0;                              ///< Number of samples.
  int sets = 0; ///< Number of point sets with samples; below 2 the variance is unknown.
};

/// Relative standard error, root mean square over pixels, with an upper bound of 95 % confidence. The estimate is
/// uncertain: a few pixels may contribute most of the noise, and each estimates its variance from few point sets. A
/// second bound uses the samples as if independent, with SampleStatistics::effective_sample_count as degrees of
/// freedom. The smaller bound counts. Pixels that share noise count for one. To this is added what samples brighter
/// than any so far may contribute, from the tail of the brightest samples of the pixels (mc::excess_beyond).
struct RelativeError {
  double value = mc::infinity<double>, ///< The estimate.
      bound = mc::infinity<double>;    ///< Upper bound with 95 % confidence.
};

class FilmBlock;

/// Pixels over which errors are averaged.
enum class ErrorScope {
  image,      ///< All pixels.
  worst_block ///< The 16x16 block with the largest error; blocks at the right and lower edges may be smaller.
};
/// Errors of a film in both scopes.
struct RelativeErrors {
  RelativeError image, ///< Error over all pixels.
      worst_block;     ///< Error of the worst block.

  /// The error of a scope.
  const RelativeError& of(ErrorScope which) const { return which == ErrorScope::image ? image : worst_block; }
};

/// Properties of a film's samples.
struct FilmOptions {
  std::optional<SplatFilter> splat = {}; ///< Filter of splatting; none: each sample counts for one pixel.
  bool has_light_paths = false;          ///< Whether light paths contribute; they need further sums for each pixel.
  /// Noise area of samples that share paths (see Image); with splats, theirs multiplies it.
  double noise_area = 1;
  bool independent_samples = false; ///< Whether the samples of a pixel are independent.
};

/// Sums of samples for each pixel and each independent point set. The mean of the samples is the pixel's value, and the
/// differences between the point sets give its variance. Plain sums need less memory than mc::Moments of each set.
class Film {
 public:
  /// An empty film.
  ///   throws : Error unless width, height and the number of sets are positive.
  Film(int width, int height, int sets, FilmOptions options = {});

  /// Width [pixels].
  int width() const { return width_; }
  /// Height [pixels].
  int height() const { return height_; }
  /// Number of point sets of each pixel.
  int sets() const { return sets_; }
  /// Whether the film contains the pixel (x, y).
  bool contains(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < height_; }

  /// Adds the sum of `count` samples to a point set of a pixel. The count of splats need not be whole: samples of a
  /// pixel that takes more or fewer than others are weighted, so that they count as often as those of others.
  void add(int x, int y, int set, const Eigen::Array3d& sum, double count);

  /// Adds splats to a point set of a pixel, from samples of this pixel or another. `sum` contains the sums of weighted
  /// radiance and of weights. The weights average 1 over the samples of the pixel.
  void add_splat(int x, int y, int set, const Eigen::Array4d& sum);

  /// Adds a light path contribution to a point set of a pixel. Its mean is over the count of add_light_path_count(),
  /// not over the samples of the pixel.
  void add_light_splat(int x, int y, int set, const Eigen::Array3d& value);
  /// Adds light path contributions outside the film. If none is inside, these tell how bright one would be.
  void add_unseen_light(const UnseenLight& light) { unseen_light_.merge(light); }
  /// Adds light paths to the count of a point set. The unit is `samples` samples of every pixel, at the light path
  /// rate.
  void add_light_path_count(int set, double samples) { light_counts_[static_cast<std::size_t>(set)] += samples; }
  /// Adds to the number of rays of light paths.
  void add_light_rays(std::uint64_t rays) { light_rays_ += rays; }

  /// Sets the noise area of samples that share paths; see FilmOptions.
  void set_noise_area(double pixels) { options_.noise_area = pixels; }

  /// Adds the samples of a block of a film with the same size and sets.
  ///   window : takes the splats and their counts, if it is there. It is a film of the same width and sets, with fewer
  ///            rows, which take turns: row y of the block is row y modulo its height.
  void add(const FilmBlock& block, Film* window = nullptr);
  /// Adds the splats of row y in a window, and their counts, and clears them there.
  void take_row(Film& window, int y);
  /// Size of the sums, and of their archive but for a few numbers [bytes].
  std::size_t bytes() const;
  /// The sums, see mc/run/archive.h. A film is read into one with the same size, sets and options.
  template <class Archive> void archive(Archive& a) {
    using mc::fixed_size;
    a(fixed_size(sums_), fixed_size(counts_), fixed_size(weights_), fixed_size(samples_), fixed_size(rays_),
      fixed_size(light_), fixed_size(light_sums_), fixed_size(light_counts_), unseen_light_, light_rays_);
  }

  /// Adds the statistics of a pixel's samples and the number of rays that they took. With splats the pixel may lie
  /// within the filter's reach outside the film.
  void record_samples(int x, int y, const SampleSums& samples, std::uint64_t rays);

  /// Estimates a pixel.
  ///   mean     : m, the mean of all n samples.
  ///   variance : sum_s n_s (m_s - m)^2 / ((k - 1) n) over the k point sets, with n_s samples of mean m_s.
  /// At least k f J^2 / n^2 with f = (k + 1) / ((k + 2) (k + 3)). Sets of low-discrepancy points may agree by chance at
  /// an edge, because each set counts a whole number of samples beyond it. One sample more or less moves the sum of a
  /// set by the jump J of the samples. Let t be the fraction that rounding hides, uniform a priori. All k sets agree
  /// with probability t^k + (1 - t)^k, and f is the posterior mean of t (1 - t).
  ///   independent samples : the variance of the samples replaces the variance of the sets, except for splats.
  ///   splats   : the weights vary about 1, so a constant radiance would have noise. Therefore n_s m_s is the sum of
  ///              the set minus c (w_s - n_s). w_s is the sum of the set's weights and c the weighted mean of the other
  ///              sets. c does not depend on w_s, so the mean is unbiased. J^2 is the sum over the pixels nearby, times
  ///              the mean squared weights of their samples. n_s is the count of add().
  ///   light paths : their mean and their variance, found in the same way, are added.
  PixelEstimate estimate(int x, int y) const;
  /// Number of rays of the pixel's own samples.
  std::uint64_t rays(int x, int y) const { return rays_[index(x, y)]; }
  /// Number of rays of light paths per sample of every pixel; 0 without light paths.
  double light_rays() const;

  /// Means of all pixels, with their variances if every pixel has at least two point sets.
  Image image() const;

  /// Mean relative standard errors: the root of the mean of variance / radiance^2 over pixels and channels. The
  /// radiance is the mean over the 3x3 neighbourhood, so that a rare bright sample weighs little in it. It is at
  /// least half of the image's mean. Infinite while the variance is unknown in some pixel.
  ///   few light paths : the errors are infinite if more than half of the image's radiance are light path contributions
  ///                     that each dominate their pixel: other pixels have none by chance. If no contribution reaches
  ///                     the film, three of average size count as an error of all pixels, and as infinite if they
  ///                     exceed half of the image's radiance. Rule of three: with 95 % confidence fewer are expected.
  RelativeErrors relative_errors() const { return relative_errors(image()); }
  /// As relative_errors(), for a caller that already has the result of image().
  RelativeErrors relative_errors(const Image& image) const;

  /// Share of pixels with an effective sample count below 2. Light path contributions count like samples.
  double outlier_dominated() const;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  // J^2 of estimate(). With splats: the sum over the pixels nearby, each times the square of the weight of its samples,
  // of which the pixel's sums contain `count`.
  Eigen::Array3d squared_jump(int x, int y, double count) const;

  // Variance of a pixel if all samples were independent, without light paths.
  Eigen::Array3d variance_of_independent(int x, int y) const;

  // Contribution of a pixel's brightest sample to the sum of the variances of all pixels.
  Eigen::Array3d variance_of_brightest(int x, int y) const;

  // Sum of a point set of a pixel. The pixel's sets start at `first`.
  Eigen::Array3d set_sum(std::size_t first, std::size_t set) const;

  // Of samples that share paths and are splatted.
  double noise_area() const { return options_.noise_area * (options_.splat ? options_.splat->noise_area() : 1); }

  // Index into samples_, which include the pixels within reach outside the film.
  std::size_t sample_index(int x, int y) const {
    const int reach = options_.splat ? options_.splat->reach() : 0;
    return static_cast<std::size_t>(y + reach) * static_cast<std::size_t>(width_ + 2 * reach) +
           static_cast<std::size_t>(x + reach);
  }

  // Effective sample count of a pixel within reach.
  double effective_sample_count(int x, int y) const;

  // Errors of an image that account for few light paths, see relative_errors().
  RelativeErrors with_few_light_paths(RelativeErrors errors, const Image& image) const;
  // Whether some camera path goes on from a surface: light paths reach no others.
  bool sees_surfaces() const;

  // Number of samples of every pixel that the light paths correspond to.
  double light_count() const { return std::accumulate(light_counts_.begin(), light_counts_.end(), 0.0); }

  int width_, height_, sets_;
  FilmOptions options_;
  std::vector<Eigen::Array3d> sums_;      ///< Radiance sums: sets_ entries for each pixel.
  std::vector<float> counts_;             ///< Sample counts, in the same order.
  std::vector<double> weights_;           ///< Sums of splat weights, in the same order; empty without splats.
  std::vector<SampleStatistics> samples_; ///< By sample_index().
  std::vector<std::uint64_t> rays_;
  std::vector<Eigen::Array3d> light_; ///< Light path sums, in the order of sums_; empty without light paths.
  std::vector<LightSums> light_sums_; ///< One entry for each pixel.
  std::vector<double> light_counts_;  ///< One entry for each set.
  UnseenLight unseen_light_;
  std::uint64_t light_rays_ = 0;
};

} // namespace render
