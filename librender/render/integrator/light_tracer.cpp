#include <render/integrator/light_tracer.h>

#include <mc/warp/mixture_n.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace render {

namespace {

// share of light paths of lamps and points that are aimed at caustic bounds
constexpr Float guiding_fraction = Float(0.8);
constexpr std::size_t max_caustic_bounds = 8; // with more bounds aiming costs more than it gains

template <class Holds> std::vector<const Shape*> shapes_where(const Scene& scene, Holds&& holds) {
  std::vector<const Shape*> found;
  for (const Surface& s : scene.surfaces())
    if (holds(scene.bsdf(s))) found.push_back(s.shape.get());
  return found;
}

// A ball around the centre of a shape's bounding box; radius 0 if the shape is empty.
struct Ball {
  Vec3d center = Vec3d::Zero();
  double radius = 0;
};

Ball bounding_ball(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return {sphere->center(), sphere->radius()};
  const auto& mesh = std::get<TriangleMesh>(shape);
  if (mesh.box().isEmpty()) return {};
  const Vec3d center = mesh.box().center();
  double radius2 = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i)
    for (const Vec3& p : mesh.vertices(i)) radius2 = std::max(radius2, (p.cast<double>() - center).squaredNorm());
  return {center, std::sqrt(radius2)};
}

Ball bounding_ball(std::span<const Ball> balls) {
  Eigen::AlignedBox3d all;
  for (const auto& [center, radius] : balls)
    all.extend(Eigen::AlignedBox3d(center.array() - radius, center.array() + radius));
  return {all.center(), all.diagonal().norm() / 2};
}

// Balls around the shapes that cast caustics. If there are too many shapes, only glass and mirrors count: only light
// paths find their caustics of parallel light. If there are still too many balls, the largest stay and one ball
// encloses the others, so that this ball is as small as possible.
std::vector<Shape> caustic_bounds_of(const Scene& scene) {
  auto casters = shapes_where(scene, [](const Bsdf& b) { return b.lobes().casts_caustics(); });
  if (casters.size() > max_caustic_bounds) {
    const auto clear =
        shapes_where(scene, [](const Bsdf& b) { return b.lobes().is_near_specular() || b.lobes().transmits; });
    if (!clear.empty()) casters = clear;
  }
  std::vector<Ball> balls;
  for (const Shape* s : casters)
    if (const Ball ball = bounding_ball(*s); ball.radius > 0) balls.push_back(ball);
  if (balls.size() > max_caustic_bounds) {
    std::stable_sort(balls.begin(), balls.end(), [](const Ball& a, const Ball& b) { return a.radius > b.radius; });
    const std::size_t own = max_caustic_bounds - 1;
    const Ball others = bounding_ball(std::span(balls).subspan(own));
    balls.resize(own);
    balls.push_back(others);
  }
  std::vector<Shape> found;
  for (const auto& [center, radius] : balls)
    if (radius <= Sphere::max_radius) found.push_back(Sphere(center, radius));
  return found;
}

// The balls that no area light overlaps. From a light inside or close to a ball, nearly all directions hit it.
std::vector<const Shape*> without_enclosed_lights(const Scene& scene, const std::vector<Shape>& balls) {
  std::vector<const Shape*> found;
  for (const Shape& ball : balls)
    if (!contains_area_light(scene, std::get<Sphere>(ball))) found.push_back(&ball);
  return found;
}

// Strategy of camera paths beside light paths. Light paths find caustics of lights outside the glass. Light from inside
// the glass leaves in all directions and seldom reaches the camera's view, so camera paths aim at such glass.
Strategy camera_strategy(Strategy strategy) {
  strategy.guiding_target = GuidingTarget::enclosing_speculars;
  return strategy;
}

// Relative number of light paths of each light: its power, plus a uniform third as in LightSampler, because power does
// not determine how much light reaches the view. Infinite lights without sampling get 0: only hits find them.
std::vector<double> emission_weights(const Scene& scene, const std::vector<Shape>& balls) {
  double radius2 = 0, sum = 0, shining = 0;
  for (const Shape& ball : balls) radius2 += mc::sqr(std::get<Sphere>(ball).radius());
  std::vector<double> weights;
  for (const Light& light : scene.lights()) {
    const double power = light.is_sampled() ? light.power(std::sqrt(radius2)) : 0;
    sum += power;
    shining += power > 0;
    weights.push_back(power);
  }
  for (double& share : weights)
    if (share > 0) share += sum / (2 * shining);
  return weights;
}

} // namespace

std::optional<LightTracer> LightTracer::create(const Scene& scene, const Strategy& strategy, Float aspect) {
  if (!(strategy.light_path_rate > 0)) return {};
  std::vector<Shape> balls = caustic_bounds_of(scene);
  const std::vector<double> weights = emission_weights(scene, balls);
  const bool shines = std::any_of(weights.begin(), weights.end(), [](double p) { return p > 0; });
  const bool fits = scene.filter().radius() <= SplatFilter::max_radius;
  if (!shines || !fits || balls.empty()) return {};
  return LightTracer(scene, strategy, aspect, std::move(balls), weights);
}

