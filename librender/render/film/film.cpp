#include <render/film/film.h>
#include <render/film/film_block.h>

#include <mc/core/error.h>
#include <mc/estimate/diagnostics/tail.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/t_test.h>

#include <cmath>
#include <numeric>
#include <utility>

namespace render {

namespace {

/// Mean and variance over all sets; see Film::estimate.
struct MeanOfSets {
  Eigen::Array3d mean = Eigen::Array3d::Zero(), variance = Eigen::Array3d::Zero();
};

// sum(i): sum of the samples of set i. count(i): number of its samples.
template <class Sum, class Count>
MeanOfSets mean_of(std::size_t sets, const Sum& sum, const Count& count, const Eigen::Array3d& squared_jump) {
  MeanOfSets all;
  double n = 0, k = 0;
  for (std::size_t i = 0; i < sets; ++i) {
    all.mean += sum(i);
    n += count(i);
    k += count(i) > 0;
  }
  if (!(n > 0)) return all;
  all.mean /= n;
  if (k < 2) return all;
  for (std::size_t i = 0; i < sets; ++i)
    if (count(i) > 0) all.variance += count(i) * (sum(i) / count(i) - all.mean).square();
  const double left_over = (k + 1) / ((k + 2) * (k + 3));
  const Eigen::Array3d least = k * left_over * squared_jump / (n * n);
  all.variance = (all.variance / ((k - 1) * n)).max(least);
  return all;
}

constexpr double bound_confidence = 0.95;

// Upper bound of the sum of variances.
double bound_of(const mc::VarianceSum& sum) {
  const double dof = sum.dof();
  return std::isfinite(dof) ? sum.value * dof / mc::chi_square_quantile(bound_confidence, dof) : sum.value;
}

// Upper bound of what unsampled values beyond the largest add to the sum.
double bound_beyond(const mc::Extremes& values) {
  return mc::tail_extension(1 - bound_confidence) * mc::excess_beyond(mc::find_tail(values, mc::TailSide::largest));
}

/// Sum over the pixels of a part of an image of the variance relative to squared radiance.
struct PartVariance {
  mc::VarianceSum all, independent; ///< From the point sets, and from samples taken as independent.
  mc::Extremes brightest;           ///< Contributions of the brightest sample of each pixel that has a variance.
  int pixels = 0;

  /// Error of the part, in which samples of `sharing` pixels share paths.
  RelativeError error(double sharing) const {
    if (all.value == 0) return {0, 0};
    double most = bound_of(all);
    if (std::isfinite(independent.value)) most = std::clamp(bound_of(independent), all.value, most);
    most += sharing * bound_beyond(brightest);
    return {std::sqrt(all.value / pixels), std::sqrt(most / pixels)};
  }
};

// Mean of the 3x3 neighbourhood, or of its other pixels where there are any.
Eigen::Array3d around(const Image& image, int x, int y, bool others = false) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  int n = 0;
  for (int j = std::max(y - 1, 0); j < std::min(y + 2, image.height); ++j)
    for (int i = std::max(x - 1, 0); i < std::min(x + 2, image.width); ++i) {
      if (others && i == x && j == y) continue;
      sum += image.at(i, j).cast<double>();
      ++n;
    }
  return n > 0 ? Eigen::Array3d(sum / n) : image.at(x, y).cast<double>();
}

} // namespace

Film::Film(int width, int height, int sets, FilmOptions options)
    : width_(width), height_(height), sets_(sets), options_(std::move(options)) {
  mc::require(width > 0 && height > 0, "film: size {}x{} needs at least one pixel", width, height);
  mc::require(sets > 0, "film: {} point sets; at least 1 is needed", sets);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  sums_.resize(pixels * static_cast<std::size_t>(sets), Eigen::Array3d::Zero());
  counts_.resize(sums_.size());
  if (options_.splat) weights_.resize(sums_.size());
  const int reach = options_.splat ? options_.splat->reach() : 0;
  samples_.resize(sample_index(width + reach - 1, height + reach - 1) + 1);
  rays_.resize(pixels);
  if (!options_.has_light_paths) return;
  light_.resize(sums_.size(), Eigen::Array3d::Zero());
  light_sums_.resize(pixels);
  light_counts_.resize(static_cast<std::size_t>(sets));
}

std::size_t Film::bytes() const {
  const auto size = [](const auto&... sums) { return (... + (sums.size() * sizeof(sums[0]))); };
  return size(sums_, counts_, weights_, samples_, rays_, light_, light_sums_, light_counts_);
}

void Film::add(int x, int y, int set, const Eigen::Array3d& sum, double count) {
  const std::size_t i = index(x, y) * static_cast<std::size_t>(sets_) + static_cast<std::size_t>(set);
  sums_[i] += sum;
  counts_[i] += static_cast<float>(count);
}

