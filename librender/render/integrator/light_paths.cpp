#include <render/integrator/light_paths.h>

#include <mc/warp/mixture_n.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace render {

namespace {

constexpr Float aimed_share = Float(0.8); // of the paths from lamps and points
constexpr std::size_t most_casters = 8;   // aiming at more would not pay

template <class Holds> std::vector<const Shape*> shapes_where(const Scene& scene, Holds&& holds) {
  std::vector<const Shape*> found;
  for (const Surface& s : scene.surfaces())
    if (holds(scene.bsdf(s))) found.push_back(s.shape.get());
  return found;
}

// About the middle of its box; of radius 0 where nothing of it can be met.
struct Ball {
  Vec3d center = Vec3d::Zero();
  double radius = 0;
};

Ball ball_around(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return {sphere->center(), sphere->radius()};
  const auto& mesh = std::get<TriangleMesh>(shape);
  if (mesh.box().isEmpty()) return {};
  const Vec3d center = mesh.box().center();
  double radius2 = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i)
    for (const Vec3& p : mesh.vertices(i)) radius2 = std::max(radius2, (p.cast<double>() - center).squaredNorm());
  return {center, std::sqrt(radius2)};
}

Ball ball_around(std::span<const Ball> balls) {
  Eigen::AlignedBox3d all;
  for (const auto& [center, radius] : balls)
    all.extend(Eigen::AlignedBox3d(center.array() - radius, center.array() + radius));
  return {all.center(), all.diagonal().norm() / 2};
}

// Balls around all that casts caustics, where these are many around glass and mirrors alone: nothing but paths from the
// lights finds the caustics of parallel light. Of too many the largest have their own and all others one, which is then
// no wider than it must be.
std::vector<Shape> balls_around_casters(const Scene& scene) {
  auto casters = shapes_where(scene, [](const Bsdf& b) { return b.casts_caustics(); });
  if (casters.size() > most_casters) {
    const auto clear = shapes_where(scene, [](const Bsdf& b) { return b.is_narrow() || b.transmits(); });
    if (!clear.empty()) casters = clear;
  }
  std::vector<Ball> balls;
  for (const Shape* s : casters)
    if (const Ball ball = ball_around(*s); ball.radius > 0) balls.push_back(ball);
  if (balls.size() > most_casters) {
    std::stable_sort(balls.begin(), balls.end(), [](const Ball& a, const Ball& b) { return a.radius > b.radius; });
    const std::size_t own = most_casters - 1;
    const Ball others = ball_around(std::span(balls).subspan(own));
    balls.resize(own);
    balls.push_back(others);
  }
  std::vector<Shape> found;
  for (const auto& [center, radius] : balls)
    if (radius <= Sphere::most_radius) found.push_back(Sphere(center, radius));
  return found;
}

// What a lamp reaches into it sees in all directions.
std::vector<const Shape*> apart_from_lamps(const Scene& scene, const std::vector<Shape>& balls) {
  std::vector<const Shape*> found;
  for (const Shape& ball : balls)
    if (!holds_a_lamp(scene, std::get<Sphere>(ball))) found.push_back(&ball);
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
std::vector<double> shares_of(const Scene& scene, const std::vector<Shape>& balls) {
  double radius2 = 0, sum = 0, shining = 0;
  for (const Shape& ball : balls) radius2 += mc::sqr(std::get<Sphere>(ball).radius());
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
  if (!(strategy.light_paths > 0)) return {};
  std::vector<Shape> balls = balls_around_casters(scene);
  const std::vector<double> shares = shares_of(scene, balls);
  const bool shines = std::any_of(shares.begin(), shares.end(), [](double p) { return p > 0; });
  const bool fits = scene.filter().radius() <= SplatFilter::furthest;
  if (!shines || !fits || balls.empty()) return {};
  return LightPaths(scene, strategy, aspect, std::move(balls), shares);
}

std::vector<Strategy> strategies_for(const Scene& scene) {
  std::vector<Strategy> found;
  for (const Strategy& s : strategies)
    if (finds_all_lights(scene, s) && (s.light_paths == 0 || LightPaths::of(scene, s, 1))) found.push_back(s);
  return found;
}

LightPaths::LightPaths(const Scene& scene, const Strategy& strategy, Float aspect, std::vector<Shape> casters,
                       const std::vector<double>& shares)
    : scene_(&scene), rate_(double(strategy.light_paths)), tan_half_(scene.camera().tan_half(aspect)), lights_(shares),
      casters_(std::move(casters)), targets_(apart_from_lamps(scene, casters_)), starts_(targets_, aimed_share),
      follows_({}, 0), of_camera_(scene, beside(strategy)), aims_(targets_.empty() ? Float(0) : aimed_share),
      absorbs_(absorbs(scene)), lamp_(Lambert(Spectrum::Ones())) {}

double LightPaths::around(const Vec3& p, const Vec3& d, const std::optional<Aimed>& aimed) const {
  const double uniform = double(aims_.pmf(0)) / (4 * mc::pi<double>);
  if (targets_.empty()) return uniform;
  const Float at_targets = mc::mixture_pdf(mc::UniformDiscrete<Float>(targets_.size()), [&](std::size_t i) {
    return aimed && aimed->at == i ? aimed->pdf : targets_[i]->pdf(p, d);
  });
  return uniform + double(aims_.pmf(1)) * double(at_targets);
}

auto LightPaths::sample_start_from(const PointLight& lamp, double pmf, const Vec2& u) const -> std::optional<Start> {
  SurfacePoint point;
  point.p = lamp.position().cast<Float>();
  std::optional<Aimed> aimed;
  const auto part = aims_.sample_index(u[0]);
  if (part.index == 0) {
    point.ng = mc::UniformSphere<Float>{}.sample({part.u_remapped, u[1]});
  } else {
    const auto target = mc::UniformDiscrete<Float>(targets_.size()).sample_index(part.u_remapped);
    const auto s = targets_[target.index]->sample_direction(point.p, {target.u_remapped, u[1]});
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
  for (const Shape& caster : casters_) {
    const auto& ball = std::get<Sphere>(caster);
    const Vec3d way = ball.center() - p.cast<double>();
    const double r2 = mc::sqr(ball.radius()), off2 = mc::cross<double>(way, d.cast<double>()).squaredNorm();
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
