#pragma once
/// Paths from the lights, connected to the camera.

#include <render/integrator/medium_stack.h>
#include <render/integrator/mis_weights.h>
#include <render/scene/visibility.h>

#include <mc/estimate/russian_roulette.h>
#include <mc/table/table_dist_1d.h>
#include <mc/warp/disk.h>

#include <optional>
#include <vector>

namespace render {

/// Light paths of a strategy, and how dense they are. Immutable, so threads share it.
///   Path tracing hardly finds the light that glass or a mirror throws onto what is seen: where a path meets them by
/// chance, and the lamp behind, all of it arrives at once. From the lamp it is found easily. Each vertex of a path from
/// a light but the first is connected to the camera, and all three ways to find the same path, by chance, by a
/// connection to the light and by one to the camera, are weighed by the power heuristic.
///   Direct : light by way of one surface is left to paths from the camera, whose connections hardly err there, while
///            how many paths happen to arrive in a pixel does
///   Lights : chosen by their power, a third of the time all alike. Of shapes that shine a point uniform in area and a
///            direction by the cosine, of points any direction; four in five of these are aimed at balls around what
///            casts caustics, but for those that a lamp reaches into. Of environment maps and directional lights, for
///            these balls alone, a direction as the light samples it and a point of a ball's disk across it. Of more
///            than eight balls the seven largest stay, the others are one
///   Paths  : follow the BSDFs; Russian roulette as of PathIntegrator
///   Gain   : with an eighth as many as paths from the camera a picture takes .12 (book3-cornell-aluminium), .32
///            (book3-cornell-glass), .41 (smallpt), .52 (metals), .57 (ground-glass), .70 (blinn-phong), .75
///            (textures), .76 (materials), .83 (tinted-glass) and 1.0 (veach-mi) of the time of `mis` to a given error;
///            a tenth or a fifth as many change that by up to a tenth, two fifths cost up to a fifth more. A ball of
///            metal under a lamp of a fiftieth, a ninth or a third of its distance, with a fifth: .13, .17 and .64 at
///            alpha .1, .41, .48 and .86 at .2, .9 to 1.2 at .3; at a fuzz of .3, .5 and .8 .25 to .70, .60 to .83 and
///            1.1 to 1.2. CPU seconds times the variance of six seeds
///   Source : [Veach97] chapter 10, of whose connections these are those at both ends; light through shading normals
///            section 5.3
class LightTracer {
 public:
  static constexpr int min_edges = 3; ///< of the paths that they find

  /// None where the strategy has none, or the scene no light that they start from, or nothing narrow or transparent:
  /// elsewhere they would cost more than they bring. None either where the filter is wider than SplatFilter can share.
  ///   aspect : width / height of the film
  static std::optional<LightTracer> create(const Scene& scene, const Strategy& strategy, Float aspect);

  /// Of paths that start from where the direction wi from `ref` meets a light, back along it, per path from the camera:
  /// the squared density [1/sr] times that per area, of the light's point `light_point`, or of lines along wi across it where
  /// they start at one point or at infinity (null); 0 for lights that none starts from.
  double emission_pdf_squared(std::uint32_t light, const SurfacePoint* light_point, const Vec3& ref,
                              const Vec3& wi) const;

  /// Per path from the camera.
  double light_path_rate() const { return light_path_rate_; }

  /// Density of the direction d from the camera [1/sr], in paths over the whole film.
  double camera_pdf(const Vec3& d) const { return double(scene_->camera().direction_pdf(d, tan_half_)); }

  /// The choice of directions of the paths from the camera beside them.
  const DirectionMixture& camera_mixture() const { return camera_mixture_; }

  /// Traces one path of at most max_depth edges to the camera (-1: no limit): give(s, value) for each of its
  /// connections, where s is the point of the film, as of ThinLens::ray, or one beside it, and value what it counts of
  /// the radiance there: of n paths over a film of N pixels, sum(value) / (n / (rate N)) is the radiance of a pixel.
  template <class Stream, class AddSplat>
  void trace(Stream& stream, int max_depth, std::uint64_t& rays, const AddSplat& add_splat) const;

  LightTracer(LightTracer&&) = default; // targets_ are of casters_
  LightTracer& operator=(LightTracer&&) = default;

 private:
  LightTracer(const Scene& scene, const Strategy& strategy, Float aspect, std::vector<Shape> caustic_bounds,
              const std::vector<double>& weights);

