#pragma once
/// Light tracing: paths from the lights, connected to the camera.

#include <render/integrator/interaction.h>
#include <render/integrator/mis_weights.h>
#include <render/scene/visibility.h>

#include <mc/estimate/russian_roulette.h>
#include <mc/table/table_dist_1d.h>
#include <mc/warp/disk.h>

#include <optional>
#include <vector>

namespace render {

/// Traces the light paths of a strategy and evaluates their densities. Immutable, so threads can share it. Every vertex
/// of a light path but the first is connected to the camera (t = 1). The power heuristic combines three techniques:
/// camera paths that hit a light (s = 0), camera paths that connect to a light (s = 1) and light paths. Camera paths
/// rarely hit a small lamp behind glass or by way of a mirror, and each hit is bright. Light paths find such caustics
/// easily.
///   Direct : The first vertex is not connected. Camera paths find light by way of one surface with less noise, since
///            the number of light paths that land in a pixel is random.
///   Lights : chosen in proportion to their power, with a uniform third. Each samples the first ray of a path by its
///            emission, aimed at caustic bounds; see EmissionTargets.
///   Caustic bounds : balls around the shapes that focus light, at most 8. If there are more, the 7 largest stay and
///                    one ball encloses the others.
///   Paths  : follow the BSDFs, with Russian roulette; see docs/methods/russian-roulette.md.
///   Gain   : see docs/methods/light-tracing.md and notebooks-data/trade/scenes.csv.
///   Source : [Veach97] chapter 10, techniques s = 0, s = 1 and t = 1; section 5.3 for shading normals.
class LightTracer {
 public:
  /// Smallest number of edges of a light path, including the connection to the camera.
  static constexpr int min_edges = 3;

  /// Returns a light tracer, or nothing if light paths do not pay. This is so in any of these cases.
  ///   - The strategy has no light paths.
  ///   - No light of the scene can emit them.
  ///   - No surface casts caustics.
  ///   - Some medium scatters, or has an invisible boundary.
  ///   - The radius of the pixel filter exceeds SplatFilter::max_radius.
  ///   aspect : width / height of the film.
  static std::optional<LightTracer> create(const Scene& scene, const Strategy& strategy, Float aspect);

  /// Squared density of light paths that start at the light and travel along -wi to `ref`, per camera path; 0 for
  /// lights that emit no light paths.
  ///   light_point : point of the light; null for lights without a shape.
  ///   Measure     : see LightLike.
  double emission_pdf_squared(std::uint32_t light, const SurfacePoint* light_point, const Vec3& ref,
                              const Vec3& wi) const;

  /// Number of light paths per camera path.
  double light_path_rate() const { return light_path_rate_; }

  /// The camera.
  const ThinLens& camera() const { return scene_->camera(); }
  /// Density of the camera direction d for rays uniform over the whole film; see ThinLens::direction_pdf().
  double camera_pdf(const Vec3& d) const { return double(scene_->camera().direction_pdf(d, tan_half_)); }

  /// Direction sampling of the camera paths that are combined with these light paths.
  const DirectionMixture& camera_mixture() const { return camera_mixture_; }

  /// Traces one light path and calls add_splat(s, value) for each connection to the camera.
  ///   max_depth : largest number of edges, including the connection; -1 for no limit.
  ///   s         : film point as in ThinLens::ray; it may lie outside the film.
  ///   value     : radiance times the weight of the connection. For n light paths and a film of N pixels, sum(value) /
  ///               (n / (rate N)) estimates the radiance of a pixel, with rate = light_path_rate().
  ///   rays      : counts the rays traced.
  template <class Stream, class AddSplat>
  void trace(Stream& stream, int max_depth, std::uint64_t& rays, const AddSplat& add_splat) const;

 private:
  LightTracer(const Scene& scene, const Strategy& strategy, Float aspect, EmissionTargets targets,
              const std::vector<double>& weights);

  // As LightLike's pdf, but 1 for the only direction of a delta light.
  double direction_pdf(const Light& light, const Vec3& ref, const Vec3& wi, const SurfacePoint* light_point) const {
    return light.is_delta() ? 1 : double(light.pdf(ref, wi, light_point));
  }

