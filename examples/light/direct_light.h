#pragma once
// Direct lighting by any infinite light that models render::LightLike.
#include <render/light/concept.h>
#include <render/scene/builder.h>

#include <mc/core/frame.h>
#include <mc/estimate/mis.h>
#include <mc/random/pcg.h>

enum class Technique { light, bsdf, mis }; // samples of the light, of the BSDF, or of both

// Estimates the radiance along `ray`: emission where the ray leaves the scene, else the light that the surface reflects.
template <render::LightLike Light>
render::Spectrum direct_light(const render::Scene& scene, const Light& light, const render::Ray& ray, mc::Pcg& random,
                              Technique technique) {
  using namespace render;
  const auto hit = scene.intersect(ray);
  if (!hit) return light.Le(ray.d, nullptr);
  const SurfacePoint point = scene.surface_point(ray, *hit);
  const Bsdf& bsdf = scene.bsdf(scene.surface(*hit));
  const auto frame = mc::Frame<Float>::from_z(point.ns);
  const Vec3 wo = frame.to_local(-ray.d);
  const auto weight = [&](Float pdf, Float other) {
    return technique == Technique::mis ? mc::power_heuristic(pdf, other) : Float(1);
  };
  Spectrum radiance = Spectrum::Zero();
  if (technique != Technique::bsdf) {
    if (const auto s = light.sample(point.p, random.point<Float, 2>()); s && !scene.occluded(point.spawn_ray(s->wi))) {
      const Vec3 wi = frame.to_local(s->wi);
      radiance += bsdf.eval(wo, wi) * s->radiance * (std::abs(wi.z()) * weight(s->pdf, bsdf.pdf(wo, wi)) / s->pdf);
    }
  }
  if (technique != Technique::light) {
    const Float uc = random.uniform<Float>();
    if (const auto s = bsdf.sample(wo, uc, random.point<Float, 2>())) {
      const Vec3 wi = frame.to_world(s->wi);
      const Float other = s->delta ? 0 : light.pdf(point.p, wi, nullptr);
      if (!scene.occluded(point.spawn_ray(wi)))
        radiance += s->f * light.Le(wi, nullptr) * (std::abs(s->wi.z()) * weight(s->pdf, other) / s->pdf);
    }
  }
  return radiance;
}

// A sphere on the ground, which is at y = 0.
inline render::Scene sphere_on_ground() {
  using namespace render;
  SceneBuilder builder;
  const BsdfId grey = builder.add(Bsdf(Lambert(Spectrum::Constant(Float(0.5)))));
  const Vec3d half_x(10, 0, 0), half_y(0, 0, -10), normal(0, 1, 0);
  builder.add(TriangleMesh::rectangle(Transform::columns(half_x, half_y, normal, Vec3d::Zero())), {.bsdf = grey});
  builder.add(Sphere(Vec3d(0, 1, 0), 1), {.bsdf = grey});
  LensOptions lens;
  lens.fov = 40;
  builder.set(ThinLens(Transform::look_at(Vec3d(0, 3, 8), Vec3d(0, 1, 0), Vec3d(0, 1, 0)), lens));
  return builder.build();
}
