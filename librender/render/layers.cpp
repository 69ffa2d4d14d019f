#include <render/integrator/shading_point.h>
#include <render/layers.h>
#include <render/scene/visibility.h>

#include <mc/core/parallel.h>
#include <mc/sampler/path_sample_stream.h>

#include <array>

namespace render {

namespace {

/// Values at the hit of one ray.
struct Met {
  Vec3 n = Vec3::Zero();
  Vec3d p = Vec3d::Zero();
  double z = mc::infinity<double>;
  Spectrum albedo = Spectrum::Zero();
  int id = 0;
};

constexpr std::array<const char*, 11> names = {"N.X", "N.Y",      "N.Z",      "P.X",      "P.Y", "P.Z",
                                               "Z",   "albedo.R", "albedo.G", "albedo.B", "id"};

std::array<double, names.size()> values(const Met& m) {
  return {double(m.n[0]),      double(m.n[1]),      double(m.n[2]),      m.p[0],      m.p[1], m.p[2], m.z,
          double(m.albedo[0]), double(m.albedo[1]), double(m.albedo[2]), double(m.id)};
}

// Mean of f |cos| eta^2 / pdf. All calls use the same points, so that equal surfaces have equal values. On diffuse
// surfaces all samples have one value.
Spectrum albedo(const Bsdf& bsdf, const Vec3& wo) {
  const std::uint32_t n = bsdf.lobes().is_diffuse() ? 1 : 16;
  const mc::SobolPairs points(0, n);
  Spectrum sum = Spectrum::Zero();
  for (std::uint32_t i = 0; i < n; ++i) {
    mc::SobolPathStream<Float> stream(points, i);
    const Vec2 u = stream.next2();
    const auto s = bsdf.sample(wo, stream.next2()[0], u);
    if (s) sum += s->f * (std::abs(s->wi.z()) * mc::sqr(s->eta) / s->pdf);
  }
  return sum / Float(n);
}

// Values at the first hit. A mask counts as opaque where its opacity is at least 1/2.
Met look(const Scene& scene, Ray ray, const Vec3d& origin) {
  Met m;
  std::uint64_t rays = 0;
  const auto hit = nearest_hit(scene, ray, rays, [](Float opacity) { return opacity < Float(0.5); });
  if (!hit) return m;
  const Surface& surface = scene.surface(*hit);
  const SurfacePoint point = surface.shape->surface_point(ray, *hit);
  const ThinLens& camera = scene.camera();
  std::optional<Bsdf> varied;
  m.n = point.ns;
  m.p = point.p.cast<double>() + origin;
  m.z = (point.p - camera.origin()).cast<double>().dot(camera.forward().cast<double>());
  m.albedo = albedo(scene.bsdf(surface, *hit, point, varied), ShadingFrame(point, -ray.d).to_local(-ray.d));
  m.id = hit->shape + 1;
  return m;
}

} // namespace

std::map<std::string, std::vector<float>> layers(const Scene& scene, const ImageExtent& extent, const Vec3d& origin,
                                                 int threads) {
  const auto width = static_cast<std::size_t>(extent.crop.width), height = static_cast<std::size_t>(extent.crop.height);
  std::map<std::string, std::vector<float>> result;
  std::array<float*, names.size()> planes;
  for (std::size_t i = 0; i < names.size(); ++i)
    planes[i] = result.try_emplace(names[i], width * height).first->second.data();
  const ThinLens& camera = scene.camera();
  const Vec2 tan_half = camera.tan_half(Float(extent.width) / Float(extent.height)), middle(Float(0.5), Float(0.5));
  mc::parallel_for(height, threads, [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x) {
      const Vec2 s((Float(x) + Float(extent.crop.x) + Float(0.5)) / Float(extent.width),
                   (Float(y) + Float(extent.crop.y) + Float(0.5)) / Float(extent.height));
      const auto v = values(look(scene, camera.ray(s, tan_half, middle), origin));
      for (std::size_t i = 0; i < names.size(); ++i) planes[i][y * width + x] = static_cast<float>(v[i]);
    }
  });
  return result;
}

} // namespace render
