#pragma once
/// What a path from the camera does, edge by edge.

#include <render/integrator/light_tracer.h>

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
struct RadianceContribution {
  Spectrum value;       ///< that counts if no path from the lights could have found it
  double mis_ratio = 0; ///< that one did

  Spectrum weighted() const { return mis_ratio == 0 ? value : Spectrum(value * Float(1 / (1 + mis_ratio))); }
};

/// A path under way.
struct PathState {
  Ray ray;                          ///< to trace next
  Vec3 previous_point;              ///< where it comes from
  Spectrum beta = Spectrum::Ones(); ///< what light found along it counts
  Float previous_pdf = 0; ///< of its direction; 0: camera or narrow lobe, which no light sampling could have chosen
  Float eta_scale = 1;    ///< times beta: what roulette goes by. Undoes the compression of radiance in glass
  Float guiding_pdf_ratio = 1; ///< density of its way since the last rough surface over that of following BSDFs alone
  int edges = 0;               ///< traced so far
  MediumStack media = {};      ///< that the ray goes through
  PartialMisWeight partial_mis = {}; ///< of the paths from the lights
};

/// The steps of paths through a scene, which must outlive it; what they are by is said at PathIntegrator.
template <class SceneType> class PathSteps {
 public:
  using BsdfType = std::remove_cvref_t<decltype(std::declval<SceneType>().bsdf(std::declval<Surface>()))>;
  using Interaction = SurfaceInteraction<BsdfType>;

  /// Where a path meets a surface. It stays where it is: its BSDF may be made in it.
  struct PathVertex {
    PathVertex() = default;
    PathVertex(const PathVertex&) = delete;
    PathVertex& operator=(const PathVertex&) = delete;

    SurfacePoint point;
    const Surface* surface = nullptr;
    const BsdfType* bsdf = nullptr;
    std::optional<Bsdf> bsdf_storage; ///< of the BSDF where a texture varies it

    Interaction interaction(const PathState& state) const {
      const auto frame = mc::Frame<Float>::from_z(point.ns);
      return {{*bsdf, point, frame, frame.to_local(-state.ray.d)}, *surface, state.media};
    }
  };

  /// light_tracer : that find some of the light; null: none are traced. It must outlive this, too
  PathSteps(const SceneType& scene, const Strategy& strategy, int max_depth, const LightTracer* light_tracer)
      : scene_(scene), strategy_(strategy), max_depth_(max_depth),
        direction_mixture_(light_tracer ? light_tracer->camera_mixture() : DirectionMixture(scene, strategy)),
        light_tracer_(light_tracer) {}

  const SceneType& scene() const { return scene_; }
  const DirectionMixture& direction_mixture() const { return direction_mixture_; }

  /// A path that starts by a ray of the camera.
  ///   media : through what the ray starts
  PathState start_path(const Ray& ray, const MediumStack& media) const {
    PathState state{ray, ray.o};
    state.media = media;
    if (light_tracer_) [[unlikely]]
      state.partial_mis = PartialMisWeight(1, light_tracer_->camera_pdf(ray.d), 0);
    if (media.current || light_tracer_) [[unlikely]] // it fills what is cut away before the lens, too
      state.previous_point -= scene_.camera().near() / ray.d.dot(scene_.camera().forward()) * ray.d;
    return state;
  }

  /// The nearest surface that a ray meets. See visibility.h: a mask is there or not, as chance has it.
  template <class Stream> std::optional<Hit> nearest_hit(Ray& ray, Stream& stream, std::uint64_t& rays) const {
    return render::nearest_hit(scene_, ray, rays, [&](Float opacity) {
      return opacity == 0 || mc::Bernoulli<Float>(opacity).sample_index(stream.next()).index == 0;
    });
  }

  /// One edge of a path, to the place where it meets a surface; `add_radiance` is given the light at its end. False where the
  /// path ends there.
  template <class Stream, class AddRadiance>
  bool intersect_next(PathState& state, PathVertex& vertex, Stream& stream, std::uint64_t& rays,
                      const AddRadiance& add_radiance) const {
    if (state.edges == max_depth_) return false;
    if (!state.beta.isFinite().all()) [[unlikely]] {
      add_radiance(RadianceContribution{state.beta}); // an invalid sample
      return false;
    }
    ++state.edges;
    const auto hit = nearest_hit(state.ray, stream, rays);
    if (!hit) {
      if (state.media.current) [[unlikely]]
        state.beta *= state.media.current->transmittance(mc::infinity<Float>);
      if (light_tracer_) [[unlikely]]
        state.partial_mis.add_vertex(1, 1); // a direction of the light
      for (const std::uint32_t light : scene_.infinite_lights())
        add_radiance(emitted_contribution(light, nullptr, state));
      return false;
    }
    vertex.surface = &scene_.surface(*hit);
    vertex.point = vertex.surface->shape->surface_point(state.ray, *hit);
    if (state.media.current) [[unlikely]]
      state.beta *= state.media.current->transmittance((vertex.point.p - state.previous_point).norm());
    if (light_tracer_) [[unlikely]]
      update_partial_mis(vertex.point, state);
    if (vertex.surface->light) add_radiance(emitted_contribution(*vertex.surface->light, &vertex.point, state));
    if (state.edges == max_depth_) return false;
    vertex.bsdf = &scene_.bsdf(*vertex.surface, *hit, vertex.point, vertex.bsdf_storage);
    return true;
  }

  /// Follows a path to where it first meets a surface that is not a delta. False where it ends before.
  template <class Stream, class AddRadiance>
  bool skip_delta_bounces(PathState& state, PathVertex& vertex, Stream& stream, std::uint64_t& rays,
                          const AddRadiance& add_radiance) const {
    while (intersect_next(state, vertex, stream, rays, add_radiance)) {
      if (!vertex.bsdf->is_delta()) return true;
      if (!scatter(vertex.interaction(state), state, stream)) return false;
    }
    return false;
  }

  /// Gives `add_radiance` the light that is found along the rest of a path.
  template <class Stream, class AddRadiance>
  void trace_remaining(PathState& state, Stream& stream, std::uint64_t& rays, const AddRadiance& add_radiance) const {
    PathVertex vertex;
    while (intersect_next(state, vertex, stream, rays, add_radiance)) {
      if (!shade_and_scatter(vertex.interaction(state), state, stream, rays, add_radiance)) return;
    }
  }

  /// Light straight from the lights to where a path is, and its next direction; false where the path ends.
  template <class Stream, class AddRadiance>
  bool shade_and_scatter(const Interaction& isect, PathState& state, Stream& stream, std::uint64_t& rays,
                         const AddRadiance& add_radiance) const {
    if (!isect.bsdf.is_delta()) sample_direct(isect, state, stream, rays, add_radiance);
    return scatter(isect, state, stream);
  }

  /// Light straight from the lights to where a path is.
  template <class Stream, class AddRadiance>
  void sample_direct(const Interaction& isect, const PathState& state, Stream& stream, std::uint64_t& rays,
                     const AddRadiance& add_radiance) const {
    if (!uses_nee() || !scene_.has_light_sampler()) return;
    RadianceContribution light = direct_contribution(isect, state, stream, rays);
    light.value *= state.beta;
    add_radiance(light);
  }

  /// The next direction, if the path goes on.
  template <class Stream> bool scatter(const Interaction& isect, PathState& state, Stream& stream) const {
    return sample_bsdf(isect, state, stream) && russian_roulette(state, stream);
  }

  /// The next direction; false where the path is absorbed.
  template <class Stream>
  RENDER_FLAT bool sample_bsdf(const Interaction& isect, PathState& state, Stream& stream) const {
    const auto next = direction_mixture_.sample(isect, stream);
    if (!next) return false;
    state.beta *= next->weight;
    state.previous_pdf = next->pdf;
    state.eta_scale *= mc::sqr(next->eta);
    state.guiding_pdf_ratio =
        next->pdf > 0 ? next->guiding_pdf_ratio : state.guiding_pdf_ratio * next->guiding_pdf_ratio;
    if (is_black(state.beta)) return false;
    if (light_tracer_) [[unlikely]] {
      const bool near_specular = next->pdf == 0;
      state.partial_mis.scatter(pdf_rev_squared(isect, state, isect.frame.to_local(next->d), near_specular, next->eta),
                                near_specular ? 1 : double(next->pdf), std::abs(double(isect.point.ng.dot(next->d))));
    }
    state.previous_point = isect.point.p;
    state.ray = isect.point.spawn_ray(next->d);
    state.media = isect.media(next->d);
    return true;
  }

  /// The odds of paths from the lights where a path, at `isect`, would come to `next` by the direction d of density `pdf`
  /// [1/sr] if it looks the same from everywhere: but for a factor that does not depend on where it came from. 0 where
  /// there are none.
  double mis_ratio_at(const SurfacePoint& next, const Interaction& isect, const PathState& state, const Vec3& d,
                      Float pdf) const {
    if (!light_tracer_) [[likely]]
      return 0;
    PartialMisWeight partial_mis = state.partial_mis;
    partial_mis.scatter(pdf_rev_squared(isect, state, isect.frame.to_local(d), false, 1), double(pdf),
                        std::abs(double(isect.point.ng.dot(d))));
    partial_mis.add_vertex(std::abs(double(next.ng.dot(d))),
                           (next.p - isect.point.p).template cast<double>().squaredNorm());
    return partial_mis.squared_ratio(mc::sqr(double(next.ns.dot(d))));
  }

  /// Whether a path survives Russian roulette.
  template <class Stream> static bool russian_roulette(PathState& state, Stream& stream) {
    if (state.edges < 4 || !state.beta.isFinite().all())
      return true; // of an invalid path roulette would leave no trace
    const Float survival =
        std::clamp(std::max(Float(4), state.guiding_pdf_ratio) * state.beta.maxCoeff() * state.eta_scale,
                   std::numeric_limits<Float>::min(), Float(0.99));
    const auto roulette = mc::russian_roulette<Float>(survival, stream.next());
    state.beta *= roulette.weight;
    return roulette.survives;
  }

 private:
  bool uses_nee() const { return strategy_.direct_lighting != DirectLighting::bsdf_only; }

  // Light that what was met itself sends back along the path.
  RadianceContribution emitted_contribution(std::uint32_t light, const SurfacePoint* light_point,
                                            const PathState& state) const {
    const Light& source = scene_.lights()[light];
    const Spectrum Le = source.Le(state.ray.d, light_point);
    if (is_black(Le) || !uses_nee() || !source.is_sampled()) return {state.beta * Le};
    Float weight = 1;
    if (state.previous_pdf > 0) {
      if (strategy_.direct_lighting == DirectLighting::nee) return {Spectrum::Zero()};
      const Float other =
          scene_.light_pmf(state.previous_point, light) * source.pdf(state.previous_point, state.ray.d, light_point);
      weight = mc::power_heuristic(state.previous_pdf, other);
    }
    RadianceContribution contribution{state.beta * (Le * weight)};
    if (light_tracer_ && state.edges > 2) [[unlikely]]
      contribution.mis_ratio = double(weight) * state.partial_mis.squared_ratio(light_tracer_->emission_pdf_squared(
                                                    light, light_point, state.previous_point, state.ray.d));
    return contribution;
  }

  // What paths from the lights would have made of the edge.
  void update_partial_mis(const SurfacePoint& point, PathState& state) const {
    const double cosine = std::abs(double(point.ng.dot(state.ray.d)));
    const double distance2 = (point.p - state.previous_point).template cast<double>().squaredNorm();
    if (state.edges > 1) state.partial_mis.add_vertex(cosine, distance2);
    else state.partial_mis.add_vertex_from_point(cosine, distance2);
  }

  // Squared density with which paths from the lights go on from `isect`, where they come from wi, the way that this came.
  static double pdf_rev_squared(const Interaction& isect, const PathState& state, const Vec3& wi, bool near_specular,
                                Float eta) {
    if (state.edges == 1) return near_specular ? 0 : 1; // they are connected to the camera there
    return mc::sqr(reverse_pdf(isect.bsdf, isect.wo, wi, near_specular, eta));
  }

  // Light from one direction towards a light, reflected toward wo.
  template <class Stream>
  RENDER_FLAT RadianceContribution direct_contribution(const Interaction& isect, const PathState& state, Stream& stream,
                                                       std::uint64_t& rays) const {
    const Vec2 u = stream.next2(); // u[0] also chooses the light, so that the choice is as well spread as the points
    const auto choice = scene_.sample_light(isect.point.p, u[0]);
    const Light& source = scene_.lights()[choice.index];
    if (isect.bsdf.is_near_specular() && !source.is_delta()) return {Spectrum::Zero()};
    const auto s = source.sample(isect.point.p, {choice.u_remapped, u[1]});
    if (!s || is_black(s->radiance)) return {Spectrum::Zero()};
    const Vec3 wi = isect.frame.to_local(s->wi);
    if (!same_geometric_side(isect, wi, s->wi)) return {Spectrum::Zero()};
    const Spectrum f = isect.bsdf.eval(isect.wo, wi);
    if (is_black(f)) return {f};
    const std::optional<Ray> ray = s->point ? isect.point.spawn_ray_to(*s->point, s->wi) : isect.point.spawn_ray(s->wi);
    if (!ray) return {Spectrum::Zero()};
    const Float transmittance = shadow_transmittance(scene_, *ray, s->point, rays);
    if (transmittance == 0) return {Spectrum::Zero()};
    Spectrum arriving = transmittance * s->radiance;
    if (const HomogeneousMedium* medium = isect.media(s->wi).current) [[unlikely]]
      arriving *= medium->transmittance(s->point ? (s->point->p - isect.point.p).norm() : mc::infinity<Float>);
    const Float pdf = choice.pmf * s->pdf;
    const bool shared = strategy_.direct_lighting == DirectLighting::mis && !source.is_delta();
    const Float weight = shared ? mc::power_heuristic(pdf, direction_mixture_.pdf(isect, wi, s->wi)) : Float(1);
    RadianceContribution contribution{f * arriving * (std::abs(wi.z()) * weight / pdf)};
    if (light_tracer_ && state.edges > 1) [[unlikely]]
      contribution.mis_ratio =
          double(weight) * nee_mis_ratio(isect, state, wi, *s, static_cast<std::uint32_t>(choice.index), pdf);
    return contribution;
  }

  // The odds of paths from the lights against a connection of density `pdf` [1/sr].
  double nee_mis_ratio(const Interaction& isect, const PathState& state, const Vec3& wi, const LightSample& s,
                       std::uint32_t light, Float pdf) const {
    const SurfacePoint* end = s.point ? &*s.point : nullptr;
    const double at_light = end ? std::abs(double(end->ng.dot(s.wi))) : 1,
                 here = std::abs(double(isect.point.ng.dot(s.wi)));
    return state.partial_mis.squared_ratio(pdf_rev_squared(isect, state, wi, false, 1)) *
           light_tracer_->emission_pdf_squared(light, end, isect.point.p, s.wi) *
           mc::sqr(here / (double(pdf) * at_light));
  }

  const SceneType& scene_;
  Strategy strategy_;
  int max_depth_;
  DirectionMixture direction_mixture_;
  const LightTracer* light_tracer_;
};

} // namespace render
