#pragma once
/// Path tracing from the camera, by any of the strategies of the books.

#include <render/film/image.h>
#include <render/integrator/light_paths.h>

#include <mc/estimate/mis.h>

// g++ gives up inlining where three kinds of streams share a file, and calls of a few instructions cost a twentieth of
// the time. Under the sanitizers flat functions would take half an hour to compile.
#if defined(NDEBUG)
#define RENDER_FLAT [[gnu::flatten]]
#else
#define RENDER_FLAT
#endif

namespace render {

struct PathOptions {
  Strategy strategy = strategy_from("mis");
  int max_depth = -1; ///< longest path in edges (1: light seen directly); -1: no limit
  Shown shown = Shown::radiance;
};

/// Traces paths through a scene, which must outlive it. Immutable, so threads share it.
///   Where LightPaths find light, too, what a path finds counts less, and the rest is theirs to add.
///   Lights that are not sampled (see LightLike) are met by following directions, in every strategy, and count fully.
///   Caustics cannot be reached by connecting to a light. Therefore `mis` aims up to a quarter of its directions at the
///   spheres of glass or mirror, where a scene has any: smallpt's box takes a quarter less time to a given error.
///   A path splits in two where it first meets a surface that is not a delta, since two fifths of the time but little
///   of the variance come from the way there and the light straight from the lights: a tenth to a fifth less time to a
///   given error, no less with three or four branches. Source: [ArvoKirk90]
///   Russian roulette: from the fourth edge on a path survives with four times the largest component of its throughput,
///                     corrected for the compression of radiance in glass, at most .99. The factor balances variance
///                     against cost: at one the Cornell box and smallpt's take a third more time to a given error.
///                     Where a direction was aimed, and through glass from there, the factor is how much denser that
///                     is than following the BSDF, if that is more than four: throughput towards a small lamp is as
///                     small as the lamp, and all its light would come on paths that hardly ever survive.
/// Times to a given error are measured as CPU seconds of `carlo render` times the relmse of `carlo compare` between two
/// seeds.
template <class SceneType> class PathIntegrator {
 public:
  /// light_paths : that find some of the light; null: none are traced. It must outlive this, too
  PathIntegrator(const SceneType& scene, const PathOptions& options, const LightPaths* light_paths = nullptr)
      : scene_(scene), options_(options),
        directions_(light_paths ? light_paths->of_camera() : Directions(scene, options.strategy)),
        light_paths_(light_paths) {}

  /// Radiance that arrives along `ray`, or what else is shown, one sample. `rays` counts the rays traced.
  ///   around : through what the ray starts
  template <class Stream>
  Spectrum radiance(const Ray& ray, Stream& stream, std::uint64_t& rays, const Media& around = {}) const;

 private:
  using Own = std::remove_cvref_t<decltype(std::declval<SceneType>().bsdf(std::declval<Surface>()))>;

  using At = Meeting<Own>;

  /// A path under way.
  struct Walk {
    Ray ray;                          ///< to trace next
    Vec3 previous;                    ///< where it comes from
    Spectrum beta = Spectrum::Ones(); ///< what light found along it counts
    Float previous_pdf = 0; ///< of its direction; 0: camera or narrow lobe, which no light sampling could have chosen
    Float eta_scale = 1;    ///< undoes the compression of radiance in glass
    Float over_bsdf = 1;    ///< density of its way since the last rough surface over that of following BSDFs alone
    int edges = 0;          ///< traced so far
    Media media = {};       ///< that the ray goes through
    Odds odds = {};         ///< of the paths from the lights
  };

  // The normal of what a ray meets, as a colour.
  template <class Stream> Spectrum normal(Ray ray, Stream& stream, std::uint64_t& rays) const {
    if (const auto hit = meet(ray, stream, rays))
      return (scene_.surface(*hit).shape->surface_point(ray, *hit).ns.array() + 1) / 2;
    Spectrum radiance = Spectrum::Zero();
    for (const std::uint32_t light : scene_.infinite_lights())
      radiance += scene_.lights()[light].emitted(ray.d, nullptr);
    return radiance;
  }

  // Whether one direction from what a ray meets is open, of those that a uniform sky lights it from.
  template <class Stream> Spectrum openness(Ray ray, Stream& stream, std::uint64_t& rays) const {
    const auto hit = meet(ray, stream, rays);
    if (!hit) return Spectrum::Ones();
    const SurfacePoint point = scene_.surface(*hit).shape->surface_point(ray, *hit);
    const auto frame = mc::Frame<Float>::from_z(point.ns.dot(ray.d) < 0 ? point.ns : Vec3(-point.ns));
    const Vec3 d = frame.to_world(mc::CosineHemisphere<Float>{}.sample(stream.next2()));
    if (d.dot(point.ng) * ray.d.dot(point.ng) >= 0) return Spectrum::Zero(); // into the true surface
    Ray shadow = point.spawn_ray(d);
    shadow.t_max = Float(options_.shown.reach);
    return Spectrum::Constant(open_share(scene_, shadow, {}, rays));
  }

  // See visibility.h: a mask is there or not, as chance has it.
  template <class Stream> std::optional<Hit> meet(Ray& ray, Stream& stream, std::uint64_t& rays) const {
    return render::meet(scene_, ray, rays, [&](Float opacity) {
      return opacity == 0 || mc::Bernoulli<Float>(opacity).sample_index(stream.next()).index == 0;
    });
  }

  // Radiance found along the rest of a path; `whole`: it has not split yet.
  template <class Stream> Spectrum follow(Walk walk, Stream& stream, std::uint64_t& rays, bool whole) const {
    Spectrum radiance = Spectrum::Zero();
    while (options_.max_depth < 0 || walk.edges < options_.max_depth) {
      if (!walk.beta.isFinite().all()) [[unlikely]]
        return walk.beta; // an invalid sample
      ++walk.edges;
      const auto hit = meet(walk.ray, stream, rays);
      if (!hit) {
        if (walk.media.here) [[unlikely]]
          walk.beta *= walk.media.here->transmittance(mc::infinity<Float>);
        if (light_paths_) [[unlikely]]
          walk.odds.meet(1, 1); // a direction of the light
        for (const std::uint32_t light : scene_.infinite_lights())
          radiance += walk.beta * emission(light, nullptr, walk);
        return radiance;
      }
      const Surface& surface = scene_.surface(*hit);
      const SurfacePoint point = surface.shape->surface_point(walk.ray, *hit);
      if (walk.media.here) [[unlikely]]
        walk.beta *= walk.media.here->transmittance((point.p - walk.previous).norm());
      if (light_paths_) [[unlikely]]
        meet_from_both_ends(point, walk);
      if (surface.light) radiance += walk.beta * emission(*surface.light, &point, walk);
      if (walk.edges == options_.max_depth) return radiance;

      const auto frame = mc::Frame<Float>::from_z(point.ns);
      std::optional<Bsdf> varied;
      const At at{
          {scene_.bsdf(surface, *hit, point, varied), point, frame, frame.to_local(-walk.ray.d)}, surface, walk.media};
      const bool rough = !at.bsdf.is_delta();
      if (rough && connects() && scene_.has_light_choice()) radiance += walk.beta * connect(at, walk, stream, rays);
      if (whole && rough) return radiance + branch(at, walk, stream, rays);
      if (!scatter(at, walk, stream)) return radiance;
    }
    return radiance;
  }

  template <class Stream>
  Spectrum branch(const At& at, const Walk& walk, const Stream& stream, std::uint64_t& rays) const {
    const auto [copies, weight] = mc::split<Float>(2, 0);
    Spectrum sum = Spectrum::Zero();
    for (std::uint32_t i = 0; i < copies; ++i) {
      Walk own = walk;
      Stream numbers = stream.branch(i, copies);
      if (scatter(at, own, numbers)) sum += follow(own, numbers, rays, false);
    }
    return sum * weight;
  }

  bool connects() const { return options_.strategy.finding != Finding::by_chance; }

  // Light that what was met itself sends back along the path.
  Spectrum emission(std::uint32_t light, const SurfacePoint* met, const Walk& walk) const {
    const Light& source = scene_.lights()[light];
    const Spectrum emitted = source.emitted(walk.ray.d, met);
    if (is_black(emitted) || !connects() || !source.is_sampled()) return emitted;
    Float weight = 1;
    if (walk.previous_pdf > 0) {
      if (options_.strategy.finding == Finding::by_connection) return Spectrum::Zero();
      const Float other = scene_.light_pmf(walk.previous, light) * source.pdf(walk.previous, walk.ray.d, met);
      weight = mc::power_heuristic(walk.previous_pdf, other);
    }
    if (light_paths_ && walk.edges > 2) [[unlikely]]
      weight = among_three(weight, walk.odds.with(light_paths_->start2(light, met, walk.previous, walk.ray.d)));
    return emitted * weight;
  }

  // The weight of a way to find a path, from that among two and the odds of the third against it.
  static Float among_three(Float weight, double odds) { return Float(double(weight) / (1 + double(weight) * odds)); }

  // What paths from the lights would have made of the edge.
  void meet_from_both_ends(const SurfacePoint& point, Walk& walk) const {
    const double cosine = std::abs(double(point.ng.dot(walk.ray.d)));
    const double distance2 = (point.p - walk.previous).template cast<double>().squaredNorm();
    if (walk.edges > 1) walk.odds.meet(cosine, distance2);
    else walk.odds.meet_from_point(cosine, distance2);
  }

  // Squared density with which paths from the lights go on from `at`, where they come from wi, the way that this came.
  static double reverse2(const At& at, const Walk& walk, const Vec3& wi, bool narrow, Float eta) {
    if (walk.edges == 1) return narrow ? 0 : 1; // they are connected to the camera there
    return mc::sqr(reverse_pdf(at.bsdf, at.wo, wi, narrow, eta));
  }

  // Light from one direction towards a light, reflected toward wo.
  template <class Stream>
  RENDER_FLAT Spectrum connect(const At& at, const Walk& walk, Stream& stream, std::uint64_t& rays) const {
    const Vec2 u = stream.next2(); // u[0] also chooses the light, so that the choice is as well spread as the points
    const auto choice = scene_.sample_light(at.point.p, u[0]);
    const Light& source = scene_.lights()[choice.index];
    if (at.bsdf.is_narrow() && !source.is_delta()) return Spectrum::Zero();
    const auto s = source.sample(at.point.p, {choice.u_remapped, u[1]});
    if (!s || is_black(s->radiance)) return Spectrum::Zero();
    const Vec3 wi = at.frame.to_local(s->wi);
    if (!is_real(at, wi, s->wi)) return Spectrum::Zero();
    const Spectrum f = at.bsdf.eval(at.wo, wi);
    if (is_black(f)) return f;
    const std::optional<Ray> ray = s->end ? at.point.spawn_ray_to(*s->end, s->wi) : at.point.spawn_ray(s->wi);
    if (!ray) return Spectrum::Zero();
    const Float open = open_share(scene_, *ray, s->end, rays);
    if (open == 0) return Spectrum::Zero();
    Spectrum arriving = open * s->radiance;
    if (const HomogeneousMedium* medium = at.media(s->wi).here) [[unlikely]]
      arriving *= medium->transmittance(s->end ? (s->end->p - at.point.p).norm() : mc::infinity<Float>);
    const Float pdf = choice.pmf * s->pdf;
    const bool shared = options_.strategy.finding == Finding::by_both && !source.is_delta();
    Float weight = shared ? mc::power_heuristic(pdf, directions_.pdf(at, wi, s->wi)) : Float(1);
    if (light_paths_ && walk.edges > 1) [[unlikely]]
      weight = among_three(weight, light_odds(at, walk, wi, *s, static_cast<std::uint32_t>(choice.index), pdf));
    return f * arriving * (std::abs(wi.z()) * weight / pdf);
  }

  // The odds of paths from the lights against a connection of density `pdf` [1/sr].
  double light_odds(const At& at, const Walk& walk, const Vec3& wi, const LightSample& s, std::uint32_t light,
                    Float pdf) const {
    const SurfacePoint* end = s.end ? &*s.end : nullptr;
    const double at_light = end ? std::abs(double(end->ng.dot(s.wi))) : 1,
                 here = std::abs(double(at.point.ng.dot(s.wi)));
    return walk.odds.with(reverse2(at, walk, wi, false, 1)) * light_paths_->start2(light, end, at.point.p, s.wi) *
           mc::sqr(here / (double(pdf) * at_light));
  }

  // The next direction; false where the path ends.
  template <class Stream> RENDER_FLAT bool scatter(const At& at, Walk& walk, Stream& stream) const {
    const auto next = directions_.choose(at, stream);
    if (!next) return false;
    walk.beta *= next->weight;
    walk.previous_pdf = next->pdf;
    walk.eta_scale *= mc::sqr(next->eta);
    walk.over_bsdf = next->pdf > 0 ? next->over_bsdf : walk.over_bsdf * next->over_bsdf;
    if (is_black(walk.beta)) return false;
    if (walk.edges >= 4 && walk.beta.isFinite().all()) { // of an invalid path roulette would leave no trace
      const Float survival = std::clamp(std::max(Float(4), walk.over_bsdf) * walk.beta.maxCoeff() * walk.eta_scale,
                                        std::numeric_limits<Float>::min(), Float(0.99));
      const auto roulette = mc::russian_roulette<Float>(survival, stream.next());
      if (!roulette.survives) return false;
      walk.beta *= roulette.weight;
    }
    if (light_paths_) [[unlikely]] {
      const bool narrow = next->pdf == 0;
      walk.odds.turn(reverse2(at, walk, at.frame.to_local(next->d), narrow, next->eta), narrow ? 1 : double(next->pdf),
                     std::abs(double(at.point.ng.dot(next->d))));
    }
    walk.previous = at.point.p;
    walk.ray = at.point.spawn_ray(next->d);
    walk.media = at.media(next->d);
    return true;
  }

  const SceneType& scene_;
  PathOptions options_;
  Directions directions_;
  const LightPaths* light_paths_;
};

template <class SceneType>
template <class Stream>
Spectrum PathIntegrator<SceneType>::radiance(const Ray& ray, Stream& stream, std::uint64_t& rays,
                                             const Media& around) const {
  if (options_.shown.what == Shown::normals) return normal(ray, stream, rays);
  if (options_.shown.what == Shown::ambient_occlusion) return openness(ray, stream, rays);
  Walk walk{ray, ray.o};
  walk.media = around;
  if (light_paths_) [[unlikely]]
    walk.odds = Odds(1, light_paths_->camera_density(ray.d), 0);
  if (around.here || light_paths_) [[unlikely]] // it fills what is cut away before the lens, too
    walk.previous -= scene_.camera().near() / ray.d.dot(scene_.camera().forward()) * ray.d;
  return follow(walk, stream, rays, true);
}

} // namespace render
