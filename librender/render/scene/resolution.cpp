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

} // namespace render
