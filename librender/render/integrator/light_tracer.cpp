#include <render/integrator/light_tracer.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace render {

namespace {

constexpr std::size_t max_caustic_bounds = 8; // with more bounds aiming costs more than it gains

template <class Holds> std::vector<const Shape*> shapes_where(const Scene& scene, Holds&& holds) {
  std::vector<const Shape*> found;
  for (const Surface& s : scene.surfaces())
    if (holds(scene.bsdf(s))) found.push_back(s.shape.get());
  return found;
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
std::vector<Sphere> caustic_bounds_of(const Scene& scene) {
  auto casters = shapes_where(scene, [](const Bsdf& b) { return b.lobes().casts_caustics(); });
  if (casters.size() > max_caustic_bounds) {
    const auto clear =
        shapes_where(scene, [](const Bsdf& b) { return b.lobes().is_near_specular() || b.lobes().transmits; });
    if (!clear.empty()) casters = clear;
  }
  std::vector<Ball> balls;
  for (const Shape* s : casters)
    if (const Ball ball = s->bounding_ball(); ball.radius > 0) balls.push_back(ball);
  if (balls.size() > max_caustic_bounds) {
    std::stable_sort(balls.begin(), balls.end(), [](const Ball& a, const Ball& b) { return a.radius > b.radius; });
    const std::size_t own = max_caustic_bounds - 1;
    const Ball others = bounding_ball(std::span(balls).subspan(own));
    balls.resize(own);
    balls.push_back(others);
  }
  std::vector<Sphere> found;
  for (const auto& [center, radius] : balls)
    if (radius <= Sphere::max_radius) found.emplace_back(center, radius);
  return found;
}

// The balls that no area light overlaps. From a light inside or close to a ball, nearly all directions hit it.
std::vector<Sphere> without_enclosed_lights(const Scene& scene, std::vector<Sphere> balls) {
  std::erase_if(balls, [&](const Sphere& ball) { return contains_area_light(scene, ball.bounding_ball()); });
  return balls;
}

// Strategy of camera paths beside light paths. Light paths find caustics of lights outside the glass. Light from inside
// the glass leaves in all directions and seldom reaches the camera's view, so camera paths aim at such glass.
Strategy camera_strategy(Strategy strategy) {
  strategy.guiding_target = GuidingTarget::enclosing_speculars;
  return strategy;
}

// Relative number of light paths of each light: its power, plus a uniform third as in LightSampler, because power does
// not determine how much light reaches the view. Infinite lights without sampling get 0: only hits find them.
std::vector<double> emission_weights(const Scene& scene, const std::vector<Sphere>& balls) {
  double radius2 = 0, sum = 0, shining = 0;
  for (const Sphere& ball : balls) radius2 += mc::sqr(ball.radius());
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
  if (!(strategy.light_path_rate > 0) || scene.has_volumes()) return {};
  std::vector<Sphere> balls = caustic_bounds_of(scene);
  const std::vector<double> weights = emission_weights(scene, balls);
  const bool shines = std::any_of(weights.begin(), weights.end(), [](double p) { return p > 0; });
  const bool fits = scene.filter().radius() <= SplatFilter::max_radius;
  if (!shines || !fits || balls.empty()) return {};
  std::vector<Sphere> from_outside = without_enclosed_lights(scene, balls);
  return LightTracer(scene, strategy, aspect,
                     EmissionTargets(std::move(balls), std::move(from_outside), scene.bounds()), weights);
}

std::vector<Strategy> complete_strategies(const Scene& scene) {
  std::vector<Strategy> found;
  for (const Strategy& s : strategies)
    if (finds_all_lights(scene, s) && (s.light_path_rate == 0 || LightTracer::create(scene, s, 1))) found.push_back(s);
  return found;
}

LightTracer::LightTracer(const Scene& scene, const Strategy& strategy, Float aspect, EmissionTargets targets,
                         const std::vector<double>& weights)
    : scene_(&scene), light_path_rate_(double(strategy.light_path_rate)), tan_half_(scene.camera().tan_half(aspect)),
      light_distribution_(weights), targets_(std::move(targets)), bsdf_mixture_({}, 0),
      camera_mixture_(scene, camera_strategy(strategy)) {}

double LightTracer::emission_pdf_squared(std::uint32_t light, const SurfacePoint* light_point, const Vec3& ref,
                                         const Vec3& wi) const {
  const double pmf = double(light_distribution_.pmf(light));
  if (!(pmf > 0)) return 0;
  return mc::sqr(light_path_rate_ * pmf * scene_->lights()[light].emission_pdf(targets_, ref, wi, light_point));
}

} // namespace render
