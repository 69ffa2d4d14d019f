#include <render/integrator/light_paths.h>

#include <algorithm>

namespace render {

namespace {

constexpr Strategy follow = {"", Target::nothing, 0, Finding::by_chance};
constexpr Strategy aim = {"", Target::speculars, Float(0.8), Finding::by_chance};

// What each light gives to paths from it.
std::vector<double> powers_of(const Scene& scene) {
  std::vector<double> powers;
  for (const Light& light : scene.lights())
    powers.push_back(std::holds_alternative<AreaLight>(light) ? light.power(0) : 0);
  return powers;
}

bool casts_caustics(const Scene& scene) {
  const auto surfaces = scene.surfaces();
  return std::any_of(surfaces.begin(), surfaces.end(),
                     [&](const Surface& s) { return scene.bsdf(s).is_narrow() || scene.bsdf(s).transmits(); });
}

} // namespace

std::optional<LightPaths> LightPaths::of(const Scene& scene, const Strategy& strategy, Float aspect) {
  const std::vector<double> powers = powers_of(scene);
  const bool shines = std::any_of(powers.begin(), powers.end(), [](double p) { return p > 0; });
  const bool shares = scene.filter().radius() <= SplatFilter::furthest;
  if (!(strategy.light_paths > 0) || !shines || !shares || !casts_caustics(scene)) return {};
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
      by_power_(powers), starts_(scene, aim), follows_(scene, follow),
      absorbs_(std::any_of(scene.surfaces().begin(), scene.surfaces().end(),
                           [](const Surface& s) { return s.interior.has_value(); })),
      lamp_(Lambert(Spectrum::Ones())) {}

double LightPaths::start2(std::uint32_t light, const SurfacePoint& point, const Vec3& d) const {
  const auto* lamp = std::get_if<AreaLight>(&scene_->lights()[light]);
  const double pmf = double(by_power_.pmf(light));
  if (!lamp || !(pmf > 0)) return 0;
  SurfacePoint side = point;
  if (lamp->is_two_sided() && point.ng.dot(d) < 0) side.ng = -side.ng;
  side.ns = side.ng;
  const auto frame = mc::Frame<Float>::from_z(side.ng);
  const double sides = lamp->is_two_sided() ? 2 : 1;
  const double pdf = double(starts_.pdf(Vertex<Bsdf>{lamp_, side, frame, Vec3::UnitZ()}, frame.to_local(d), d));
  return mc::sqr(rate_ * pmf / lamp->shape().area() * pdf / sides);
}

} // namespace render