void Film::add_splat(int x, int y, int set, const Eigen::Array4d& sum) {
  const std::size_t i = index(x, y) * static_cast<std::size_t>(sets_) + static_cast<std::size_t>(set);
  sums_[i] += sum.head<3>();
  weights_[i] += sum[3];
}

void Film::add_light_splat(int x, int y, int set, const Eigen::Array3d& value) {
  const std::size_t i = index(x, y);
  light_[i * static_cast<std::size_t>(sets_) + static_cast<std::size_t>(set)] += value;
  light_sums_[i].add(value);
}

void Film::add(const FilmBlock& block, Film* window) {
  Film& splats = window ? *window : *this;
  const auto row = [&](int y) { return window ? y % window->height_ : y; };
  for (const auto& [x, y, set, count, sum] : block.sums_) splats.add(x, row(y), set, sum, count);
  for (const auto& [x, y, set, sum] : block.splats_) splats.add_splat(x, row(y), set, sum);
  for (const auto& [x, y, set, value] : block.light_splats_) add_light_splat(x, y, set, value.cast<double>());
  for (const auto& [x, y, samples, rays] : block.records_) record_samples(x, y, samples, rays);
  add_unseen_light(block.unseen_light_);
  add_light_rays(block.light_rays_);
}

void Film::take_row(Film& window, int y) {
  const auto sets = static_cast<std::size_t>(sets_), count = static_cast<std::size_t>(width_) * sets;
  const std::size_t to = index(0, y) * sets, from = index(0, y % window.height_) * sets;
  for (std::size_t i = 0; i < count; ++i) {
    sums_[to + i] += std::exchange(window.sums_[from + i], Eigen::Array3d::Zero());
    counts_[to + i] += std::exchange(window.counts_[from + i], 0.0f);
    weights_[to + i] += std::exchange(window.weights_[from + i], 0.0);
  }
}

void Film::record_samples(int x, int y, const SampleSums& samples, std::uint64_t rays) {
  samples_[sample_index(x, y)].add(samples);
  if (contains(x, y)) rays_[index(x, y)] += rays;
}

double Film::light_rays() const {
  const double count = light_count();
  return count > 0 ? double(light_rays_) / count : 0;
}

Eigen::Array3d Film::set_sum(std::size_t first, std::size_t set) const {
  if (weights_.empty()) return sums_[set];
  Eigen::Array3d others = Eigen::Array3d::Zero();
  double weight = 0;
  for (std::size_t i = first; i < first + static_cast<std::size_t>(sets_); ++i)
    if (i != set) {
      others += sums_[i];
      weight += weights_[i];
    }
  return weight > 0 ? sums_[set] - (weights_[set] - double(counts_[set])) * (others / weight) : sums_[set];
}

Eigen::Array3d Film::squared_jump(int x, int y, double count) const {
  if (!options_.splat) return samples_[sample_index(x, y)].jump().square();
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  const int reach = options_.splat->reach();
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      const SampleStatistics& samples = samples_[sample_index(x + dx, y + dy)];
      if (samples.count < 2) continue;
      sum += options_.splat->squared_weight(dx, dy) * (samples.jump() * (count / double(samples.count))).square();
    }
  return sum;
}

Eigen::Array3d Film::variance_of_independent(int x, int y) const {
  if (!options_.splat) return samples_[sample_index(x, y)].variance_of_mean();
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  const int reach = options_.splat->reach();
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      sum += options_.splat->squared_weight(dx, dy) * samples_[sample_index(x + dx, y + dy)].variance_of_mean();
  return sum;
}

Eigen::Array3d Film::variance_of_brightest(int x, int y) const {
  const SampleStatistics& samples = samples_[sample_index(x, y)];
  const Eigen::Array3d off = (samples.channel_largest - samples.channel_means).cast<double>();
  const Eigen::Array3d own =
      (off / std::max(double(samples.count), 1.0)).square() / (options_.splat ? options_.splat->noise_area() : 1);
  if (light_.empty()) return own;
  return own.max((light_sums_[index(x, y)].channel_largest.cast<double>() / light_count()).square());
}

PixelEstimate Film::estimate(int x, int y) const {
  const auto sets = static_cast<std::size_t>(sets_), first = index(x, y) * sets;
  PixelEstimate pixel;
  double count = 0;
  for (std::size_t i = first; i < first + sets; ++i) {
    count += double(counts_[i]);
    pixel.sets += counts_[i] > 0;
  }
  pixel.samples = static_cast<std::uint64_t>(std::llround(count));
  if (count == 0) return pixel;
  const auto own = mean_of(
      sets, [&](std::size_t i) { return set_sum(first, first + i); },
      [&](std::size_t i) { return double(counts_[first + i]); }, squared_jump(x, y, count));
  pixel.mean = own.mean;
  const SampleStatistics& samples = samples_[sample_index(x, y)];
  const bool by_samples = options_.independent_samples && !options_.splat && pixel.sets > 1;
  pixel.variance = by_samples ? samples.variance_of_mean() : own.variance;
  if (light_.empty()) return pixel;
  const auto light = mean_of(
      sets, [&](std::size_t i) { return light_[first + i]; }, [&](std::size_t i) { return light_counts_[i]; },
      light_sums_[index(x, y)].channel_largest.cast<double>().square());
  pixel.mean += light.mean;
  pixel.variance += light.variance;
  pixel.light_variance = light.variance;
  return pixel;
}

