#include "measure.h"

#include <render/tile_renderer.h>

#include <mc/random/hash.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/t_test.h>
#include <mc/warp/disk.h>

#include <cmath>

namespace render::truth {

namespace {

// pixel(numbers, i, seed) : the radiance of a pixel for point i of a set with this seed
template <class Stream, class Pixel>
Measured of_sets(std::uint64_t seed, std::uint32_t sets, std::uint32_t points, const Pixel& pixel) {
  Measured found;
  SampleSums samples;
  for (std::uint32_t set = 0; set < sets; ++set) {
    const std::uint64_t own = mc::hash(seed, set);
    const typename Stream::Points numbers(own, points);
    double sum = 0;
    for (std::uint32_t i = 0; i < points; ++i) {
      const auto radiance = double(pixel(numbers, i, own));
      samples.add(Eigen::Array3d::Constant(radiance));
      sum += radiance;
    }
    found.means.add(sum / points, set);
  }
  SampleStatistics statistics;
  statistics.add(samples);
  found.outlier_dominated = statistics.effective_sample_count() < 2;
  return found;
}

template <class Stream>
Measured measure_with(const Picture& picture, const PathOptions& path, std::uint64_t seed, std::uint32_t sets,
                      std::uint32_t points) {
  const PathIntegrator<Scene> integrator(*picture.scene, path);
  std::uint64_t rays = 0;
  return of_sets<Stream>(seed, sets, points, [&](const auto& numbers, std::uint32_t i, std::uint64_t) {
    Stream stream(numbers, i);
    return integrator.Li(picture.ray, stream, rays)[0];
  });
}

// The ray of a pixel of the tile. Pixel 0 has the ray of the picture. The others deviate by up to 30 degrees, with a
// log-uniform distribution.
Ray beside(const Ray& ray, std::uint64_t seed, std::uint32_t pixel) {
  if (pixel == 0) return ray;
  mc::Pcg random(seed, pixel);
  const auto tan_most = Float(0.577 * std::pow(1e-3, random.uniform<double>()));
  const Vec2 disk = mc::UniformDisk<Float>{}.sample(random.point<Float, 2>()) * tan_most;
  return {ray.o, mc::Frame<Float>::from_z(ray.d).to_world(Vec3(disk[0], disk[1], 1).normalized())};
}

template <class Stream>
Measured tile_with(const Picture& picture, const PathOptions& path, std::uint64_t seed, std::uint32_t sets,
                   std::uint32_t points) {
  const PathReuseIntegrator<Scene> integrator(*picture.scene, path);
  std::uint64_t rays = 0;
  return of_sets<Stream>(seed, sets, points, [&](const auto& numbers, std::uint32_t i, std::uint64_t set) {
    const typename Stream::Points others[] = {
        {mc::hash(set, 1), points}, {mc::hash(set, 2), points}, {mc::hash(set, 3), points}};
    const auto ray = [&](std::uint32_t k) {
      return CameraRay<Stream>{beside(picture.ray, set, k), {}, Stream(k == 0 ? numbers : others[k - 1], i)};
    };
    std::array<CameraRay<Stream>, 4> tile{ray(0), ray(1), ray(2), ray(3)};
    return integrator.radiances(tile, rays)[0][0];
  });
}

} // namespace

Measured measure(const Picture& picture, const Strategy& strategy, PixelSampler sampler, std::uint64_t seed,
                 std::uint32_t sets, std::uint32_t points, bool in_tile) {
  const PathOptions path{strategy, picture.max_depth};
  return with_stream(sampler, [&]<class Stream>(std::type_identity<Stream>) {
    return in_tile ? tile_with<Stream>(picture, path, seed, sets, points)
                   : measure_with<Stream>(picture, path, seed, sets, points);
  });
}

double z_score(const Measured& measured, double should, double its_error, double its_dof, double rounding) {
  const mc::Moments& m = measured.means;
  if (measured.outlier_dominated || m.mean() == 0) return 0;
  const double off = m.mean() - should, own = mc::sqr(m.std_error()),
               other = mc::sqr(its_error) + mc::sqr(rounding / 3);
  const double dof = mc::welch_dof(own, double(m.count() - 1), other, its_dof);
  const double p = mc::student_tail(off / std::sqrt(own + other), dof);
  return std::copysign(p > 1e-300 ? mc::normal_quantile(p) : 38.0, off);
}

} // namespace render::truth