  struct LightSubpath {
    Ray ray;
    Vec3 previous_point;
    Spectrum beta;     ///< Throughput without beta_scale.
    double beta_scale; ///< Factor in double: an inverse density may exceed the range of Float.
    PartialMisWeight partial_mis;
    MediumStack media = {};
    Float initial_beta_max = 0;    ///< Largest component of beta at emission.
    double nee_pdf_squared = 0;    ///< Squared density of next-event estimation at the first vertex [1/sr^2].
    bool from_delta_light = false; ///< The light cannot be hit.
    int edges = 0;
  };
  // Squared density [1/sr^2] with which a camera path scatters back along the light path, by a lobe that is not
  // near-specular. At the first vertex the squared density of next-event estimation is added, and hits count 0 for a
  // delta light.
  //   camera : the vertex as the camera path sees it.
  double pdf_rev_squared(const ShadingPoint<Bsdf>::Reverse& camera, const LightSubpath& subpath) const {
    const bool first = subpath.edges == 1;
    const double scatters = first && subpath.from_delta_light
                                ? 0
                                : mc::sqr(double(camera_mixture_.pdf(camera.at, camera.wi, -subpath.ray.d)));
    return first ? scatters + subpath.nee_pdf_squared : scatters;
  }
  template <class Stream, class AddSplat>
  void connect_to_camera(const Interaction<Bsdf>& isect, const LightSubpath& subpath, Stream& stream,
                         std::uint64_t& rays, const AddSplat& add_splat) const;
  template <class Stream> bool scatter(const Interaction<Bsdf>& isect, LightSubpath& subpath, Stream& stream) const;

