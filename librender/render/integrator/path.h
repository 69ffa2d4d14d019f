#pragma once
/// Path tracing from the camera, by any of the strategies of the books.

#include <render/integrator/path_stream.h>
#include <render/scene/scene.h>

#include <mc/core/frame.h>
#include <mc/warp/hemisphere.h>

#include <span>
#include <string_view>

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
  std::span<const int> shapes;
  Float share = 0;
};

inline Aim aim_of(const Scene& scene, Strategy strategy) {
  switch (strategy) {
  case Strategy::light: return {scene.targets(), scene.targets().empty() ? Float(0) : Float(1)};
  case Strategy::mixture: return {scene.targets(), scene.targets().empty() ? Float(0) : Float(0.5)};
  case Strategy::mis: return {scene.speculars(), scene.speculars().empty() ? Float(0) : Float(0.25)};
  default: return {};
  }
}

/// Density [1/sr] of the direction wi from p under sample_aim.
inline Float aim_pdf(const Scene& scene, const Aim& aim, const Vec3& p, const Vec3& wi) {
  Float sum = 0;
  for (const int shape : aim.shapes) sum += scene.shapes[static_cast<std::size_t>(shape)].pdf(p, wi);
  return sum / Float(aim.shapes.size());
}

inline std::optional<Vec3> sample_aim(const Scene& scene, const Aim& aim, const Vec3& p, const Vec2& u) {
  const Float n = Float(aim.shapes.size()), i = std::floor(u[0] * n);
  const auto shape = static_cast<std::size_t>(aim.shapes[static_cast<std::size_t>(i)]);
  const auto s = scene.shapes[shape].sample(p, {u[0] * n - i, u[1]});
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
struct Vertex {
  const Bsdf& bsdf;
  const SurfacePoint& point;
  mc::Frame<Float> frame;
  Vec3 wo; ///< in the frame
};

/// Follows paths. `rays` counts the rays traced.
class Tracer {
 public:
  Tracer(const Scene& scene, const PathOptions& options, std::uint64_t& rays)
      : scene_(scene), options_(options), aim_(aim_of(scene, options.strategy)), rays_(rays) {}

  /// Radiance found along the rest of a path; `whole`: it has not split yet.
  template <class Stream> Spectrum follow(Walk walk, Stream& stream, bool whole) {
    Spectrum radiance = Spectrum::Zero();
    while (options_.max_depth < 0 || walk.edges < options_.max_depth) {
      if (!walk.beta.isFinite().all()) [[unlikely]]
        return walk.beta; // an invalid sample
      ++walk.edges;
      ++rays_;
      const auto hit = scene_.bvh().intersect(walk.ray);
      if (!hit) {
        if (scene_.background) radiance += walk.beta * scene_.background->eval(walk.ray.d);
        return radiance;
      }
      const auto shape = static_cast<std::size_t>(hit->shape);
      const SurfacePoint point = scene_.shapes[shape].surface_point(walk.ray, *hit);
      if (scene_.shape_light[shape] >= 0) radiance += walk.beta * emission(point, walk);
      if (walk.edges == options_.max_depth) return radiance;

      const auto frame = mc::Frame<Float>::from_z(point.ns);
      const Vertex vertex{scene_.bsdfs[static_cast<std::size_t>(scene_.shape_bsdf[shape])], point, frame,
                          frame.to_local(-walk.ray.d)};
      const bool delta = vertex.bsdf.is_delta();
      if (connects() && !delta && !scene_.lights.empty()) radiance += walk.beta * connect(vertex, stream);
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

  // Light that the surface itself sends back along the path.
  Spectrum emission(const SurfacePoint& point, const Walk& walk) const {
    const int light = scene_.shape_light[static_cast<std::size_t>(point.shape)];
    const Spectrum emitted = scene_.lights[static_cast<std::size_t>(light)].emitted(point.ng, -walk.ray.d);
    if (is_black(emitted) || !connects() || walk.previous_pdf == 0) return emitted;
    if (options_.strategy == Strategy::nee) return Spectrum::Zero();
    const Shape& shape = scene_.shapes[static_cast<std::size_t>(point.shape)];
    return emitted *
           power_weight(walk.previous_pdf, scene_.light_pmf(light) * shape.pdf(walk.previous, walk.ray.d, point));
  }

  // Light from one point of a light, reflected toward wo.
  template <class Stream> Spectrum connect(const Vertex& vertex, Stream& stream) {
    const auto [light, pmf] = scene_.choose_light(scene_.lights.size() > 1 ? stream.next() : Float(0));
    const AreaLight& source = scene_.lights[static_cast<std::size_t>(light)];
    const auto s = scene_.shapes[static_cast<std::size_t>(source.shape)].sample(vertex.point.p, stream.next2());
    if (!s) return Spectrum::Zero();
    const Spectrum emitted = source.emitted(s->point.ng, -s->wi);
    if (is_black(emitted)) return emitted;
    const Vec3 wi = vertex.frame.to_local(s->wi);
    const Spectrum f = vertex.bsdf.eval(vertex.wo, wi);
    if (is_black(f)) return f;
    ++rays_;
    if (scene_.bvh().occluded(vertex.point.spawn_ray_to(s->point))) return Spectrum::Zero();
    const Float pdf = pmf * s->pdf;
    const Float weight =
        options_.strategy == Strategy::mis ? power_weight(pdf, direction_pdf(vertex, wi, s->wi)) : Float(1);
    return f * emitted * (std::abs(wi.z()) * weight / pdf);
  }

  // Density with which scatter picks the direction wi (d in the world), where the strategy aims or follows the BSDF.
  Float direction_pdf(const Vertex& vertex, const Vec3& wi, const Vec3& d) const {
    const Float density = vertex.bsdf.pdf(vertex.wo, wi);
    return aim_.share > 0 ? (1 - aim_.share) * density + aim_.share * aim_pdf(scene_, aim_, vertex.point.p, d)
                          : density;
  }

  // The next direction; false where the path ends.
  template <class Stream> bool scatter(const Vertex& vertex, Walk& walk, Stream& stream) const {
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
        const auto target = sample_aim(scene_, aim_, point.p, u);
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

  const Scene& scene_;
  const PathOptions& options_;
  const Aim aim_;
  std::uint64_t& rays_;
};

} // namespace detail

/// Radiance that arrives along `ray`, one sample. `rays` counts the rays traced.
///   The background is met by following the BSDF only, in every strategy, and always counts fully.
///   Caustics cannot be reached by connecting to a light. Therefore `mis` aims a quarter of its directions at the
///   spheres of glass or mirror, where a scene has any: smallpt's box takes a quarter less time to a given error.
///   A path splits in two where it first meets a surface that is not a delta, since two fifths of the time but little
///   of the variance come from the way there and the light straight from the lights: a tenth to a fifth less time to a
///   given error, no less with three or four branches. Source: [ArvoKirk90]
///   Russian roulette: from the fourth edge on a path survives with four times the largest component of its throughput,
///                     corrected
///   for the compression of radiance in glass, at most .99. The factor balances variance against cost: at one the
///   Cornell box and smallpt's take about a third more time to a given error.
/// Times to a given error are measured as CPU seconds of `carlo render` times the relmse of `carlo compare` between two
/// seeds.
template <class Stream>
Spectrum trace_path(const Scene& scene, const Ray& ray, Stream& stream, const PathOptions& options,
                    std::uint64_t& rays) {
  return detail::Tracer(scene, options, rays).follow({ray, ray.o}, stream, true);
}

} // namespace render
