#pragma once
/// What a path from the camera does, edge by edge.

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

/// Light that a path finds.
struct FoundLight {
  Spectrum value;  ///< that counts if no path from the lights could have found it
  double odds = 0; ///< that one did

  Spectrum counted() const { return odds == 0 ? value : Spectrum(value * Float(1 / (1 + odds))); }
};

/// A path under way.
struct Walk {
  Ray ray;                          ///< to trace next
  Vec3 previous;                    ///< where it comes from
  Spectrum beta = Spectrum::Ones(); ///< what light found along it counts
  Float previous_pdf = 0; ///< of its direction; 0: camera or narrow lobe, which no light sampling could have chosen
  Float worth = 1;        ///< times beta: what roulette goes by. Undoes the compression of radiance in glass
  Float over_bsdf = 1;    ///< density of its way since the last rough surface over that of following BSDFs alone
  int edges = 0;          ///< traced so far
  Media media = {};       ///< that the ray goes through
  Odds odds = {};         ///< of the paths from the lights
};

/// The steps of paths through a scene, which must outlive it; what they are by is said at PathIntegrator.
template <class SceneType> class PathSteps {
 public:
  using Own = std::remove_cvref_t<decltype(std::declval<SceneType>().bsdf(std::declval<Surface>()))>;
  using At = Meeting<Own>;

  /// Where a path meets a surface. It stays where it is: its BSDF may be made in it.
  struct Place {
    Place() = default;
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

    SurfacePoint point;
    const Surface* surface = nullptr;
    const Own* bsdf = nullptr;
    std::optional<Bsdf> room; ///< of the BSDF where a texture varies it

    At at(const Walk& walk) const {
      const auto frame = mc::Frame<Float>::from_z(point.ns);
      return {{*bsdf, point, frame, frame.to_local(-walk.ray.d)}, *surface, walk.media};
    }
  };

  /// light_paths : that find some of the light; null: none are traced. It must outlive this, too
  PathSteps(const SceneType& scene, const Strategy& strategy, int max_depth, const LightPaths* light_paths)
      : scene_(scene), strategy_(strategy), max_depth_(max_depth),
        directions_(light_paths ? light_paths->of_camera() : Directions(scene, strategy)), light_paths_(light_paths) {}

  const SceneType& scene() const { return scene_; }
  const Directions& directions() const { return directions_; }

  /// A path that starts by a ray of the camera.
  ///   around : through what the ray starts
  Walk start(const Ray& ray, const Media& around) const {
    Walk walk{ray, ray.o};
    walk.media = around;
    if (light_paths_) [[unlikely]]
      walk.odds = Odds(1, light_paths_->camera_density(ray.d), 0);
    if (around.here || light_paths_) [[unlikely]] // it fills what is cut away before the lens, too
      walk.previous -= scene_.camera().near() / ray.d.dot(scene_.camera().forward()) * ray.d;
    return walk;
  }

  /// The nearest surface that a ray meets. See visibility.h: a mask is there or not, as chance has it.
  template <class Stream> std::optional<Hit> meet(Ray& ray, Stream& stream, std::uint64_t& rays) const {
    return render::meet(scene_, ray, rays, [&](Float opacity) {
      return opacity == 0 || mc::Bernoulli<Float>(opacity).sample_index(stream.next()).index == 0;
    });
  }

  /// One edge of a path, to the place where it meets a surface; `found` is given the light at its end. False where the
  /// path ends there.
  template <class Stream, class Found>
  bool arrive(Walk& walk, Place& place, Stream& stream, std::uint64_t& rays, const Found& found) const {
    if (walk.edges == max_depth_) return false;
    if (!walk.beta.isFinite().all()) [[unlikely]] {
      found(FoundLight{walk.beta}); // an invalid sample
      return false;
    }
    ++walk.edges;
    const auto hit = meet(walk.ray, stream, rays);
    if (!hit) {
      if (walk.media.here) [[unlikely]]
        walk.beta *= walk.media.here->transmittance(mc::infinity<Float>);
      if (light_paths_) [[unlikely]]
        walk.odds.meet(1, 1); // a direction of the light
      for (const std::uint32_t light : scene_.infinite_lights()) found(emission(light, nullptr, walk));
      return false;
    }
    place.surface = &scene_.surface(*hit);
    place.point = place.surface->shape->surface_point(walk.ray, *hit);
    if (walk.media.here) [[unlikely]]
      walk.beta *= walk.media.here->transmittance((place.point.p - walk.previous).norm());
    if (light_paths_) [[unlikely]]
      meet_from_both_ends(place.point, walk);
    if (place.surface->light) found(emission(*place.surface->light, &place.point, walk));
    if (walk.edges == max_depth_) return false;
    place.bsdf = &scene_.bsdf(*place.surface, *hit, place.point, place.room);
    return true;
  }

  /// Follows a path to where it first meets a surface that is not a delta. False where it ends before.
  template <class Stream, class Found>
  bool arrive_at_rough(Walk& walk, Place& place, Stream& stream, std::uint64_t& rays, const Found& found) const {
    while (arrive(walk, place, stream, rays, found)) {
      if (!place.bsdf->is_delta()) return true;
      if (!scatter(place.at(walk), walk, stream)) return false;
    }
    return false;
  }

  /// Gives `found` the light that is found along the rest of a path.
  template <class Stream, class Found>
  void follow(Walk& walk, Stream& stream, std::uint64_t& rays, const Found& found) const {
    Place place;
    while (arrive(walk, place, stream, rays, found)) {
      if (!leave(place.at(walk), walk, stream, rays, found)) return;
    }
  }

  /// Light straight from the lights to where a path is, and its next direction; false where the path ends.
  template <class Stream, class Found>
  bool leave(const At& at, Walk& walk, Stream& stream, std::uint64_t& rays, const Found& found) const {
    if (!at.bsdf.is_delta()) connect(at, walk, stream, rays, found);
    return scatter(at, walk, stream);
  }

  /// Light straight from the lights to where a path is.
  template <class Stream, class Found>
  void connect(const At& at, const Walk& walk, Stream& stream, std::uint64_t& rays, const Found& found) const {
    if (!connects() || !scene_.has_light_choice()) return;
    FoundLight light = connection(at, walk, stream, rays);
    light.value *= walk.beta;
    found(light);
  }

  /// The next direction, if the path goes on.
  template <class Stream> bool scatter(const At& at, Walk& walk, Stream& stream) const {
    return turn(at, walk, stream) && survives(walk, stream);
  }

  /// The next direction; false where the path is absorbed.
  template <class Stream> RENDER_FLAT bool turn(const At& at, Walk& walk, Stream& stream) const {
    const auto next = directions_.choose(at, stream);
    if (!next) return false;
    walk.beta *= next->weight;
    walk.previous_pdf = next->pdf;
    walk.worth *= mc::sqr(next->eta);
    walk.over_bsdf = next->pdf > 0 ? next->over_bsdf : walk.over_bsdf * next->over_bsdf;
    if (is_black(walk.beta)) return false;
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

  /// The odds of paths from the lights where a path, at `at`, would come to `next` by the direction d of density `pdf`
  /// [1/sr] if it looks the same from everywhere: but for a factor that does not depend on where it came from. 0 where
  /// there are none.
  double odds_at(const SurfacePoint& next, const At& at, const Walk& walk, const Vec3& d, Float pdf) const {
    if (!light_paths_) [[likely]]
      return 0;
    Odds odds = walk.odds;
    odds.turn(reverse2(at, walk, at.frame.to_local(d), false, 1), double(pdf), std::abs(double(at.point.ng.dot(d))));
    odds.meet(std::abs(double(next.ng.dot(d))), (next.p - at.point.p).template cast<double>().squaredNorm());
    return odds.with(mc::sqr(double(next.ns.dot(d))));
  }

  /// Whether a path survives Russian roulette.
  template <class Stream> static bool survives(Walk& walk, Stream& stream) {
    if (walk.edges < 4 || !walk.beta.isFinite().all()) return true; // of an invalid path roulette would leave no trace
    const Float survival = std::clamp(std::max(Float(4), walk.over_bsdf) * walk.beta.maxCoeff() * walk.worth,
                                      std::numeric_limits<Float>::min(), Float(0.99));
    const auto roulette = mc::russian_roulette<Float>(survival, stream.next());
    walk.beta *= roulette.weight;
    return roulette.survives;
  }

 private:
  bool connects() const { return strategy_.finding != Finding::by_chance; }

  // Light that what was met itself sends back along the path.
  FoundLight emission(std::uint32_t light, const SurfacePoint* met, const Walk& walk) const {
    const Light& source = scene_.lights()[light];
    const Spectrum emitted = source.emitted(walk.ray.d, met);
    if (is_black(emitted) || !connects() || !source.is_sampled()) return {walk.beta * emitted};
    Float weight = 1;
    if (walk.previous_pdf > 0) {
      if (strategy_.finding == Finding::by_connection) return {Spectrum::Zero()};
      const Float other = scene_.light_pmf(walk.previous, light) * source.pdf(walk.previous, walk.ray.d, met);
      weight = mc::power_heuristic(walk.previous_pdf, other);
    }
    FoundLight found{walk.beta * (emitted * weight)};
    if (light_paths_ && walk.edges > 2) [[unlikely]]
      found.odds = double(weight) * walk.odds.with(light_paths_->start2(light, met, walk.previous, walk.ray.d));
    return found;
  }

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
  RENDER_FLAT FoundLight connection(const At& at, const Walk& walk, Stream& stream, std::uint64_t& rays) const {
    const Vec2 u = stream.next2(); // u[0] also chooses the light, so that the choice is as well spread as the points
    const auto choice = scene_.sample_light(at.point.p, u[0]);
    const Light& source = scene_.lights()[choice.index];
    if (at.bsdf.is_narrow() && !source.is_delta()) return {Spectrum::Zero()};
    const auto s = source.sample(at.point.p, {choice.u_remapped, u[1]});
    if (!s || is_black(s->radiance)) return {Spectrum::Zero()};
    const Vec3 wi = at.frame.to_local(s->wi);
    if (!is_real(at, wi, s->wi)) return {Spectrum::Zero()};
    const Spectrum f = at.bsdf.eval(at.wo, wi);
    if (is_black(f)) return {f};
    const std::optional<Ray> ray = s->end ? at.point.spawn_ray_to(*s->end, s->wi) : at.point.spawn_ray(s->wi);
    if (!ray) return {Spectrum::Zero()};
    const Float open = open_share(scene_, *ray, s->end, rays);
    if (open == 0) return {Spectrum::Zero()};
    Spectrum arriving = open * s->radiance;
    if (const HomogeneousMedium* medium = at.media(s->wi).here) [[unlikely]]
      arriving *= medium->transmittance(s->end ? (s->end->p - at.point.p).norm() : mc::infinity<Float>);
    const Float pdf = choice.pmf * s->pdf;
    const bool shared = strategy_.finding == Finding::by_both && !source.is_delta();
    const Float weight = shared ? mc::power_heuristic(pdf, directions_.pdf(at, wi, s->wi)) : Float(1);
    FoundLight found{f * arriving * (std::abs(wi.z()) * weight / pdf)};
    if (light_paths_ && walk.edges > 1) [[unlikely]]
      found.odds = double(weight) * light_odds(at, walk, wi, *s, static_cast<std::uint32_t>(choice.index), pdf);
    return found;
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

  const SceneType& scene_;
  Strategy strategy_;
  int max_depth_;
  Directions directions_;
  const LightPaths* light_paths_;
};

} // namespace render