std::vector<Strategy> complete_strategies(const Scene& scene) {
  std::vector<Strategy> found;
  for (const Strategy& s : strategies)
    if (finds_all_lights(scene, s) && (s.light_path_rate == 0 || LightTracer::create(scene, s, 1))) found.push_back(s);
  return found;
}

LightTracer::LightTracer(const Scene& scene, const Strategy& strategy, Float aspect, std::vector<Shape> caustic_bounds,
                         const std::vector<double>& weights)
    : scene_(&scene), light_path_rate_(double(strategy.light_path_rate)), tan_half_(scene.camera().tan_half(aspect)),
      light_distribution_(weights), caustic_bounds_(std::move(caustic_bounds)),
      targeted_bounds_(without_enclosed_lights(scene, caustic_bounds_)),
      emission_mixture_(targeted_bounds_, guiding_fraction), bsdf_mixture_({}, 0),
      camera_mixture_(scene, camera_strategy(strategy)),
      guiding_choice_(targeted_bounds_.empty() ? Float(0) : guiding_fraction), has_media_(has_media(scene)),
      emission_bsdf_(Lambert(Spectrum::Ones())) {}

double LightTracer::point_emission_pdf(const Vec3& p, const Vec3& d,
                                       const std::optional<TargetedDirection>& targeted) const {
  const double uniform = double(guiding_choice_.pmf(0)) / (4 * mc::pi<double>);
  if (targeted_bounds_.empty()) return uniform;
  const Float at_targets = mc::mixture_pdf(mc::UniformDiscrete<Float>(targeted_bounds_.size()), [&](std::size_t i) {
    return targeted && targeted->target == i ? targeted->pdf : targeted_bounds_[i]->pdf(p, d);
  });
  return uniform + double(guiding_choice_.pmf(1)) * double(at_targets);
}

auto LightTracer::sample_point_emission(const PointLight& lamp, double pmf, const Vec2& u) const
    -> std::optional<EmissionSample> {
  SurfacePoint point;
  point.p = lamp.position().cast<Float>();
  std::optional<TargetedDirection> targeted;
  const auto part = guiding_choice_.sample_index(u[0]);
  if (part.index == 0) {
    point.ng = mc::UniformSphere<Float>{}.sample({part.u_remapped, u[1]});
  } else {
    const auto target = mc::UniformDiscrete<Float>(targeted_bounds_.size()).sample_index(part.u_remapped);
    const auto s = targeted_bounds_[target.index]->sample_direction(point.p, {target.u_remapped, u[1]});
    if (!s) return {};
    point.ng = s->wi;
    targeted = TargetedDirection{target.index, s->pdf};
  }
  point.ns = point.ng;
  const double pdf = point_emission_pdf(point.p, point.ng, targeted);
  return EmissionSample{
      {point.p, point.ng}, point, lamp.intensity(), 1 / (pmf * pdf), PartialMisWeight(1 / mc::sqr(pmf), pdf, 1)};
}

double LightTracer::parallel_emission_pdf(const Vec3& p, const Vec3& d) const {
  double density = 0;
  for (const Shape& caster : caustic_bounds_) {
    const auto& ball = std::get<Sphere>(caster);
    const Vec3d way = ball.center() - p.cast<double>();
    const double r2 = mc::sqr(ball.radius()), off2 = mc::cross<double>(way, d.cast<double>()).squaredNorm();
    if (off2 <= r2) density += 1 / (mc::pi<double> * r2 * double(caustic_bounds_.size()));
  }
  return density;
}

double LightTracer::emission_pdf_squared(std::uint32_t light, const SurfacePoint* light_point, const Vec3& ref,
                                         const Vec3& wi) const {
  const double pmf = double(light_distribution_.pmf(light));
  if (!(pmf > 0)) return 0;
  if (const auto* point = std::get_if<PointLight>(&scene_->lights()[light])) {
    const Vec3d& p = point->position();
    return mc::sqr(light_path_rate_ * pmf * point_emission_pdf(p.cast<Float>(), -wi) /
                   (p - ref.cast<double>()).squaredNorm());
  }
  const auto* lamp = std::get_if<AreaLight>(&scene_->lights()[light]);
  if (!lamp)
    return mc::sqr(light_path_rate_ * pmf * direction_pdf(scene_->lights()[light], ref, wi, nullptr) *
                   parallel_emission_pdf(ref, wi));
  SurfacePoint side = *light_point;
  if (lamp->is_two_sided() && side.ng.dot(wi) > 0) side.ng = -side.ng;
  side.ns = side.ng;
  const auto frame = mc::Frame<Float>::from_z(side.ng);
  const double sides = lamp->is_two_sided() ? 2 : 1;
  const double pdf = double(
      emission_mixture_.pdf(ShadingPoint<Bsdf>{emission_bsdf_, side, frame, Vec3::UnitZ()}, frame.to_local(-wi), -wi));
  return mc::sqr(light_path_rate_ * pmf / lamp->shape().area() * pdf / sides);
}

} // namespace render
