#pragma once
/// Path tracing from the camera, by any of the strategies of the books.

#include <render/integrator/path_stream.h>
#include <render/scene/scene.h>

#include <mc/core/frame.h>
#include <mc/warp/hemisphere.h>

#include <string_view>

namespace render {

/// How directions are chosen where the BSDF is not a delta. All but `light` are unbiased.
enum class Strategy {
  bsdf,       ///< by the BSDF; lights are met by chance
  hemisphere, ///< uniform in the hemisphere
  light,      ///< toward the lights only, as in [Shirley16] chapter 7: misses all light that other surfaces reflect
  mixture,    ///< one direction from the equal mixture of lights (and guides) and BSDF, as in [Shirley16] chapter 8
  nee,        ///< next event estimation: a point of a light at every vertex, lights met by chance do not count
  mis         ///< nee and BSDF sampling weighted by the power heuristic [Veach97]
};

/// Throws Error, naming the nearest strategy, for an unknown name.
Strategy strategy_from(std::string_view name);
std::string_view name(Strategy strategy);

struct PathOptions {
  Strategy strategy = Strategy::mis;
  int max_depth = -1; ///< longest path in edges (1: light seen directly); -1: no limit
};

namespace detail {

/// Density [1/sr] with which directions are chosen from p toward lights and guides, each equally likely.
inline Float target_pdf(const Scene& scene, const Vec3& p, const Vec3& wi) {
  Float sum = 0;
  for (const AreaLight& light : scene.lights) sum += scene.shapes[static_cast<std::size_t>(light.shape)].pdf(p, wi);
  for (const int guide : scene.guides) sum += scene.shapes[static_cast<std::size_t>(guide)].pdf(p, wi);
  return sum / Float(scene.lights.size() + scene.guides.size());
}

inline std::optional<Vec3> sample_target(const Scene& scene, const Vec3& p, Float uc, const Vec2& u) {
  const std::size_t n = scene.lights.size() + scene.guides.size();
  const std::size_t i = std::min(static_cast<std::size_t>(uc * Float(n)), n - 1);
  const int shape = i < scene.lights.size() ? scene.lights[i].shape : scene.guides[i - scene.lights.size()];
  const auto s = scene.shapes[static_cast<std::size_t>(shape)].sample(p, u);
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
///   Russian roulette: from the fourth edge on a path survives with the square root of the largest component of its throughput,
///   corrected for the compression of radiance in glass, at most .95. The root balances variance against cost: on the Cornell box
///   it takes 15 % less time to a given error than the throughput itself.
template <class Stream>
Spectrum trace_path(const Scene& scene, Ray ray, Stream& stream, const PathOptions& options, std::uint64_t& rays) {
  const Strategy strategy = options.strategy;
  const bool connect = strategy == Strategy::nee || strategy == Strategy::mis;
  const bool aim = !scene.lights.empty() || !scene.guides.empty();
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
              const Float weight = strategy == Strategy::mis ? detail::power_weight(pdf, bsdf.pdf(wo, wi)) : Float(1);
              radiance += beta * f * emitted * (std::abs(wi.z()) * weight / pdf);
            }
          }
        }
      }
    }

    // The next direction.
    Vec3 d, wi;
    if (delta || !aim || strategy == Strategy::bsdf || connect) {
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
    } else if (strategy == Strategy::hemisphere) {
      wi = mc::UniformHemisphere<Float>{}.sample(stream.next2());
      if (wo.z() < 0) wi.z() = -wi.z();
      d = frame.to_world(wi);
      previous_pdf = 1 / (2 * mc::pi<Float>);
      beta *= bsdf.eval(wo, wi) * (std::abs(wi.z()) / previous_pdf);
    } else {
      const Float share = strategy == Strategy::mixture ? Float(0.5) : Float(1); // of directions aimed at targets
      const Float uc = stream.next(), which = stream.next();
      const Vec2 u = stream.next2();
      if (uc < share) {
        const auto target = detail::sample_target(scene, point.p, which, u);
        if (!target) return radiance;
        d = *target;
        wi = frame.to_local(d);
      } else {
        const auto s = bsdf.sample(wo, which, u);
        if (!s) return radiance;
        wi = s->wi;
        d = frame.to_world(wi);
      }
      previous_pdf = share * detail::target_pdf(scene, point.p, d) + (1 - share) * bsdf.pdf(wo, wi);
      if (!(previous_pdf > 0)) return radiance;
      beta *= bsdf.eval(wo, wi) * (std::abs(wi.z()) / previous_pdf);
    }
    if (is_black(beta)) return radiance;
    if (!beta.isFinite().all()) [[unlikely]] return beta; // an invalid sample; roulette would end the path without a trace

    if (edges >= 4) {
      const Float survive = std::min(std::sqrt(beta.maxCoeff() * eta_scale), Float(0.95));
      if (!(stream.next() < survive)) return radiance;
      beta /= survive;
    }
    previous = point.p;
    ray = point.spawn_ray(d);
  }
  return radiance;
}

} // namespace render
