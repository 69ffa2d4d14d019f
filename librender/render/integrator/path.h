#pragma once
/// Path tracing from the camera, by any of the strategies of the books.

#include <render/integrator/path_stream.h>
#include <render/scene/scene.h>

#include <mc/core/frame.h>
#include <mc/warp/hemisphere.h>

#include <string_view>
#include <vector>

namespace render {

/// How directions are chosen where the BSDF is not a delta. All but `light` are unbiased.
enum class Strategy {
  bsdf,       ///< by the BSDF; lights are met by chance
  hemisphere, ///< uniform in the hemisphere
  light,      ///< toward the lights only, as in [Shirley16] chapter 7: misses all light that other surfaces reflect
  mixture,    ///< one direction from the equal mixture of lights (and guides) and BSDF, as in [Shirley16] chapter 8
  nee,        ///< next event estimation: a point of a light at every vertex, lights met by chance do not count
  mis ///< nee and directions from the BSDF, some aimed at glass and mirrors, weighted by the power heuristic [Veach97]
};

/// Throws Error, naming the nearest strategy, for an unknown name.
Strategy strategy_from(std::string_view name);
std::string_view name(Strategy strategy);

struct PathOptions {
  Strategy strategy = Strategy::mis;
  int max_depth = -1; ///< longest path in edges (1: light seen directly); -1: no limit
};

namespace detail {

/// A choice of direction that aims at some shapes, each equally likely, as often as `share` says.
struct Aim {
  std::vector<const Shape*> shapes;
  Float share = 0;
};

/// What a strategy aims at.
Aim aim_of(const Scene& scene, Strategy strategy);

/// Density [1/sr] of the direction wi from p under sample_aim.
inline Float aim_pdf(const Aim& aim, const Vec3& p, const Vec3& wi) {
  Float sum = 0;
  for (const Shape* shape : aim.shapes) sum += shape->pdf(p, wi);
  return sum / Float(aim.shapes.size());
}

inline std::optional<Vec3> sample_aim(const Aim& aim, const Vec3& p, const Vec2& u) {
  const Float n = Float(aim.shapes.size()), i = std::floor(u[0] * n);
  const auto s = aim.shapes[static_cast<std::size_t>(i)]->sample(p, {u[0] * n - i, u[1]});
  return s ? std::optional(s->wi) : std::nullopt;
}

/// The power heuristic with exponent 2, by the ratio so that no square overflows. Source: [Veach97] section 9.2.4
inline Float power_weight(Float pdf, Float other) {
  const Float ratio = other / pdf;
  return 1 / (1 + ratio * ratio);
}

/// A path under way.
struct Walk {
  Ray ray;                          ///< to trace next
  Vec3 previous;                    ///< where it comes from
  Spectrum beta = Spectrum::Ones(); ///< what light found along it counts
  Float previous_pdf = 0; ///< of its direction; 0: camera or delta lobe, which no light sampling could have chosen
  Float eta_scale = 1;    ///< undoes the compression of radiance in glass
  int edges = 0;          ///< traced so far
};

/// Where a path meets a surface.
template <class B> struct Vertex {
  const B& bsdf;
  const SurfacePoint& point;
  mc::Frame<Float> frame;
  Vec3 wo; ///< in the frame
};

/// Follows paths. `rays` counts the rays traced.
template <class SceneType> class Tracer {
  using At = Vertex<std::remove_cvref_t<decltype(std::declval<SceneType>().bsdf(std::declval<Surface>()))>>;

 public:
  Tracer(const SceneType& scene, const PathOptions& options, const Aim& aim, std::uint64_t& rays)
      : scene_(scene), options_(options), aim_(aim), rays_(rays) {}

  /// Radiance found along the rest of a path; `whole`: it has not split yet.
  template <class Stream> Spectrum follow(Walk walk, Stream& stream, bool whole) {
    Spectrum radiance = Spectrum::Zero();
    while (options_.max_depth < 0 || walk.edges < options_.max_depth) {
      if (!walk.beta.isFinite().all()) [[unlikely]]
        return walk.beta; // an invalid sample
      ++walk.edges;
      ++rays_;
      const auto hit = scene_.intersect(walk.ray);
      if (!hit) {
        for (const std::uint32_t light : scene_.infinite_lights())
          radiance += walk.beta * emission(light, nullptr, walk);
        return radiance;
      }
      const Surface& surface = scene_.surface(*hit);
      const SurfacePoint point = surface.shape->surface_point(walk.ray, *hit);
      if (surface.light) radiance += walk.beta * emission(*surface.light, &point, walk);
      if (walk.edges == options_.max_depth) return radiance;

      const auto frame = mc::Frame<Float>::from_z(point.ns);
      const At vertex{scene_.bsdf(surface), point, frame, frame.to_local(-walk.ray.d)};
      const bool delta = vertex.bsdf.is_delta();
      if (connects() && !delta && scene_.light_choice()) radiance += walk.beta * connect(vertex, stream);
      if (whole && !delta) {
        Spectrum sum = Spectrum::Zero();
        for (std::uint32_t i = 0; i < branches; ++i) {
          Walk branch = walk;
          Stream own = stream.branch(i, branches);
          if (scatter(vertex, branch, own)) sum += follow(branch, own, false);
        }
        return radiance + sum / Float(branches);
      }
      if (!scatter(vertex, walk, stream)) return radiance;
    }
    return radiance;
  }

 private:
  static constexpr std::uint32_t branches = 2;

  bool connects() const { return options_.strategy == Strategy::nee || options_.strategy == Strategy::mis; }

  // Light that what was met itself sends back along the path.
  Spectrum emission(std::uint32_t light, const SurfacePoint* met, const Walk& walk) const {
    const Light& source = scene_.lights()[light];
    const Spectrum emitted = source.emitted(walk.ray.d, met);
    if (is_black(emitted) || !connects() || walk.previous_pdf == 0 || !source.is_sampled()) return emitted;
    if (options_.strategy == Strategy::nee) return Spectrum::Zero();
    return emitted * power_weight(walk.previous_pdf,
                                  scene_.light_choice()->pmf(light) * source.pdf(walk.previous, walk.ray.d, met));
  }

  // Light from one direction towards a light, reflected toward wo.
  template <class Stream> Spectrum connect(const At& vertex, Stream& stream) {
    const auto choice = scene_.light_choice()->sample_index(scene_.lights().size() > 1 ? stream.next() : Float(0));
    const Light& source = scene_.lights()[choice.index];
    const auto s = source.sample(vertex.point.p, stream.next2());
    if (!s || is_black(s->radiance)) return Spectrum::Zero();
    const Vec3 wi = vertex.frame.to_local(s->wi);
    const Spectrum f = vertex.bsdf.eval(vertex.wo, wi);
    if (is_black(f)) return f;
    ++rays_;
    if (scene_.occluded(s->end ? vertex.point.spawn_ray_to(*s->end) : vertex.point.spawn_ray(s->wi)))
      return Spectrum::Zero();
    const Float pdf = choice.pmf * s->pdf;
    const bool shared = options_.strategy == Strategy::mis && !source.is_delta();
    const Float weight = shared ? power_weight(pdf, direction_pdf(vertex, wi, s->wi)) : Float(1);
    return f * s->radiance * (std::abs(wi.z()) * weight / pdf);
  }

  // Density with which scatter picks the direction wi (d in the world), where the strategy aims or follows the BSDF.
  Float direction_pdf(const At& vertex, const Vec3& wi, const Vec3& d) const {
    const Float density = vertex.bsdf.pdf(vertex.wo, wi);
    return aim_.share > 0 ? (1 - aim_.share) * density + aim_.share * aim_pdf(aim_, vertex.point.p, d) : density;
  }

  // The next direction; false where the path ends.
  template <class Stream> bool scatter(const At& vertex, Walk& walk, Stream& stream) const {
    const auto& [bsdf, point, frame, wo] = vertex;
    Vec3 d, wi;
    if (options_.strategy == Strategy::hemisphere && !bsdf.is_delta()) {
      wi = mc::UniformHemisphere<Float>{}.sample(stream.next2());
      if (wo.z() < 0) wi.z() = -wi.z();
      d = frame.to_world(wi);
      walk.previous_pdf = 1 / (2 * mc::pi<Float>);
      walk.beta *= bsdf.eval(wo, wi) * (std::abs(wi.z()) / walk.previous_pdf);
    } else if (aim_.share > 0 && !bsdf.is_delta()) {
      Vec2 u = stream.next2(); // u[0] also makes the choices, so that they are as well spread as the directions
      if (u[0] < aim_.share) {
        u[0] = std::min(u[0] / aim_.share, mc::one_minus_epsilon<Float>);
        const auto target = sample_aim(aim_, point.p, u);
        if (!target) return false;
        d = *target;
        wi = frame.to_local(d);
      } else {
        u[0] = std::min((u[0] - aim_.share) / (1 - aim_.share), mc::one_minus_epsilon<Float>);
        const auto s = bsdf.sample(wo, stream.next(), u);
        if (!s) return false;
        wi = s->wi;
        d = frame.to_world(wi);
      }
      walk.previous_pdf = direction_pdf(vertex, wi, d);
      if (!(walk.previous_pdf > 0)) return false;
      walk.beta *= bsdf.eval(wo, wi) * (std::abs(wi.z()) / walk.previous_pdf);
    } else {
      const Float uc = stream.next();
      const auto s = bsdf.sample(wo, uc, stream.next2());
      if (!s) return false;
      wi = s->wi;
      d = frame.to_world(wi);
      walk.beta *= s->f * (std::abs(wi.z()) / s->pdf);
      walk.previous_pdf = s->delta ? Float(0) : s->pdf;
      walk.eta_scale *= mc::sqr(s->eta);
    }
    if (is_black(walk.beta)) return false;
    if (walk.edges >= 4 && walk.beta.isFinite().all()) { // of an invalid path roulette would leave no trace
      const Float survive = std::min(4 * walk.beta.maxCoeff() * walk.eta_scale, Float(0.99));
      if (!(stream.next() < survive)) return false;
      walk.beta /= survive;
    }
    walk.previous = point.p;
    walk.ray = point.spawn_ray(d);
    return true;
  }

  const SceneType& scene_;
  const PathOptions& options_;
  const Aim& aim_;
  std::uint64_t& rays_;
};

} // namespace detail

/// Traces paths through a scene, which must outlive it. Immutable, so threads share it.
///   The background is met by following the BSDF only, in every strategy, and always counts fully.
///   Caustics cannot be reached by connecting to a light. Therefore `mis` aims a quarter of its directions at the
///   spheres of glass or mirror, where a scene has any: smallpt's box takes a quarter less time to a given error.
///   A path splits in two where it first meets a surface that is not a delta, since two fifths of the time but little
///   of the variance come from the way there and the light straight from the lights: a tenth to a fifth less time to a
///   given error, no less with three or four branches. Source: [ArvoKirk90]
///   Russian roulette: from the fourth edge on a path survives with four times the largest component of its throughput,
///                     corrected for the compression of radiance in glass, at most .99. The factor balances variance
///                     against cost: at one the Cornell box and smallpt's take a third more time to a given error.
/// Times to a given error are measured as CPU seconds of `carlo render` times the relmse of `carlo compare` between two
/// seeds.
template <class SceneType> class PathIntegrator {
 public:
  PathIntegrator(const SceneType& scene, const PathOptions& options)
      : scene_(scene), options_(options), aim_(detail::aim_of(scene, options.strategy)) {}

  /// Radiance that arrives along `ray`, one sample. `rays` counts the rays traced.
  template <class Stream> Spectrum radiance(const Ray& ray, Stream& stream, std::uint64_t& rays) const {
    return detail::Tracer(scene_, options_, aim_, rays).follow({ray, ray.o}, stream, true);
  }

 private:
  const SceneType& scene_;
  PathOptions options_;
  detail::Aim aim_;
};

} // namespace render
