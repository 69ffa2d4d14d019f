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
  channel_squares += other.channel_squares;
  channel_largest = channel_largest.max(other.channel_largest);
}

bool SampleSums::is_undecided() const {
  if (count < 2) return false;
  const double mean = sum / double(count), deviations = squares - mean * sum;
  return deviations > rounding * squares && mc::sqr(largest - mean) > deviations / 2;
}

Eigen::Array3d SampleSums::range(const Eigen::Array3d& mean) const {
  if (count < 2) return Eigen::Array3d::Zero();
  const Eigen::Array3d squares_mean = channel_squares / double(count), s2 = squares_mean - mean.square();
  const Eigen::Array3d d = channel_largest - mean;
  return (s2 > rounding * squares_mean && d > 0).select(d + s2 / d, 0);
}

Film::Film(int width, int height, int sets) : width_(width), height_(height), sets_(sets) {
  mc::require(width > 0 && height > 0, "film: size {}x{} needs at least one pixel", width, height);
  mc::require(sets > 0, "film: {} point sets; at least 1 is needed", sets);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  sums_.resize(pixels * static_cast<std::size_t>(sets), Eigen::Array3d::Zero());
  counts_.resize(sums_.size());
  samples_.resize(pixels);
  rays_.resize(pixels);
}

void Film::add(int x, int y, int set, const Eigen::Array3d& sum, std::uint32_t count) {
  const std::size_t i = index(x, y) * static_cast<std::size_t>(sets_) + static_cast<std::size_t>(set);
  sums_[i] += sum;
  counts_[i] += count;
}

void Film::note(int x, int y, const SampleSums& samples, std::uint64_t rays) {
  samples_[index(x, y)].merge(samples);
  rays_[index(x, y)] += rays;
}

PixelEstimate Film::estimate(int x, int y) const {
  const auto sets = static_cast<std::size_t>(sets_), first = index(x, y) * sets;
  PixelEstimate pixel;
  for (std::size_t i = first; i < first + sets; ++i) {
    pixel.mean += sums_[i];
    pixel.samples += counts_[i];
    pixel.sets += counts_[i] > 0;
  }
  if (pixel.samples == 0) return pixel;
  const auto n = double(pixel.samples);
  pixel.mean /= n;
  if (pixel.sets < 2) return pixel;
  for (std::size_t i = first; i < first + sets; ++i)
    if (counts_[i] > 0) pixel.variance += counts_[i] * (sums_[i] / counts_[i] - pixel.mean).square();
  const double k = pixel.sets, left_over = (k + 1) / ((k + 2) * (k + 3));
  const Eigen::Array3d least = k * left_over * (samples_[index(x, y)].range(pixel.mean) / n).square();
  pixel.variance = (pixel.variance / ((k - 1) * n)).max(least);
  return pixel;
}

Image Film::image() const {
  Image image(width_, height_);
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
  means.reserve(samples_.size());
  double mean = 0;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const PixelEstimate pixel = estimate(x, y);
      if (pixel.sets < 2) return {};
      means.push_back(pixel.mean);
      mean += pixel.mean.sum() / (3.0 * double(samples_.size()));
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
