#include <render/scene/resolution.h>

#include <algorithm>
#include <cmath>

namespace render {

namespace {

FloatResolution resolution_of(const Eigen::AlignedBox3d& box) {
  FloatResolution c;
  c.size = box.diagonal().norm();
  c.distance = std::max(box.min().lpNorm<Eigen::Infinity>(), box.max().lpNorm<Eigen::Infinity>());
  const Float there = Float(c.distance);
  c.step = double(std::nextafter(there, mc::infinity<Float>)) - double(there);
  c.ratio = c.size > 0 ? c.step / c.size : mc::infinity<double>;
  return c;
}

} // namespace

FloatResolution coarsest_resolution(const Scene& scene) {
  FloatResolution worst;
  for (const Surface& s : scene.surfaces()) {
    const FloatResolution own = resolution_of(s.shape->box());
    if (own.ratio > worst.ratio) worst = own;
  }
  return worst;
}

std::optional<double> length_out_of_range(const Scene& scene) {
  Eigen::AlignedBox3d all;
  for (const Surface& s : scene.surfaces()) {
    const Eigen::AlignedBox3d box = s.shape->box();
    if (const double size = box.diagonal().norm(); s.light && size < min_length) return size;
    all.extend(box);
  }
  const double size = all.isEmpty() ? 0 : all.diagonal().norm();
  if (size <= max_length) return {};
  return size;
}

} // namespace render
