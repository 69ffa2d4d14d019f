#pragma once
// Radiance along a ray, for tests with a closed-form answer.

#include <render/pixel_renderer.h>

#include <mc/estimate/moments.h>

#include <gtest/gtest.h>

namespace support {

/// Moments of n independent samples of an integrator in one channel. No sample may be invalid.
///   media : media at the origin of the ray.
template <class Integrator>
mc::Moments samples_of(const Integrator& integrator, const render::Ray& ray, int n, int channel,
                       const render::MediumStack& media = {}) {
  const mc::IndependentPairs numbers(2026, 0);
  mc::Moments moments;
  std::uint64_t rays = 0;
  for (int i = 0; i < n; ++i) {
    mc::IndependentPathStream<render::Float> stream(numbers, std::uint32_t(i));
    moments.add(double(integrator.Li(ray, stream, rays, media)[channel]), std::uint64_t(i));
  }
  EXPECT_EQ(moments.non_finite_count(), 0u);
  return moments;
}

/// Moments of the radiance.
template <class Scene>
mc::Moments traced(const Scene& scene, const render::Ray& ray, const render::PathOptions& options, int n,
                   int channel = 0) {
  return samples_of(render::PathIntegrator<Scene>(scene, options), ray, n, channel);
}

/// Moments of another quantity.
template <class Scene>
mc::Moments aov_samples(const Scene& scene, const render::Ray& ray, const render::Aov& aov, int n, int channel = 0) {
  return samples_of(render::AovIntegrator<Scene>(scene, aov), ray, n, channel);
}

} // namespace support
