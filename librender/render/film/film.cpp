#include <render/film/film.h>

#include <mc/core/error.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/t_test.h>

#include <cmath>

namespace render {

namespace {

// Deviations of equal samples, in parts of their squares.
constexpr double rounding = 1e-12;

} // namespace

void SampleSums::merge(const SampleSums& other) {
  count += other.count;
  sum += other.sum;
  squares += other.squares;
  largest = std::max(largest, other.largest);
  channel_sums += other.channel_sums;
  channel_squares += other.channel_squares;
  channel_largest = channel_largest.max(other.channel_largest);
}

bool SampleSums::is_undecided() const {
  if (count < 2) return false;
  const double mean = sum / double(count), deviations = squares - mean * sum;
  return deviations > rounding * squares && mc::sqr(largest - mean) > deviations / 2;
}

Eigen::Array3d SampleSums::range() const {
  if (count < 2) return Eigen::Array3d::Zero();
  const Eigen::Array3d mean = channel_sums / double(count), squares_mean = channel_squares / double(count);
  const Eigen::Array3d s2 = squares_mean - mean.square();
  const Eigen::Array3d d = channel_largest - mean;
  return (s2 > rounding * squares_mean && d > 0).select(d + s2 / d, 0);
}

Film::Film(int width, int height, int sets, std::optional<SplatFilter> splat)
    : width_(width), height_(height), sets_(sets), splat_(std::move(splat)) {
  mc::require(width > 0 && height > 0, "film: size {}x{} needs at least one pixel", width, height);
  mc::require(sets > 0, "film: {} point sets; at least 1 is needed", sets);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  sums_.resize(pixels * static_cast<std::size_t>(sets), Eigen::Array3d::Zero());
  counts_.resize(sums_.size());
  if (splat_) weights_.resize(sums_.size());
  const int reach = splat_ ? splat_->reach() : 0;
  samples_.resize(place(width + reach - 1, height + reach - 1) + 1);
  rays_.resize(pixels);
}

void Film::add(int x, int y, int set, const Eigen::Array3d& sum, std::uint32_t count) {
  const std::size_t i = index(x, y) * static_cast<std::size_t>(sets_) + static_cast<std::size_t>(set);
  sums_[i] += sum;
  counts_[i] += count;
}

void Film::splat(int x, int y, int set, const Eigen::Array4d& sum) {
  const std::size_t i = index(x, y) * static_cast<std::size_t>(sets_) + static_cast<std::size_t>(set);
  sums_[i] += sum.head<3>();
  weights_[i] += sum[3];
}

void Film::merge(const Film& other) {
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    sums_[i] += other.sums_[i];
    counts_[i] += other.counts_[i];
  }
  for (std::size_t i = 0; i < weights_.size(); ++i) weights_[i] += other.weights_[i];
  for (std::size_t i = 0; i < samples_.size(); ++i) samples_[i].merge(other.samples_[i]);
  for (std::size_t i = 0; i < rays_.size(); ++i) rays_[i] += other.rays_[i];
}

void Film::note(int x, int y, const SampleSums& samples, std::uint64_t rays) {
  samples_[place(x, y)].merge(samples);
  if (contains(x, y)) rays_[index(x, y)] += rays;
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
  return weight > 0 ? sums_[set] - (weights_[set] - counts_[set]) * (others / weight) : sums_[set];
}

Eigen::Array3d Film::square_range(int x, int y) const {
  if (!splat_) return samples_[place(x, y)].range().square();
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  const int reach = splat_->reach();
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      sum += splat_->square(dx, dy) * samples_[place(x + dx, y + dy)].range().square();
  return sum;
}

PixelEstimate Film::estimate(int x, int y) const {
  const auto sets = static_cast<std::size_t>(sets_), first = index(x, y) * sets;
  PixelEstimate pixel;
  for (std::size_t i = first; i < first + sets; ++i) {
    pixel.mean += set_sum(first, i);
    pixel.samples += counts_[i];
    pixel.sets += counts_[i] > 0;
  }
  if (pixel.samples == 0) return pixel;
  const auto n = double(pixel.samples);
  pixel.mean /= n;
  if (pixel.sets < 2) return pixel;
  for (std::size_t i = first; i < first + sets; ++i)
    if (counts_[i] > 0) pixel.variance += counts_[i] * (set_sum(first, i) / counts_[i] - pixel.mean).square();
  const double k = pixel.sets, left_over = (k + 1) / ((k + 2) * (k + 3));
  const Eigen::Array3d least = k * left_over * square_range(x, y) / (n * n);
  pixel.variance = (pixel.variance / ((k - 1) * n)).max(least);
  return pixel;
}

Image Film::image() const {
  Image image(width_, height_);
  if (splat_) image.noise_area = splat_->noise_area();
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

RelativeError Film::relative_error(ErrorOf of) const {
  std::vector<Eigen::Array3d> means;
  means.reserve(rays_.size());
  double mean = 0;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const PixelEstimate pixel = estimate(x, y);
      if (pixel.sets < 2) return {};
      means.push_back(pixel.mean);
      mean += pixel.mean.sum() / (3.0 * double(rays_.size()));
    }
  const int block = of == ErrorOf::worst ? 16 : std::max(width_, height_);
  RelativeError worst{0, 0};
  for (int top = 0; top < height_; top += block)
    for (int left = 0; left < width_; left += block) {
      const int bottom = std::min(top + block, height_), right = std::min(left + block, width_);
      double sum = 0, dof = 1; // of nothing
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) {
          const PixelEstimate pixel = estimate(x, y);
          if (!(pixel.variance > 0).any()) continue;
          const double variance = (pixel.variance / around(means, x, y).max(mean / 2).square()).mean();
          dof = mc::welch_dof(sum, dof, variance, pixel.sets - 1);
          sum += variance;
        }
      if (splat_) dof = std::max(sets_ - 1.0, dof / splat_->noise_area());
      const int pixels = (bottom - top) * (right - left);
      worst.value = std::max(worst.value, std::sqrt(sum / pixels));
      worst.bound = std::max(worst.bound, std::sqrt(sum / pixels * dof / mc::chi_square_quantile(0.95, dof)));
    }
  return worst;
}

Eigen::Array3d Film::around(const std::vector<Eigen::Array3d>& means, int x, int y) const {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  int n = 0;
  for (int j = std::max(y - 1, 0); j < std::min(y + 2, height_); ++j)
    for (int i = std::max(x - 1, 0); i < std::min(x + 2, width_); ++i) {
      sum += means[index(i, j)];
      ++n;
    }
  return sum / n;
}

double Film::undecided() const {
  const auto n = std::count_if(samples_.begin(), samples_.end(), [](const SampleSums& s) { return s.is_undecided(); });
  return double(n) / double(samples_.size());
}

} // namespace render
