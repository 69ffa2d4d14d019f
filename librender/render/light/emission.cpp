#include <render/light/emission.h>

#include <mc/core/frame.h>
#include <mc/warp/disk.h>

namespace render {

std::optional<EmissionSample> EmissionTargets::sample_parallel(const Vec3& wi, const Spectrum& radiance,
                                                               double vertex_pdf, const Vec2& u) const {
  if (balls_.empty() || is_black(radiance)) return {};
  const auto choice = mc::UniformDiscrete<Float>(balls_.size()).sample_index(u[0]);
  const Sphere& ball = balls_[choice.index];
  const Vec2 disk = mc::UniformDisk<Float>{}.sample({choice.u_remapped, u[1]});
  const Vec3d across = mc::Frame<Float>::from_z(wi).to_world({disk[0], disk[1], 0}).cast<double>();
  const Vec3d crossing = ball.center() + ball.radius() * across, d = wi.cast<double>();
  // The origin lies beyond everything that may shadow the ball, but no farther: floats at a large distance, as beside a
  // huge ground plane, resolve a small ball poorly.
  const Vec3 p = (crossing + (scene_.exit_distance(crossing, d) + ball.radius()) * d).cast<Float>();
  const double pdf = parallel_pdf(p, wi);
  if (!(pdf > 0)) return {}; // rounding
  return EmissionSample{{p, -wi}, {}, radiance, vertex_pdf, pdf};
}

double EmissionTargets::parallel_pdf(const Vec3& p, const Vec3& wi) const {
  double density = 0;
  for (const Sphere& ball : balls_) {
    const Vec3d way = ball.center() - p.cast<double>();
    const double r2 = mc::sqr(ball.radius()), off2 = mc::cross<double>(way, wi.cast<double>()).squaredNorm();
    if (off2 <= r2) density += 1 / (mc::pi<double> * r2 * double(balls_.size()));
  }
  return density;
}

} // namespace render
