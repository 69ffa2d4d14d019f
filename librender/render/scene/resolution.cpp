#include <render/scene/resolution.h>

#include <algorithm>
#include <cmath>

namespace render {

namespace {

Coarseness coarseness(const Vec3d& lo, const Vec3d& hi) {
  Coarseness c;
  c.size = (hi - lo).norm();
  c.distance = std::max(lo.lpNorm<Eigen::Infinity>(), hi.lpNorm<Eigen::Infinity>());
  const Float there = Float(c.distance);
  c.step = double(std::nextafter(there, mc::infinity<Float>)) - double(there);
  c.ratio = c.size > 0 ? c.step / c.size : mc::infinity<double>;
  return c;
}

Coarseness coarseness(const Sphere& s) {
  const Vec3d half = Vec3d::Constant(s.radius());
  return coarseness(s.center() - half, s.center() + half);
}

Coarseness coarseness(const TriangleMesh& mesh) {
  return coarseness(mesh.bounds().lo.cast<double>(), mesh.bounds().hi.cast<double>());
}

} // namespace

Coarseness coarsest(const Scene& scene) {
  Coarseness worst;
  for (const Surface& s : scene.surfaces()) {
    const Coarseness own = dispatch(*s.shape, [](const auto& shape) { return coarseness(shape); });
    if (own.ratio > worst.ratio) worst = own;
  }
  return worst;
}

} // namespace render
