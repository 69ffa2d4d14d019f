#include <render/film/film.h>

#include <mc/core/error.h>

#include <cmath>

namespace render {

void SampleSums::merge(const SampleSums& other) {
  count += other.count;
  sum += other.sum;
  squares += other.squares;
  largest = std::max(largest, other.largest);
}

bool SampleSums::is_undecided() const {
  if (count < 2) return false;
  const double mean = sum / double(count), deviations = squares - mean * sum;
  // Below: equal samples, whose deviations are rounding.
  return deviations > 1e-12 * squares && mc::sqr(largest - mean) > deviations / 2;
}

Film::Film(int width, int height) : width_(width), height_(height) {
  mc::require(width > 0 && height > 0, "film: size {}x{} needs at least one pixel", width, height);
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  samples_.resize(pixels_.size());
}

void Film::add(int x, int y, const Eigen::Array3d& estimate) {
  Pixel& pixel = pixels_[index(x, y)];
  for (std::size_t c = 0; c < 3; ++c) pixel[c].add(estimate[static_cast<int>(c)]);
}

Image Film::image() const {
  Image image(width_, height_);
  bool known = true;
  for (const Pixel& p : pixels_) known &= p[0].count() >= 2;
  if (known) image.variance.resize(pixels_.size());
  for (std::size_t i = 0; i < pixels_.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      image.pixels[i][static_cast<int>(c)] = Float(pixels_[i][c].mean());
      if (known) image.variance[i][static_cast<int>(c)] = Float(mc::sqr(pixels_[i][c].std_error()));
    }
  return image;
}

double Film::relative_error() const {
  double mean = 0, variance = 0;
  for (const Pixel& p : pixels_)
    for (const mc::Moments& m : p) {
      if (m.count() < 2) return mc::infinity<double>;
      mean += m.mean();
      variance += mc::sqr(m.std_error());
    }
  const double n = 3.0 * double(pixels_.size());
  return variance > 0 ? std::sqrt(variance / n) / (std::abs(mean) / n) : 0.0;
}

double Film::undecided() const {
  const auto n = std::count_if(samples_.begin(), samples_.end(), [](const SampleSums& s) { return s.is_undecided(); });
  return double(n) / double(samples_.size());
}

} // namespace render
