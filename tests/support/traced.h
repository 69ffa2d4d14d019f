#pragma once
// Radiance along a ray, for tests with a closed-form answer.

#include <render/pixel_renderer.h>

#include <mc/estimate/moments.h>

#include <gtest/gtest.h>

namespace support {

/// Moments of the radiance of n independent paths in one channel. No path may give an invalid value.
template <class Scene>
mc::Moments traced(const Scene& scene, const render::Ray& ray, const render::PathOptions& options, int n,
                   int channel = 0) {
  const render::PathIntegrator<Scene> integrator(scene, options);
  const mc::IndependentPairs numbers(2026, 0);
  mc::Moments moments;
  std::uint64_t rays = 0;
  for (int i = 0; i < n; ++i) {
    mc::IndependentPathStream<render::Float> stream(numbers, std::uint32_t(i));
    moments.add(double(integrator.radiance(ray, stream, rays)[channel]), std::uint64_t(i));
  }
  EXPECT_EQ(moments.non_finite_count(), 0u);
  return moments;
}

} // namespace support
