#include "measure.h"

#include <render/pixel_sampler.h>

#include <mc/random/hash.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/t_test.h>

#include <cmath>

namespace render::truth {

namespace {

template <class Stream>
Measured measure_with(const Picture& picture, const Strategy& strategy, std::uint64_t seed, std::uint32_t sets,
                      std::uint32_t points) {
  const PathIntegrator<Scene> integrator(*picture.scene, {strategy, picture.max_depth});
  Measured found;
  SampleSums samples;
  std::uint64_t rays = 0;
  for (std::uint32_t set = 0; set < sets; ++set) {
    const typename Stream::Points numbers(mc::hash(seed, set), points);
    double sum = 0;
    for (std::uint32_t i = 0; i < points; ++i) {
      Stream stream(numbers, i);
      const auto radiance = double(integrator.radiance(picture.ray, stream, rays)[0]);
      samples.add(Eigen::Array3d::Constant(radiance));
      sum += radiance;
    }
    found.means.add(sum / points, set);
  }
  found.undecided = samples.deciding() < 2;
  return found;
}

} // namespace

Measured measure(const Picture& picture, const Strategy& strategy, PixelSampler sampler, std::uint64_t seed,
                 std::uint32_t sets, std::uint32_t points) {
  switch (sampler) {
  case PixelSampler::independent:
    return measure_with<mc::IndependentWalk<Float>>(picture, strategy, seed, sets, points);
  case PixelSampler::stratified: return measure_with<mc::StratifiedWalk<Float>>(picture, strategy, seed, sets, points);
  case PixelSampler::sobol: return measure_with<mc::SobolWalk<Float>>(picture, strategy, seed, sets, points);
  }
  return {};
}

double z_score(const Measured& measured, double should, double its_error, double its_dof, double rounding) {
  const mc::Moments& m = measured.means;
  if (measured.undecided || m.mean() == 0) return 0;
  const double off = m.mean() - should, own = mc::sqr(m.std_error()),
               other = mc::sqr(its_error) + mc::sqr(rounding / 3);
  const double dof = mc::welch_dof(own, double(m.count() - 1), other, its_dof);
  const double p = mc::student_tail(off / std::sqrt(own + other), dof);
  return std::copysign(p > 1e-300 ? mc::normal_quantile(p) : 38.0, off);
}

} // namespace render::truth