Image Film::image() const {
  Image image(width_, height_);
  image.noise_area = noise_area();
  image.variance.resize(image.pixels.size());
  bool known = true;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const PixelEstimate pixel = estimate(x, y);
      image.at(x, y) = pixel.mean.cast<Float>();
      image.variance[image.index(x, y)] = pixel.variance.cast<Float>();
      known = known && pixel.sets >= 2;
    }
  if (!known) image.variance.clear();
  return image;
}

RelativeErrors Film::relative_errors(const Image& image) const {
  if (image.variance.empty()) return {};
  double mean = 0;
  for (const Spectrum& pixel : image.pixels) mean += pixel.cast<double>().sum() / (3.0 * double(image.pixels.size()));
  PartVariance picture;
  RelativeErrors errors{{}, {0, 0}};
  for (int top = 0; top < height_; top += 16)
    for (int left = 0; left < width_; left += 16) {
      PartVariance block;
      std::vector<double> brightest;
      for (int y = top; y < std::min(top + 16, height_); ++y)
        for (int x = left; x < std::min(left + 16, width_); ++x) {
          for (PartVariance* part : {&picture, &block}) ++part->pixels;
          const PixelEstimate pixel = estimate(x, y);
          if (!(pixel.variance > 0).any()) continue;
          const Eigen::Array3d unit = around(image, x, y).max(mean / 2).square();
          const Eigen::Array3d others = around(image, x, y, true).max(mean / 2).square();
          brightest.push_back((variance_of_brightest(x, y) / others).mean()); // not relative to itself
          const double relative = (pixel.variance / unit).mean(), light_variance = (pixel.light_variance / unit).mean();
          const double of_samples = (variance_of_independent(x, y) / unit).mean(),
                       dof = samples_[sample_index(x, y)].effective_sample_count();
          for (PartVariance* part : {&picture, &block}) {
            part->all.add(relative, pixel.sets - 1, noise_area());
            part->independent.add(of_samples, dof, noise_area());
            part->independent.add(light_variance, pixel.sets - 1, noise_area());
          }
        }
      for (PartVariance* part : {&picture, &block}) part->brightest.add(brightest);
      const RelativeError error = block.error(options_.noise_area);
      errors.worst_block = {std::max(errors.worst_block.value, error.value),
                            std::max(errors.worst_block.bound, error.bound)};
    }
  errors.image = picture.error(options_.noise_area);
  return with_few_light_paths(errors, image);
}

RelativeErrors Film::with_few_light_paths(RelativeErrors errors, const Image& image) const {
  const double count = light_count();
  if (!(count > 0)) return errors;
  double all = 0, light = 0, dominated = 0; // sums of radiance over the pixels
  for (std::size_t i = 0; i < light_sums_.size(); ++i) {
    all += double(luminance(image.pixels[i]));
    double own = 0;
    for (std::size_t set = 0; set < static_cast<std::size_t>(sets_); ++set)
      own += luminance(light_[i * static_cast<std::size_t>(sets_) + set]) / count;
    light += own;
    if (light_sums_[i].squares < 2 * mc::sqr(double(light_sums_[i].largest))) dominated += own;
  }
  if (!(all > 0)) return errors;
  const bool may_miss_light = light == 0 && unseen_light_.count > 0 && sees_surfaces();
  const double missing = may_miss_light ? 3 * unseen_light_.sum / double(unseen_light_.count) / count : 0;
  if (std::max(dominated, missing) > all / 2) return {};
  for (RelativeError* error : {&errors.image, &errors.worst_block})
    *error = {std::max(error->value, missing / all), std::max(error->bound, missing / all)};
  return errors;
}

bool Film::sees_surfaces() const {
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      if (rays(x, y) > samples_[sample_index(x, y)].count) return true;
  return false;
}

double Film::effective_sample_count(int x, int y) const {
  const SampleStatistics& samples = samples_[sample_index(x, y)];
  const double light = light_count();
  if (!(light > 0 && contains(x, y))) return samples.effective_sample_count();
  return samples.effective_sample_count(light_sums_[index(x, y)], double(samples.count) / light);
}

double Film::outlier_dominated() const {
  const int reach = options_.splat ? options_.splat->reach() : 0;
  std::size_t n = 0;
  for (int y = -reach; y < height_ + reach; ++y)
    for (int x = -reach; x < width_ + reach; ++x) n += effective_sample_count(x, y) < 2;
  return double(n) / double(samples_.size());
}

} // namespace render
