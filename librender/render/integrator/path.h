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
  mis         ///< nee and directions from the BSDF, some aimed at glass and mirrors, weighted by the power heuristic [Veach97]
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

} // namespace detail

/// Radiance that arrives along `ray`, one sample. `rays` counts the rays traced.
///   The background is met by following the BSDF only, in every strategy, and always counts fully.
///   Caustics cannot be reached by connecting to a light. Therefore `mis` aims a quarter of its directions at the spheres of
///   glass or mirror, where a scene has any: smallpt's box takes a quarter less time to a given error.
///   Russian roulette: from the fourth edge on a path survives with four times the largest component of its throughput, corrected
///   for the compression of radiance in glass, at most .99. The factor balances variance against cost: at one the Cornell box and
///   smallpt's take about a third more time to a given error.
template <class Stream>
Spectrum trace_path(const Scene& scene, Ray ray, Stream& stream, const PathOptions& options, std::uint64_t& rays) {
  const Strategy strategy = options.strategy;
  const bool connect = strategy == Strategy::nee || strategy == Strategy::mis;
  const detail::Aim aim = detail::aim_of(scene, strategy);
  Spectrum radiance = Spectrum::Zero(), beta = Spectrum::Ones();
  Float eta_scale = 1;
  Vec3 previous = ray.o;
  Float previous_pdf = 0; // of the last direction; 0: camera or delta lobe, which no light sampling could have chosen

  for (int edges = 1; options.max_depth < 0 || edges <= options.max_depth; ++edges) {
    ++rays;
    const auto hit = scene.bvh().intersect(ray);
    if (!hit) {
      if (scene.background) radiance += beta * scene.background->eval(ray.d);
      return radiance;
    }
    const auto shape_index = static_cast<std::size_t>(hit->shape);
    const Shape& shape = scene.shapes[shape_index];
    const SurfacePoint point = shape.surface_point(ray, *hit);

    if (const int light = scene.shape_light[shape_index]; light >= 0) {
      const Spectrum emitted = scene.lights[static_cast<std::size_t>(light)].emitted(point.ng, -ray.d);
      if (!is_black(emitted)) {
        Float weight = 1;
        if (connect && previous_pdf > 0)
          weight = strategy == Strategy::nee
                       ? Float(0)
                       : detail::power_weight(previous_pdf, scene.light_pmf(light) * shape.pdf(previous, ray.d, point));
        radiance += weight * beta * emitted;
      }
    }
    if (edges == options.max_depth) return radiance;

    const Bsdf& bsdf = scene.bsdfs[static_cast<std::size_t>(scene.shape_bsdf[shape_index])];
    const auto frame = mc::Frame<Float>::from_z(point.ns);
    const Vec3 wo = frame.to_local(-ray.d);
    const bool delta = bsdf.is_delta();
    const auto direction_pdf = [&](const Vec3& wi, const Vec3& d) {
      return aim.share > 0 ? (1 - aim.share) * bsdf.pdf(wo, wi) + aim.share * detail::aim_pdf(scene, aim, point.p, d) : bsdf.pdf(wo, wi);
    };

    if (connect && !delta && !scene.lights.empty()) {
      const auto [light, pmf] = scene.choose_light(scene.lights.size() > 1 ? stream.next() : Float(0));
      const AreaLight& source = scene.lights[static_cast<std::size_t>(light)];
      if (const auto s = scene.shapes[static_cast<std::size_t>(source.shape)].sample(point.p, stream.next2())) {
        const Spectrum emitted = source.emitted(s->point.ng, -s->wi);
        if (!is_black(emitted)) {
          const Vec3 wi = frame.to_local(s->wi);
          const Spectrum f = bsdf.eval(wo, wi);
          if (!is_black(f)) {
            ++rays;
            if (!scene.bvh().occluded(point.spawn_ray_to(s->point))) {
              const Float pdf = pmf * s->pdf;
              const Float weight = strategy == Strategy::mis ? detail::power_weight(pdf, direction_pdf(wi, s->wi)) : Float(1);
              radiance += beta * f * emitted * (std::abs(wi.z()) * weight / pdf);
            }
          }
        }
      }
    }

    // The next direction.
    Vec3 d, wi;
    if (strategy == Strategy::hemisphere && !delta) {
      wi = mc::UniformHemisphere<Float>{}.sample(stream.next2());
      if (wo.z() < 0) wi.z() = -wi.z();
      d = frame.to_world(wi);
      previous_pdf = 1 / (2 * mc::pi<Float>);
      beta *= bsdf.eval(wo, wi) * (std::abs(wi.z()) / previous_pdf);
    } else if (aim.share > 0 && !delta) {
      Vec2 u = stream.next2(); // u[0] also makes the choices, so that they are as well spread as the directions
      if (u[0] < aim.share) {
        u[0] = std::min(u[0] / aim.share, mc::one_minus_epsilon<Float>);
        const auto target = detail::sample_aim(scene, aim, point.p, u);
        if (!target) return radiance;
        d = *target;
        wi = frame.to_local(d);
      } else {
        u[0] = std::min((u[0] - aim.share) / (1 - aim.share), mc::one_minus_epsilon<Float>);
        const auto s = bsdf.sample(wo, stream.next(), u);
        if (!s) return radiance;
        wi = s->wi;
        d = frame.to_world(wi);
      }
      previous_pdf = direction_pdf(wi, d);
      if (!(previous_pdf > 0)) return radiance;
      beta *= bsdf.eval(wo, wi) * (std::abs(wi.z()) / previous_pdf);
    } else {
      const Float uc = stream.next();
      const auto s = bsdf.sample(wo, uc, stream.next2());
      if (!s) return radiance;
      wi = s->wi;
      d = frame.to_world(wi);
      beta *= s->f * (std::abs(wi.z()) / s->pdf);
      previous_pdf = s->delta ? Float(0) : s->pdf;
      if (s->transmission) {
        const auto& glass = std::get<Dielectric>(bsdf);
        eta_scale *= wo.z() > 0 ? mc::sqr(glass.eta) : 1 / mc::sqr(glass.eta);
      }
    }
    if (is_black(beta)) return radiance;
    if (!beta.isFinite().all()) [[unlikely]] return beta; // an invalid sample; roulette would end the path without a trace

    if (edges >= 4) {
      const Float survive = std::min(4 * beta.maxCoeff() * eta_scale, Float(0.99));
      if (!(stream.next() < survive)) return radiance;
      beta /= survive;
    }
    previous = point.p;
    ray = point.spawn_ray(d);
  }
  return radiance;
}

} // namespace render
