#include <render/integrator/light_paths.h>

#include <algorithm>
#include <cmath>

namespace render {

namespace {

constexpr Strategy follow = {"", Target::nothing, 0, Finding::by_chance};
constexpr Strategy aim = {"", Target::casters, Float(0.8), Finding::by_chance};

std::vector<const Sphere*> spheres_of(const Scene& scene) {
  std::vector<const Sphere*> found;
  for (const Shape* s : caustic_casters(scene)) found.push_back(&std::get<Sphere>(*s));
  return found;
}

// Light that glass throws onto what is seen comes from the lights, except where these lie in the glass: it then leaves
// in all directions, of which few arrive where the camera looks, and is found from there.
Strategy beside(Strategy strategy) {
  strategy.target = Target::shades;
  return strategy;
}

// What each light gives to paths from it. Infinite lights that are not sampled are found by chance alone.
std::vector<double> powers_of(const Scene& scene) {
  double radius2 = 0;
  for (const Sphere* s : spheres_of(scene)) radius2 += mc::sqr(s->radius());
  std::vector<double> powers;
  for (const Light& light : scene.lights()) {
    const bool starts = light.is_sampled() && !light.is_delta();
    powers.push_back(starts ? light.power(std::sqrt(radius2)) : 0);
  }
  return powers;
}

} // namespace

std::optional<LightPaths> LightPaths::of(const Scene& scene, const Strategy& strategy, Float aspect) {
  const std::vector<double> powers = powers_of(scene);
  const bool shines = std::any_of(powers.begin(), powers.end(), [](double p) { return p > 0; });
  const bool shares = scene.filter().radius() <= SplatFilter::furthest;
  const auto surfaces = scene.surfaces();
  const bool bundles =
      std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& s) { return casts_caustics(scene.bsdf(s)); });
  if (!(strategy.light_paths > 0) || !shines || !shares || !bundles) return {};
  return LightPaths(scene, strategy, aspect, powers);
}

std::vector<Strategy> strategies_for(const Scene& scene) {
  std::vector<Strategy> found;
  for (const Strategy& s : strategies)
    if (finds_all_lights(scene, s) && (s.light_paths == 0 || LightPaths::of(scene, s, 1))) found.push_back(s);
  return found;
}

LightPaths::LightPaths(const Scene& scene, const Strategy& strategy, Float aspect, const std::vector<double>& powers)
    : scene_(&scene), rate_(double(strategy.light_paths)), tan_half_(scene.camera().tan_half(aspect)),
      by_power_(powers), starts_(scene, aim), follows_(scene, follow), of_camera_(scene, beside(strategy)),
      casters_(spheres_of(scene)), absorbs_(absorbs(scene)), lamp_(Lambert(Spectrum::Ones())) {}

double LightPaths::across(const Vec3& p, const Vec3& d) const {
  double density = 0;
  for (const Sphere* s : casters_) {
    const Vec3d way = s->center() - p.cast<double>();
    const double r2 = mc::sqr(s->radius()), off2 = mc::cross<double>(way, d.cast<double>()).squaredNorm();
    if (off2 <= r2) density += 1 / (mc::pi<double> * r2 * double(casters_.size()));
  }
  return density;
}

double LightPaths::start2(std::uint32_t light, const SurfacePoint* met, const Vec3& ref, const Vec3& wi) const {
  const double pmf = double(by_power_.pmf(light));
  if (!(pmf > 0)) return 0;
  const auto* lamp = std::get_if<AreaLight>(&scene_->lights()[light]);
  if (!lamp) return mc::sqr(rate_ * pmf * double(scene_->lights()[light].pdf(ref, wi, nullptr)) * across(ref, wi));
  SurfacePoint side = *met;
  if (lamp->is_two_sided() && side.ng.dot(wi) > 0) side.ng = -side.ng;
  side.ns = side.ng;
  const auto frame = mc::Frame<Float>::from_z(side.ng);
  const double sides = lamp->is_two_sided() ? 2 : 1;
  const double pdf = double(starts_.pdf(Vertex<Bsdf>{lamp_, side, frame, Vec3::UnitZ()}, frame.to_local(-wi), -wi));
  return mc::sqr(rate_ * pmf / lamp->shape().area() * pdf / sides);
}

} // namespace render
