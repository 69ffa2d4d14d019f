#include <render/film/splat_accumulator.h>

namespace render {

SplatAccumulator::SplatAccumulator(const SplatFilter& filter)
    : filter_(filter), columns_(filter.side()), rows_(filter.side()),
      sums_(filter.side() * filter.side(), Eigen::Array4d::Zero()) {}

void SplatAccumulator::add(const Vec2& offset, const Spectrum& radiance) {
  filter_.profile(double(offset[0]), columns_);
  filter_.profile(double(offset[1]), rows_);
  Eigen::Array4d sample = Eigen::Array4d::Ones();
  sample.head<3>() = radiance.cast<double>();
  auto sum = sums_.begin();
  for (const double row : rows_) {
    const Eigen::Array4d weighed = row * sample;
    for (const double column : columns_) *sum++ += column * weighed;
  }
}

void SplatAccumulator::flush_to(FilmBlock& block, int x, int y, int set) {
  auto sum = sums_.begin();
  const int reach = filter_.reach();
  for (int j = y - reach; j <= y + reach; ++j)
    for (int i = x - reach; i <= x + reach; ++i) {
      if (block.contains(i, j)) block.add_splat(i, j, set, *sum);
      *sum++ = Eigen::Array4d::Zero();
    }
}

} // namespace render