  struct EmissionSample {
    Ray ray;
    std::optional<SurfacePoint> point; ///< of the light, with the normals of the side that shines; none: infinitely far
    Spectrum beta = Spectrum::Zero();  ///< light that the path carries, of the unit `area`
    double beta_scale = 0;             ///< over the density, which no float need hold
    PartialMisWeight partial_mis = {};
  };
  template <class Stream>
  std::optional<EmissionSample> sample_emission(std::uint32_t light, const Vec2& u, Stream& stream) const;
  template <class Stream>
  std::optional<EmissionSample> sample_area_emission(const AreaLight& lamp, double pmf, const Vec2& u,
                                                     Stream& stream) const;
  std::optional<EmissionSample> sample_point_emission(const PointLight& lamp, double pmf, const Vec2& u) const;
  template <class Stream>
  std::optional<EmissionSample> sample_infinite_emission(const Light& light, double pmf, const Vec2& u,
                                                         Stream& stream) const;
  // Of directions from a point [1/sr]: for a direction aimed at one of the balls, this one says its own density.
  struct TargetedDirection {
    std::size_t target;
    Float pdf;
  };
  double point_emission_pdf(const Vec3& p, const Vec3& d, const std::optional<TargetedDirection>& targeted = {}) const;
  // As LightLike's pdf; of the one direction of a delta light 1.
  double direction_pdf(const Light& light, const Vec3& ref, const Vec3& wi, const SurfacePoint* light_point) const {
    return light.is_delta() ? 1 : double(light.pdf(ref, wi, light_point));
  }
  // Per area across the line through p along d.
  double parallel_emission_pdf(const Vec3& p, const Vec3& d) const;

  struct LightSubpath {
    Ray ray;
    Vec3 previous_point;
    Spectrum beta;
    double beta_scale;
    PartialMisWeight partial_mis;
    MediumStack media = {};
    Float initial_beta_max = 0;    ///< the largest component of beta at first
    double nee_pdf_squared = 0;    ///< squared density of the connection from the first vertex to the light [1/sr^2]
    bool from_delta_light = false; ///< the light is not met by chance
    int edges = 0;
  };
  // Density of paths from the camera that go on from `isect`, where they come from wi, by chance the way that this came.
  template <class B>
  double camera_pdf_rev(const ShadingPoint<B>& isect, const LightSubpath& subpath, const Vec3& wi, bool near_specular,
                        Float eta) const {
    if (near_specular) return reverse_pdf(isect.bsdf, isect.wo, wi, near_specular, eta);
    return double(
        camera_mixture_.pdf(ShadingPoint<B>{isect.bsdf, isect.point, isect.frame, wi}, isect.wo, -subpath.ray.d));
  }
  // Squared, with that of a connection.
  template <class B>
  double pdf_rev_squared(const ShadingPoint<B>& isect, const LightSubpath& subpath, const Vec3& wi, bool near_specular,
                         Float eta) const {
    const bool first = subpath.edges == 1;
    const double bsdf_pdf_squared =
        first && subpath.from_delta_light ? 0 : mc::sqr(camera_pdf_rev(isect, subpath, wi, near_specular, eta));
    return first && !near_specular ? bsdf_pdf_squared + subpath.nee_pdf_squared : bsdf_pdf_squared;
  }
  // Light meets a surface by its true cosine, and the BSDF reckons with that of the shading normal.
  template <class B> static Float shading_normal_correction(const ShadingPoint<B>& isect) {
    if (isect.point.ns == isect.point.ng) return 1;
    return std::abs(isect.wo.z() / isect.frame.to_world(isect.wo).dot(isect.point.ng));
  }
  template <class Stream, class AddSplat>
  void connect_to_camera(const SurfaceInteraction<Bsdf>& isect, const LightSubpath& subpath, Stream& stream,
                         std::uint64_t& rays, const AddSplat& add_splat) const;
  template <class Stream>
  bool scatter(const SurfaceInteraction<Bsdf>& isect, LightSubpath& subpath, Stream& stream) const;

