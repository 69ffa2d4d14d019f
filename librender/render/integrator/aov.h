#pragma once
/// Quantities along camera rays that need no path tracing.

#include <render/film/image.h>
#include <render/integrator/shading_point.h>
#include <render/scene/visibility.h>

namespace render {

/// Estimates an Aov other than radiance along camera rays, with one sample each. The scene must outlive it.
template <class SceneType> class AovIntegrator {
 public:
  /// The estimator of a quantity.
  AovIntegrator(const SceneType& scene, const Aov& aov) : scene_(scene), aov_(aov) {}

  /// One estimate along `ray`. `rays` counts the rays traced. The media do not matter.
  template <class Stream> Spectrum Li(Ray ray, Stream& stream, std::uint64_t& rays, const MediumStack& = {}) const {
    return aov_.kind == Aov::normals ? normal(ray, stream, rays) : ambient_occlusion(ray, stream, rays);
  }

 private:
  // The shading normal n at the ray's hit as the colour (n + 1) / 2; the radiance of infinite lights if there is no
  // hit.
  template <class Stream> Spectrum normal(Ray& ray, Stream& stream, std::uint64_t& rays) const {
    if (const auto hit = sample_nearest_hit(scene_, ray, stream, rays))
      return (scene_.surface(*hit).shape->surface_point(ray, *hit).ns.array() + 1) / 2;
    Spectrum radiance = Spectrum::Zero();
    for (const std::uint32_t light : scene_.infinite_lights()) radiance += scene_.lights()[light].Le(ray.d, nullptr);
    return radiance;
  }

  // Visibility along one cosine-distributed direction at the ray's hit; 1 if there is no hit.
  template <class Stream> Spectrum ambient_occlusion(Ray& ray, Stream& stream, std::uint64_t& rays) const {
    const auto hit = sample_nearest_hit(scene_, ray, stream, rays);
    if (!hit) return Spectrum::Ones();
    const SurfacePoint point = scene_.surface(*hit).shape->surface_point(ray, *hit);
    const Lambert matte;
    const ShadingPoint at(matte, point, -ray.d);
    const auto s = at.sample(0, stream.next2());
    if (!s) return Spectrum::Zero();
    Ray shadow = point.spawn_ray(at.frame.to_world(s->wi));
    shadow.t_max = Float(aov_.max_distance);
    return Spectrum::Constant(shadow_transmittance(scene_, shadow, {}, rays));
  }

  const SceneType& scene_;
  Aov aov_;
};

} // namespace render