  const Scene* scene_;
  double light_path_rate_;
  Vec2 tan_half_;
  mc::TableDist1D<Float> light_distribution_;
  EmissionTargets targets_; ///< Caustic bounds.
  DirectionMixture bsdf_mixture_, camera_mixture_;
};

/// The strategies that find every light of the scene. Leaves out mis+lt if it would equal mis.
std::vector<Strategy> complete_strategies(const Scene& scene);

template <class Stream, class AddSplat>
void LightTracer::trace(Stream& stream, int max_depth, std::uint64_t& rays, const AddSplat& add_splat) const {
  const Vec2 u = stream.next2();
  const auto choice = light_distribution_.sample_index(u[0]);
  const auto light = static_cast<std::uint32_t>(choice.index);
  const auto emission = scene_->lights()[light].sample_emission(targets_, {choice.u_remapped, u[1]}, stream.next2());
  if (!emission) return;
  const SurfacePoint* source = emission->point ? &*emission->point : nullptr;
  const double vertex_pdf = double(choice.pmf) * emission->vertex_pdf;
  LightSubpath subpath{emission->ray, source ? source->p : emission->ray.o, emission->radiance,
                       emission->cosine / (vertex_pdf * emission->ray_pdf),
                       PartialMisWeight(1 / mc::sqr(vertex_pdf), emission->ray_pdf, emission->cosine)};
  subpath.from_delta_light = scene_->lights()[light].is_delta();
  subpath.initial_beta_max = subpath.beta.maxCoeff();
  if (scene_->has_media()) [[unlikely]]
    subpath.media = initial_media(*scene_, subpath.ray);
  while (max_depth < 0 || subpath.edges + 1 < max_depth) {
    ++subpath.edges;
    const auto hit = sample_nearest_hit(*scene_, subpath.ray, stream, rays);
    if (!hit) return;
    const Surface& surface = scene_->surface(*hit);
    const SurfacePoint point = surface.shape->surface_point(subpath.ray, *hit);
    if (surface.absorbs(point, subpath.ray.d)) return;
    const bool from_afar = subpath.edges == 1 && !source;
    const double distance2 = (point.p - subpath.previous_point).template cast<double>().squaredNorm();
    if (subpath.media.current) [[unlikely]]
      subpath.beta *=
          subpath.media.current->transmittance(from_afar ? mc::infinity<Float> : Float(std::sqrt(distance2)));
    const double cosine = std::abs(double(point.ng.dot(subpath.ray.d)));
    if (subpath.edges == 1 && subpath.from_delta_light)
      subpath.partial_mis.add_vertex_from_point(cosine, from_afar ? 1 : distance2);
    else subpath.partial_mis.add_vertex(cosine, from_afar ? 1 : distance2);
    std::optional<Bsdf> varied;
    const Interaction<Bsdf> isect{
        {scene_->bsdf(surface, *hit, point, varied), point, -subpath.ray.d}, surface.interior.get(), subpath.media};
    if (subpath.edges == 1)
      subpath.nee_pdf_squared = mc::sqr(double(scene_->light_pmf(point.p, light)) *
                                        direction_pdf(scene_->lights()[light], point.p, -subpath.ray.d, source));
    if (subpath.edges > 1 && !isect.bsdf.lobes().is_near_specular())
      connect_to_camera(isect, subpath, stream, rays, add_splat);
    if (!scatter(isect, subpath, stream)) return;
  }
}

template <class Stream, class AddSplat>
void LightTracer::connect_to_camera(const Interaction<Bsdf>& isect, const LightSubpath& subpath, Stream& stream,
                                    std::uint64_t& rays, const AddSplat& add_splat) const {
  const ThinLens& camera = scene_->camera();
  const auto seen =
      camera.sample_wi(isect.point.p, tan_half_, camera.radius() > 0 ? stream.next2() : Vec2(Vec2::Zero()));
  if (!seen) return;
  const auto reverse = isect.reverse(isect.frame.to_local(seen->wi));
  const Spectrum f_cos = reverse.at.f_cos(reverse.wi);
  if (is_black(f_cos)) return;
  Ray ray = isect.point.spawn_ray(seen->wi);
  ray.t_max = seen->t_max;
  const Spectrum arriving = subpath.beta * transmittance(*scene_, ray, {}, seen->distance, isect.media(seen->wi), rays);
  if (is_black(arriving)) return;
  const double from_camera = double(seen->direction_pdf) * std::abs(double(isect.point.ng.dot(seen->wi))) /
                             mc::sqr(camera.spread(double(seen->distance)));
  const double mis_ratio =
      subpath.partial_mis.squared_ratio(pdf_rev_squared(reverse, subpath)) * mc::sqr(from_camera / light_path_rate_);
  const double arrival = std::abs(double(isect.point.ng.dot(subpath.ray.d)));
  add_splat(seen->s,
            Spectrum(arriving * f_cos *
                     Float(subpath.beta_scale * from_camera / (arrival * light_path_rate_ * (1 + mis_ratio)))));
}

template <class Stream>
bool LightTracer::scatter(const Interaction<Bsdf>& isect, LightSubpath& subpath, Stream& stream) const {
  const auto next = bsdf_mixture_.sample(isect, stream);
  if (!next) return false;
  const bool near_specular = next->pdf == 0;
  if (near_specular && !next->reversible) return false; // no camera path takes this step
  const Vec3 wi = isect.frame.to_local(next->d);
  const double arrival = std::abs(double(isect.point.ng.dot(subpath.ray.d)));
  const double cosine = std::abs(double(isect.point.ng.dot(next->d)));
  const auto reverse = isect.reverse(wi);
  // A near-specular lobe counts as a delta lobe. The exception is a lobe of positive width at the first vertex after a
  // delta light, since next-event estimation from the camera evaluates this lobe.
  const bool as_near_specular =
      near_specular && (subpath.edges > 1 || !subpath.from_delta_light || isect.bsdf.lobes().has_delta);
  Float pdf = next->pdf;
  if (near_specular) pdf = as_near_specular ? Float(1) : isect.pdf(wi);
  // Light travels from wo to wi, and BSDFs need not be reciprocal, so the directions are exchanged. Near-specular lobes
  // are reciprocal except for the compression of radiance in glass, which does not apply to light paths. Light arrives
  // with the cosine to the geometric normal, and f_cos has the cosine to the shading normal ([Veach97] section 5.3).
  const Spectrum f_cos_over_pdf = near_specular
                                      ? Spectrum(next->weight * (mc::sqr(next->eta) * std::abs(isect.wo.z() / wi.z())))
                                      : Spectrum(reverse.at.f_cos(reverse.wi) / next->pdf);
  subpath.beta *= f_cos_over_pdf * Float(cosine / arrival);
  if (is_black(subpath.beta)) return false;
  double pdf_rev2 = 0; // no camera path hits a delta light
  if (!as_near_specular) pdf_rev2 = pdf_rev_squared(reverse, subpath);
  else if (subpath.edges > 1 || !subpath.from_delta_light)
    pdf_rev2 = mc::sqr(near_specular_reverse_pdf(isect.wo, wi, next->eta));
  subpath.partial_mis.scatter(pdf_rev2, double(pdf), cosine);
  if (subpath.edges >= 4) {
    const Float survival = std::clamp(4 * subpath.beta.maxCoeff() / subpath.initial_beta_max,
                                      std::numeric_limits<Float>::min(), Float(0.99));
    const auto roulette = mc::russian_roulette<Float>(survival, stream.next());
    if (!roulette.survives) return false;
    subpath.beta *= roulette.weight;
  }
  subpath.previous_point = isect.point.p;
  subpath.ray = isect.point.spawn_ray(next->d);
  subpath.media = isect.media(next->d);
  return true;
}

} // namespace render
