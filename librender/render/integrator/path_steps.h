#pragma once
/// Building blocks of PathIntegrator and PathReuseIntegrator, edge by edge.

#include <render/integrator/light_tracer.h>

#include <mc/estimate/mis.h>

// g++ stops inlining if a file instantiates three stream types, and calls of a few instructions are then costly. Debug
// and sanitizer builds leave flatten out, since it makes them very slow to compile.
#if defined(NDEBUG)
#define RENDER_FLAT [[gnu::flatten]]
#else
#define RENDER_FLAT
#endif

namespace render {

/// Light that a path finds.
struct RadianceContribution {
  Spectrum value;       ///< Contribution if no light path can find it.
  double mis_ratio = 0; ///< Squared density of light paths over the squared density of this technique; 0: none find it.

  /// The contribution with its MIS weight against light paths.
  Spectrum weighted() const { return mis_ratio == 0 ? value : Spectrum(value * Float(1 / (1 + mis_ratio))); }
};

/// State carried along a camera path.
struct PathState {
  Ray ray;                          ///< Next ray to trace.
  Vec3 previous_point;              ///< Previous vertex, or the origin on the camera.
  Spectrum beta = Spectrum::Ones(); ///< Throughput: factor of the light found next.
  /// Density [1/sr] of the last direction; 0 at the camera and after a near-specular lobe, which light sampling cannot
  /// replace.
  Float previous_pdf = 0;
  /// Squared index ratio; times beta it is the importance for roulette, without the compression of radiance in glass.
  Float eta_scale = 1;
  /// Density of the directions since the last rough vertex over the density of pure BSDF sampling.
  Float guiding_pdf_ratio = 1;
  int edges = 0;                     ///< Number of edges so far.
  MediumStack media = {};            ///< Media along the ray.
  PartialMisWeight partial_mis = {}; ///< Ratio of light paths to this path.
};

/// Building blocks of PathIntegrator; see there for the algorithm. The scene must outlive it.
template <class SceneType> class PathSteps {
 public:
  /// The scene's BSDF type.
  using BsdfType = std::remove_cvref_t<decltype(std::declval<SceneType>().bsdf(std::declval<Surface>()))>;
  /// A vertex with its BSDF, frame and media.
  using Interaction = SurfaceInteraction<BsdfType>;

  /// A vertex on a surface. Not copyable: it may own the BSDF that it points to.
  struct PathVertex {
    PathVertex() = default;
    PathVertex(const PathVertex&) = delete;
    PathVertex& operator=(const PathVertex&) = delete;

    /// Position and normals.
    SurfacePoint point;
    /// The surface.
    const Surface* surface = nullptr;
    /// The BSDF: the scene's, or bsdf_storage.
    const BsdfType* bsdf = nullptr;
    std::optional<Bsdf> bsdf_storage; ///< The BSDF if a texture varies it.

    /// The vertex with its shading frame, for a path that arrives by state.ray.
    Interaction interaction(const PathState& state) const {
      const auto frame = mc::Frame<Float>::from_z(point.ns);
      return {{*bsdf, point, frame, frame.to_local(-state.ray.d)}, *surface, state.media};
    }
  };

  /// Prepares path tracing of a scene.
  ///   light_tracer : traces light paths of the same scene and must outlive this; null: no light paths.
  PathSteps(const SceneType& scene, const Strategy& strategy, int max_depth, const LightTracer* light_tracer)
      : scene_(scene), strategy_(strategy), max_depth_(max_depth),
        direction_mixture_(light_tracer ? light_tracer->camera_mixture() : DirectionMixture(scene, strategy)),
        light_tracer_(light_tracer) {}

  /// The scene.
  const SceneType& scene() const { return scene_; }
  /// Direction sampling of the strategy.
  const DirectionMixture& direction_mixture() const { return direction_mixture_; }

  /// Starts a path with a camera ray.
  ///   media : media at the origin of the ray.
  PathState start_path(const Ray& ray, const MediumStack& media) const {
    PathState state{ray, ray.o};
    state.media = media;
    if (light_tracer_) [[unlikely]]
      state.partial_mis = PartialMisWeight(1, light_tracer_->camera_pdf(ray.d), 0);
    if (media.current || light_tracer_) [[unlikely]] // the medium also fills the space before the near plane
      state.previous_point -= scene_.camera().near() / ray.d.dot(scene_.camera().forward()) * ray.d;
    return state;
  }

  /// The nearest hit of a ray. Each mask lets the ray pass with probability 1 - opacity; see visibility.h.
  template <class Stream> std::optional<Hit> nearest_hit(Ray& ray, Stream& stream, std::uint64_t& rays) const {
    return render::nearest_hit(scene_, ray, rays, [&](Float opacity) {
      return opacity == 0 || mc::Bernoulli<Float>(opacity).sample_index(stream.next()).index == 0;
    });
  }

  /// Traces one edge to the next vertex and passes the emission at its end to `add_radiance`. Returns false if the path
  /// ends there.
  template <class Stream, class AddRadiance>
  bool intersect_next(PathState& state, PathVertex& vertex, Stream& stream, std::uint64_t& rays,
                      const AddRadiance& add_radiance) const {
    if (state.edges == max_depth_) return false;
    if (!state.beta.isFinite().all()) [[unlikely]] {
      add_radiance(RadianceContribution{state.beta}); // reported as an invalid sample
      return false;
    }
    ++state.edges;
    const auto hit = nearest_hit(state.ray, stream, rays);
    if (!hit) {
      if (state.media.current) [[unlikely]]
        state.beta *= state.media.current->transmittance(mc::infinity<Float>);
      if (light_tracer_) [[unlikely]]
        state.partial_mis.add_vertex(1, 1); // a direction of an infinite light
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

  /// Follows a path to its first non-delta vertex. Returns false if the path ends before.
  template <class Stream, class AddRadiance>
  bool skip_delta_bounces(PathState& state, PathVertex& vertex, Stream& stream, std::uint64_t& rays,
                          const AddRadiance& add_radiance) const {
    while (intersect_next(state, vertex, stream, rays, add_radiance)) {
      if (!vertex.bsdf->is_delta()) return true;
      if (!scatter(vertex.interaction(state), state, stream)) return false;
    }
    return false;
  }

  /// Traces a path to its end and passes the light that it finds to `add_radiance`.
  template <class Stream, class AddRadiance>
  void trace_remaining(PathState& state, Stream& stream, std::uint64_t& rays, const AddRadiance& add_radiance) const {
    PathVertex vertex;
    while (intersect_next(state, vertex, stream, rays, add_radiance)) {
      if (!shade_and_scatter(vertex.interaction(state), state, stream, rays, add_radiance)) return;
    }
  }

  /// Direct lighting at the vertex, and scattering. Returns false if the path ends.
  template <class Stream, class AddRadiance>
  bool shade_and_scatter(const Interaction& isect, PathState& state, Stream& stream, std::uint64_t& rays,
                         const AddRadiance& add_radiance) const {
    if (!isect.bsdf.is_delta()) sample_direct(isect, state, stream, rays, add_radiance);
    return scatter(isect, state, stream);
  }

  /// Direct lighting at the current vertex (next-event estimation).
  template <class Stream, class AddRadiance>
  void sample_direct(const Interaction& isect, const PathState& state, Stream& stream, std::uint64_t& rays,
                     const AddRadiance& add_radiance) const {
    if (!uses_nee() || !scene_.has_light_sampler()) return;
    RadianceContribution light = direct_contribution(isect, state, stream, rays);
    light.value *= state.beta;
    add_radiance(light);
  }

  /// Samples the next direction and plays Russian roulette. Returns false if the path ends.
  template <class Stream> bool scatter(const Interaction& isect, PathState& state, Stream& stream) const {
    return sample_bsdf(isect, state, stream) && russian_roulette(state, stream);
  }

  /// Samples the next direction. Returns false if the path is absorbed.
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

  /// Squared density ratio of light paths if a path at `isect` continued to `next`. The BSDF at `next` is diffuse. The
  /// result lacks a factor that depends on `next` alone; it is 0 without light paths.
  ///   d, pdf : direction from `isect` to `next`, with its density [1/sr].
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

  /// Russian roulette. Returns whether the path survives, and scales its throughput.
  template <class Stream> static bool russian_roulette(PathState& state, Stream& stream) {
    if (state.edges < 4 || !state.beta.isFinite().all()) return true; // roulette would hide an invalid path
    const Float survival =
        std::clamp(std::max(Float(4), state.guiding_pdf_ratio) * state.beta.maxCoeff() * state.eta_scale,
                   std::numeric_limits<Float>::min(), Float(0.99));
    const auto roulette = mc::russian_roulette<Float>(survival, stream.next());
    state.beta *= roulette.weight;
    return roulette.survives;
  }

 private:
  bool uses_nee() const { return strategy_.direct_lighting != DirectLighting::bsdf_only; }

  // Emission at the end of the last edge, with its MIS weight.
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

  // Adds the last edge to the density ratio of light paths.
  void update_partial_mis(const SurfacePoint& point, PathState& state) const {
    const double cosine = std::abs(double(point.ng.dot(state.ray.d)));
    const double distance2 = (point.p - state.previous_point).template cast<double>().squaredNorm();
    if (state.edges > 1) state.partial_mis.add_vertex(cosine, distance2);
    else state.partial_mis.add_vertex_from_point(cosine, distance2);
  }

  // Squared density with which a light path that arrives at `isect` from wi scatters back along this path.
  static double pdf_rev_squared(const Interaction& isect, const PathState& state, const Vec3& wi, bool near_specular,
                                Float eta) {
    if (state.edges == 1) return near_specular ? 0 : 1; // at the first vertex light paths connect to the camera
    return mc::sqr(reverse_pdf(isect.bsdf, isect.wo, wi, near_specular, eta));
  }

  // Next-event estimation with one sampled light, without the path's throughput.
  template <class Stream>
  RENDER_FLAT RadianceContribution direct_contribution(const Interaction& isect, const PathState& state, Stream& stream,
                                                       std::uint64_t& rays) const {
    const Vec2 u = stream.next2(); // u[0] also selects the light, so that the selection is stratified
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

  // Squared density ratio of light paths to a connection of density `pdf` [1/sr].
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