  const Scene* scene_;
  double light_path_rate_;
  Vec2 tan_half_;
  mc::TableDist1D<Float> light_distribution_;
  std::vector<Shape> caustic_bounds_;         ///< balls that paths from infinite lights are aimed at
  std::vector<const Shape*> targeted_bounds_; ///< those of them that paths from the others are aimed at
  DirectionMixture emission_mixture_, bsdf_mixture_, camera_mixture_;
  mc::Bernoulli<Float> guiding_choice_; ///< of paths from points
  bool has_media_;                      ///< some surface holds a medium
  Bsdf emission_bsdf_;                  ///< as whose reflection a lamp's light leaves it
};

/// The strategies that find every light of the scene, each once: without mis+lt where it is mis.
std::vector<Strategy> complete_strategies(const Scene& scene);

template <class Stream>
std::optional<LightTracer::EmissionSample> LightTracer::sample_area_emission(const AreaLight& lamp, double pmf,
                                                                             const Vec2& u, Stream& stream) const {
  auto point = lamp.shape().sample_area(u);
  if (!point) return {};
  if (lamp.is_two_sided() && mc::Bernoulli<Float>(Float(0.5)).sample_index(stream.next()).index == 1)
    point->ng = -point->ng;
  point->ns = point->ng;
  const auto frame = mc::Frame<Float>::from_z(point->ng);
  const auto next = emission_mixture_.sample(ShadingPoint<Bsdf>{emission_bsdf_, *point, frame, Vec3::UnitZ()}, stream);
  if (!next || is_black(next->weight)) return {};
  const double sides = lamp.is_two_sided() ? 2 : 1, area_pdf = pmf / lamp.shape().area();
  return EmissionSample{
      point->spawn_ray(next->d), point, lamp.radiance() * next->weight, mc::pi<double> * sides / area_pdf,
      PartialMisWeight(1 / mc::sqr(area_pdf), double(next->pdf) / sides, std::abs(double(point->ng.dot(next->d))))};
}

template <class Stream>
std::optional<LightTracer::EmissionSample> LightTracer::sample_infinite_emission(const Light& light, double pmf,
                                                                                 const Vec2& u, Stream& stream) const {
  const auto s = light.sample(Vec3::Zero(), u);
  if (!s || is_black(s->radiance)) return {};
  const std::size_t target = mc::UniformDiscrete<Float>(caustic_bounds_.size()).sample_index(stream.next()).index;
  const Sphere& aim = std::get<Sphere>(caustic_bounds_[target]);
  const Vec2 disk = mc::UniformDisk<Float>{}.sample(stream.next2());
  const Vec3d wi = s->wi.template cast<double>();
  const Vec3d across_ball = mc::Frame<Float>::from_z(s->wi).to_world({disk[0], disk[1], 0}).template cast<double>();
  const Vec3d crossing = aim.center() + aim.radius() * across_ball;
  // No further away than before all that may shade the ball: a float resolves little of one beside a huge ground.
  const Vec3 p = (crossing + (scene_->bounds().exit_distance(crossing, wi) + aim.radius()) * wi).template cast<Float>();
  const double pdf = pmf * double(s->pdf), area_pdf = parallel_emission_pdf(p, s->wi);
  if (!(area_pdf > 0)) return {}; // rounding
  return EmissionSample{
      {p, -s->wi}, {}, s->radiance / Float(pdf), 1 / area_pdf, PartialMisWeight(1 / mc::sqr(pdf), area_pdf, 1)};
}

template <class Stream>
std::optional<LightTracer::EmissionSample> LightTracer::sample_emission(std::uint32_t light, const Vec2& u,
                                                                        Stream& stream) const {
  const auto pmf = double(light_distribution_.pmf(light));
  const Light& source = scene_->lights()[light];
  if (const auto* lamp = std::get_if<AreaLight>(&source)) return sample_area_emission(*lamp, pmf, u, stream);
  if (const auto* lamp = std::get_if<PointLight>(&source)) return sample_point_emission(*lamp, pmf, u);
  return sample_infinite_emission(source, pmf, u, stream);
}

template <class Stream, class AddSplat>
void LightTracer::trace(Stream& stream, int max_depth, std::uint64_t& rays, const AddSplat& add_splat) const {
  const Vec2 u = stream.next2();
  const auto choice = light_distribution_.sample_index(u[0]);
  const auto light = static_cast<std::uint32_t>(choice.index);
  const auto emission = sample_emission(light, {choice.u_remapped, u[1]}, stream);
  if (!emission) return;
  const SurfacePoint* source = emission->point ? &*emission->point : nullptr;
  LightSubpath subpath{emission->ray, source ? source->p : emission->ray.o, emission->beta, emission->beta_scale,
                       emission->partial_mis};
  subpath.from_delta_light = scene_->lights()[light].is_delta();
  subpath.initial_beta_max = subpath.beta.maxCoeff();
  if (has_media_) [[unlikely]]
    subpath.media = initial_media(*scene_, subpath.ray);
  while (max_depth < 0 || subpath.edges + 1 < max_depth) {
    ++subpath.edges;
    const auto hit = nearest_hit(*scene_, subpath.ray, rays, [&](Float opacity) {
      return opacity == 0 || mc::Bernoulli<Float>(opacity).sample_index(stream.next()).index == 0;
    });
    if (!hit) return;
    const Surface& surface = scene_->surface(*hit);
    const SurfacePoint point = surface.shape->surface_point(subpath.ray, *hit);
    const bool from_afar = subpath.edges == 1 && !source;
    const double distance2 = (point.p - subpath.previous_point).template cast<double>().squaredNorm();
    if (subpath.media.current) [[unlikely]]
      subpath.beta *=
          subpath.media.current->transmittance(from_afar ? mc::infinity<Float> : Float(std::sqrt(distance2)));
    const double cosine = std::abs(double(point.ng.dot(subpath.ray.d)));
    if (subpath.edges == 1 && subpath.from_delta_light)
      subpath.partial_mis.add_vertex_from_point(cosine, from_afar ? 1 : distance2);
    else subpath.partial_mis.add_vertex(cosine, from_afar ? 1 : distance2);
    const auto frame = mc::Frame<Float>::from_z(point.ns);
    std::optional<Bsdf> varied;
    const SurfaceInteraction<Bsdf> isect{
        {scene_->bsdf(surface, *hit, point, varied), point, frame, frame.to_local(-subpath.ray.d)},
        surface,
        subpath.media};
    if (subpath.edges == 1)
      subpath.nee_pdf_squared = mc::sqr(double(scene_->light_pmf(point.p, light)) *
                                        direction_pdf(scene_->lights()[light], point.p, -subpath.ray.d, source));
    if (subpath.edges > 1 && !isect.bsdf.is_near_specular()) connect_to_camera(isect, subpath, stream, rays, add_splat);
    if (!scatter(isect, subpath, stream)) return;
  }
}

template <class Stream, class AddSplat>
void LightTracer::connect_to_camera(const SurfaceInteraction<Bsdf>& isect, const LightSubpath& subpath, Stream& stream,
                                    std::uint64_t& rays, const AddSplat& add_splat) const {
  const ThinLens& camera = scene_->camera();
  const auto seen =
      camera.sample_wi(isect.point.p, tan_half_, camera.radius() > 0 ? stream.next2() : Vec2(Vec2::Zero()));
  if (!seen) return;
  const Vec3 wi = isect.frame.to_local(seen->wi);
  if (!same_geometric_side(isect, wi, seen->wi)) return;
  const Spectrum f = isect.bsdf.eval(wi, isect.wo);
  if (is_black(f)) return;
  Ray ray = isect.point.spawn_ray(seen->wi);
  ray.t_max = seen->t_max;
  const Float transmittance = shadow_transmittance(*scene_, ray, {}, rays);
  if (transmittance == 0) return;
  const double from_camera =
      double(seen->direction_pdf) * std::abs(double(isect.point.ng.dot(seen->wi))) / mc::sqr(double(seen->distance));
  const double mis_ratio = subpath.partial_mis.squared_ratio(pdf_rev_squared(isect, subpath, wi, false, 1)) *
                           mc::sqr(from_camera / light_path_rate_);
  Spectrum value = transmittance * subpath.beta * f;
  if (const HomogeneousMedium* medium = isect.media(seen->wi).current) [[unlikely]]
    value *= medium->transmittance(seen->distance);
  add_splat(seen->s, Spectrum(value * Float(subpath.beta_scale * from_camera / (light_path_rate_ * (1 + mis_ratio))) *
                              shading_normal_correction(isect)));
}

template <class Stream>
bool LightTracer::scatter(const SurfaceInteraction<Bsdf>& isect, LightSubpath& subpath, Stream& stream) const {
  const auto next = bsdf_mixture_.sample(isect, stream);
  if (!next) return false;
  const bool near_specular = next->pdf == 0;
  const Vec3 wi = isect.frame.to_local(next->d);
  const double cosine = std::abs(double(isect.point.ng.dot(next->d)));
  // A connection to a light that no chance meets may use what chance follows as a narrow lobe.
  const bool as_near_specular =
      near_specular && (subpath.edges > 1 || !subpath.from_delta_light || isect.bsdf.has_delta());
  Float pdf = next->pdf;
  if (near_specular) pdf = as_near_specular ? Float(1) : isect.bsdf.pdf(isect.wo, wi);
  // Light goes from wo to wi, and not all BSDFs are reciprocal; those of narrow lobes are but for the compression in
  // glass, which does not change what a path carries.
  const Spectrum weight = near_specular ? Spectrum(next->weight * (mc::sqr(next->eta) / std::abs(wi.z())))
                                        : Spectrum(isect.bsdf.eval(wi, isect.wo) / next->pdf);
  subpath.beta *= weight * (shading_normal_correction(isect) * Float(cosine));
  if (is_black(subpath.beta)) return false;
  subpath.partial_mis.scatter(pdf_rev_squared(isect, subpath, wi, as_near_specular, next->eta), double(pdf), cosine);
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
