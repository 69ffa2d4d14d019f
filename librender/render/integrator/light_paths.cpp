#include <render/integrator/light_paths.h>

#include <mc/warp/mixture_n.h>

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

// How often paths start from each light: by its power, a third of them from all alike as in LightChoice, since power
// does not tell how much of it arrives. Infinite lights that are not sampled are found by chance alone.
std::vector<double> shares_of(const Scene& scene) {
  double radius2 = 0, sum = 0, shining = 0;
  for (const Sphere* s : spheres_of(scene)) radius2 += mc::sqr(s->radius());
  std::vector<double> shares;
  for (const Light& light : scene.lights()) {
    const double power = light.is_sampled() ? light.power(std::sqrt(radius2)) : 0;
    sum += power;
    shining += power > 0;
    shares.push_back(power);
  }
  for (double& share : shares)
    if (share > 0) share += sum / (2 * shining);
  return shares;
}

} // namespace

std::optional<LightPaths> LightPaths::of(const Scene& scene, const Strategy& strategy, Float aspect) {
  const std::vector<double> shares = shares_of(scene);
  const bool shines = std::any_of(shares.begin(), shares.end(), [](double p) { return p > 0; });
  const bool fits = scene.filter().radius() <= SplatFilter::furthest;
  const auto surfaces = scene.surfaces();
  const bool bundles =
      std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& s) { return scene.bsdf(s).casts_caustics(); });
  if (!(strategy.light_paths > 0) || !shines || !fits || !bundles) return {};
  return LightPaths(scene, strategy, aspect, shares);
}

std::vector<Strategy> strategies_for(const Scene& scene) {
  std::vector<Strategy> found;
  for (const Strategy& s : strategies)
    if (finds_all_lights(scene, s) && (s.light_paths == 0 || LightPaths::of(scene, s, 1))) found.push_back(s);
  return found;
}

LightPaths::LightPaths(const Scene& scene, const Strategy& strategy, Float aspect, const std::vector<double>& shares)
    : scene_(&scene), rate_(double(strategy.light_paths)), tan_half_(scene.camera().tan_half(aspect)), lights_(shares),
      starts_(scene, aim), follows_(scene, follow), of_camera_(scene, beside(strategy)), casters_(spheres_of(scene)),
      aims_(casters_.empty() ? Float(0) : aim.share), absorbs_(absorbs(scene)), lamp_(Lambert(Spectrum::Ones())) {}

double LightPaths::around(const Vec3& p, const Vec3& d, const std::optional<Aimed>& aimed) const {
  const double uniform = double(aims_.pmf(0)) / (4 * mc::pi<double>);
  if (casters_.empty()) return uniform;
  const Float at_casters = mc::mixture_pdf(mc::UniformDiscrete<Float>(casters_.size()), [&](std::size_t i) {
    return aimed && aimed->at == i ? aimed->pdf : casters_[i]->pdf(p, d);
  });
  return uniform + double(aims_.pmf(1)) * double(at_casters);
}

auto LightPaths::sample_start_from(const PointLight& lamp, double pmf, const Vec2& u) const -> std::optional<Start> {
  SurfacePoint point;
  point.p = lamp.position().cast<Float>();
  std::optional<Aimed> aimed;
  const auto part = aims_.sample_index(u[0]);
  if (part.index == 0) {
    point.ng = mc::UniformSphere<Float>{}.sample({part.u_remapped, u[1]});
  } else {
    const auto target = mc::UniformDiscrete<Float>(casters_.size()).sample_index(part.u_remapped);
    const auto s = casters_[target.index]->sample_direction(point.p, {target.u_remapped, u[1]});
    if (!s) return {};
    point.ng = s->wi;
    aimed = Aimed{target.index, s->pdf};
  }
  point.ns = point.ng;
  const double pdf = around(point.p, point.ng, aimed);
  return Start{{point.p, point.ng}, point, lamp.intensity(), 1 / (pmf * pdf), Odds(1 / mc::sqr(pmf), pdf, 1)};
}

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
  const double pmf = double(lights_.pmf(light));
  if (!(pmf > 0)) return 0;
  if (const auto* point = std::get_if<PointLight>(&scene_->lights()[light])) {
    const Vec3d& p = point->position();
    return mc::sqr(rate_ * pmf * around(p.cast<Float>(), -wi) / (p - ref.cast<double>()).squaredNorm());
  }
  const auto* lamp = std::get_if<AreaLight>(&scene_->lights()[light]);
  if (!lamp) return mc::sqr(rate_ * pmf * direction_pdf(scene_->lights()[light], ref, wi, nullptr) * across(ref, wi));
  SurfacePoint side = *met;
  if (lamp->is_two_sided() && side.ng.dot(wi) > 0) side.ng = -side.ng;
  side.ns = side.ng;
  const auto frame = mc::Frame<Float>::from_z(side.ng);
  const double sides = lamp->is_two_sided() ? 2 : 1;
  const double pdf = double(starts_.pdf(Vertex<Bsdf>{lamp_, side, frame, Vec3::UnitZ()}, frame.to_local(-wi), -wi));
  return mc::sqr(rate_ * pmf / lamp->shape().area() * pdf / sides);
}

} // namespace render
