#include <render/scene/resolution.h>

#include <algorithm>
#include <cmath>

namespace render {

namespace {

Coarseness coarseness(const Eigen::AlignedBox3d& box) {
  Coarseness c;
  c.size = box.diagonal().norm();
  c.distance = std::max(box.min().lpNorm<Eigen::Infinity>(), box.max().lpNorm<Eigen::Infinity>());
  const Float there = Float(c.distance);
  c.step = double(std::nextafter(there, mc::infinity<Float>)) - double(there);
  c.ratio = c.size > 0 ? c.step / c.size : mc::infinity<double>;
  return c;
}

} // namespace

Coarseness coarsest(const Scene& scene) {
  Coarseness worst;
  for (const Surface& s : scene.surfaces()) {
    const Coarseness own = coarseness(s.shape->box());
    if (own.ratio > worst.ratio) worst = own;
  }
  return worst;
}

std::optional<double> length_out_of_range(const Scene& scene) {
  Eigen::AlignedBox3d all;
  for (const Surface& s : scene.surfaces()) {
    const Eigen::AlignedBox3d box = s.shape->box();
    if (const double size = box.diagonal().norm(); s.light && size < least_length) return size;
    all.extend(box);
  }
  const double size = all.isEmpty() ? 0 : all.diagonal().norm();
  if (size <= most_length) return {};
  return size;
}

} // namespace render
