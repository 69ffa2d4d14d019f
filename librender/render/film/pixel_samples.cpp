#include <render/film/pixel_samples.h>

#include <utility>

namespace render {

PixelSamples::PixelSamples(const std::optional<SplatFilter>& splat) : filter_(splat ? &*splat : nullptr) {
  if (!filter_) return;
  columns_.resize(filter_->side());
  rows_.resize(filter_->side());
  splats_.resize(filter_->side() * filter_->side(), Eigen::Array4d::Zero());
}

void PixelSamples::splat(const Vec2& offset, const Eigen::Array3d& value) {
  filter_->profile(double(offset[0]), columns_);
  filter_->profile(double(offset[1]), rows_);
  Eigen::Array4d sample = Eigen::Array4d::Ones();
  sample.head<3>() = value;
  auto splat = splats_.begin();
  for (const double row : rows_) {
    const Eigen::Array4d weighed = row * sample;
    for (const double column : columns_) *splat++ += column * weighed;
  }
}

void PixelSamples::end_set(FilmBlock& block, int x, int y, int set, std::optional<double> weight) {
  const std::uint32_t taken = valid_ + left_out_;
  const double scale = filter_ && weight && taken > 0 ? *weight / taken : 1;
  if (filter_) {
    auto splat = splats_.begin();
    const int reach = filter_->reach();
    for (int j = y - reach; j <= y + reach; ++j)
      for (int i = x - reach; i <= x + reach; ++i) {
        if (block.contains(i, j)) block.add_splat(i, j, set, *splat * scale);
        *splat++ = Eigen::Array4d::Zero();
      }
  }
  if (block.contains(x, y)) block.add(x, y, set, sum_, valid_ * scale);
  sum_.setZero();
  valid_ = left_out_ = 0;
}

void PixelSamples::end_pixel(FilmBlock& block, int x, int y, std::uint64_t rays) {
  block.record_samples(x, y, std::exchange(all_, {}), rays);
}

} // namespace render
