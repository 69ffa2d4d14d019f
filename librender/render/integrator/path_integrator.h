#pragma once
/// Path tracing from the camera.

#include <render/integrator/direct_lighting.h>
#include <render/integrator/ray_cone.h>

#include <mc/estimate/russian_roulette.h>

namespace render {

/// Settings of a path tracer.
struct PathOptions {
  Strategy strategy = strategy_from("mis"); ///< How paths find light.
  int max_depth = -1;                       ///< Largest number of edges (1: only directly visible light); -1: no limit.
  int branches = 2;                         ///< Number of branches at the first non-delta vertex.
  RayCone cone = {};                        ///< Cone of a camera ray.
};

/// Light that a path finds.
struct RadianceContribution {
  /// Contribution with its MIS weight against the other techniques of camera paths, but not against light paths.
  Spectrum value;
  /// Squared density of light paths over the sum of the squared densities of camera paths; 0: no light path finds it.
  double mis_ratio = 0;

  /// The contribution with its MIS weight against light paths.
  Spectrum weighted() const { return mis_ratio == 0 ? value : Spectrum(value * Float(1 / (1 + mis_ratio))); }
};

/// Policy of a PathIntegrator whose paths compete with no light paths: all ratios are 0. LightPathMis is the other
/// policy, and documents the functions.
struct NoLightPaths {
  /// No state along a path.
  struct PartialWeight {};
  /// Directions are sampled as the strategy says.
  template <class SceneType> DirectionMixture directions(const SceneType& scene, const Strategy& strategy) const {
    return {scene, strategy};
  }
  /// See LightPathMis.
  PartialWeight start(const Vec3&) const { return {}; }
  /// See LightPathMis.
  void arrive(PartialWeight&, int, const Vec3&, const Vec3&, const SurfacePoint&) const {}
  /// See LightPathMis.
  void escape(PartialWeight&) const {}
  /// See LightPathMis.
  template <class Interaction> void scatter(PartialWeight&, int, const Interaction&, const ScatterSample&) const {}
  /// No light path competes with a hit.
  double emission_ratio(const PartialWeight&, int, std::uint32_t, const SurfacePoint*, const Vec3&, const Vec3&) const {
    return 0;
  }
  /// No light path competes with a connection.
  template <class Interaction>
  double direct_ratio(const PartialWeight&, int, const Interaction&, const LightConnection&) const {
    return 0;
  }
  /// No light path competes with a reconnection.
  template <class Interaction>
  double reconnection_ratio(const PartialWeight&, int, const Interaction&, const SurfacePoint&, const Vec3&,
                            Float) const {
    return 0;
  }
};

/// Path tracer: estimates the radiance along camera rays as the strategy says. The scene must outlive it. Immutable, so
/// threads can share it.
///   Unsampled lights : lights without is_sampled() are found by hits alone and count fully, in every strategy.
///   Light paths : with the policy LightPathMis, contributions carry MIS weights against light paths, which the caller
///                 traces.
///   Caustics    : connections to lights cannot find them. `mis` aims up to a quarter of its directions at spheres of
///                 glass or mirror.
///   Media       : a path scatters at a sampled distance, or reaches the surface; see HomogeneousMedium::sample_edge().
///   Splitting   : a path splits at its first non-delta vertex, by default in two. The path to this vertex and the
///                 direct lighting cost much of the time and contribute little of the variance [ArvoKirk90].
///   Roulette    : after four edges a path survives with probability min(.99, max(4, g) max(beta) eta_scale).
///                 The factor 4 balances variance against cost. g is the guiding pdf ratio since the last rough vertex.
///                 Without g, paths toward a small lamp would rarely survive: their throughput is as small as the lamp.
/// See docs/methods/path-tracing.md and docs/methods/russian-roulette.md.
template <class SceneType, class LightMis = NoLightPaths> class PathIntegrator {
 public:
  /// The scene's BSDF type.
  using BsdfType = std::remove_cvref_t<decltype(std::declval<SceneType>().bsdf(std::declval<Surface>()))>;
  /// A vertex with its BSDF, frame and media.
  using Interaction = render::Interaction<BsdfType>;

  /// State carried along a camera path.
  struct PathState {
    Ray ray;                          ///< Next ray to trace.
    Vec3 previous_point;              ///< Previous vertex, or the origin on the camera.
    Spectrum beta = Spectrum::Ones(); ///< Throughput: factor of the light found next.
    /// Density [1/sr] of the last direction; 0 at the camera and after a near-specular lobe, which light sampling
    /// cannot replace.
    Float previous_pdf = 0;
    /// Squared index ratio; times beta it is the importance for roulette, without the compression of radiance in glass.
    Float eta_scale = 1;
    /// Density of the directions since the last rough vertex over the density of pure BSDF sampling.
    Float guiding_pdf_ratio = 1;
    int edges = 0;          ///< Number of edges so far.
    RayCone cone = {};      ///< Footprint of the path.
    MediumStack media = {}; ///< Media along the ray.
    /// What the policy knows about light paths that would make this path.
    [[no_unique_address]] typename LightMis::PartialWeight partial_mis = {};
  };

  /// The end of an edge: a point on a surface or within a medium, or nothing. Not copyable: it may own the BSDF that it
  /// points to.
  struct Vertex {
    Vertex() = default;
    Vertex(const Vertex&) = delete;
    Vertex& operator=(const Vertex&) = delete;

    /// Position and normals.
    SurfacePoint point;
    /// The surface; null within a medium, and if the edge leaves the scene.
    const Surface* surface = nullptr;
    bool escapes = false; ///< Whether the edge leaves the scene.
    /// The BSDF: the scene's, bsdf_storage, or the phase function of the medium.
    const BsdfType* bsdf = nullptr;
    std::optional<Bsdf> bsdf_storage; ///< The BSDF if a texture varies it.

    /// The vertex with its shading frame, for a path that arrives by state.ray.
    Interaction interaction(const PathState& state) const {
      return {{*bsdf, point, -state.ray.d}, surface ? surface->interior.get() : nullptr, state.media};
    }
  };

  /// Prepares path tracing of a scene.
  ///   light_mis : weights against light paths of the same scene.
  explicit PathIntegrator(const SceneType& scene, const PathOptions& options = {}, const LightMis& light_mis = {})
      : scene_(scene), direct_lighting_(options.strategy.direct_lighting), max_depth_(options.max_depth),
        branches_(options.branches), cone_(options.cone), filters_textures_(scene.has_filtered_textures()),
        light_mis_(light_mis), direction_mixture_(light_mis_.directions(scene, options.strategy)) {}

  /// Estimates the radiance that arrives along `ray`, with one sample. `rays` counts the rays traced.
  ///   media : media at the origin of the ray.
  template <class Stream>
  Spectrum Li(const Ray& ray, Stream& stream, std::uint64_t& rays, const MediumStack& media = {}) const {
    Spectrum L = Spectrum::Zero();
    PathState state = start_path(ray, media);
    trace(state, true, stream, rays, [&](const RadianceContribution& light) { L += light.weighted(); });
    return L;
  }

  /// Traces a path to its end and passes the light that it finds to `add_radiance`.
  ///   splits : whether the path splits at its first non-delta vertex.
  template <class Stream, class AddRadiance>
  void trace(PathState& state, bool splits, Stream& stream, std::uint64_t& rays,
             const AddRadiance& add_radiance) const {
    Vertex vertex;
    while (state.edges != max_depth_) {
      if (!state.beta.isFinite().all()) [[unlikely]]
        return add_radiance(RadianceContribution{state.beta}); // the caller counts an invalid sample
      // Find the next vertex, and add its emission with its MIS weight.
      const bool scatters = intersect(state, vertex, stream, rays);
      add_emission(state, vertex, add_radiance);
      if (!scatters) return;
      const Interaction isect = vertex.interaction(state);
      if (!isect.bsdf.lobes().is_delta()) {
        add_direct(state, isect, stream, rays, add_radiance);
        if (splits) return add_radiance(RadianceContribution{trace_branches(state, isect, stream, rays)});
      }
      if (!sample_bsdf(state, isect, stream) || !russian_roulette(state, stream)) return;
    }
  }

  // Building blocks of trace(), which path reuse combines in another way.

  /// Starts a path with a camera ray. Its first edge begins on the lens; the ray may begin on the near plane.
  ///   media : media at the origin of the ray, and in the space before the near plane.
  PathState start_path(const Ray& ray, const MediumStack& media) const {
    PathState state{ray, ray.o - scene_.camera().near() / ray.d.dot(scene_.camera().forward()) * ray.d};
    state.media = media;
    state.cone = cone_;
    state.partial_mis = light_mis_.start(ray.d);
    return state;
  }

  /// Traces an edge to the next vertex, counts it, and updates throughput, footprint, media and the policy's state.
  /// Returns false if the path ends there.
  template <class Stream> bool intersect(PathState& state, Vertex& vertex, Stream& stream, std::uint64_t& rays) const {
    ++state.edges;
    vertex.surface = nullptr;
    std::optional<Hit> hit;
    if (scene_.has_media()) [[unlikely]] {
      const EdgeEnd end =
          sample_edge_in_media(scene_, state.ray, state.previous_point, state.media, state.beta, stream, rays);
      if (end.scattering) return scatter_in_medium(state, vertex, *end.scattering);
      hit = end.hit;
    } else {
      hit = sample_nearest_hit(scene_, state.ray, stream, rays);
    }
    vertex.escapes = !hit;
    if (!hit) {
      light_mis_.escape(state.partial_mis);
      return false;
    }
    vertex.surface = &scene_.surface(*hit);
    vertex.point = vertex.surface->shape->surface_point(state.ray, *hit);
    light_mis_.arrive(state.partial_mis, state.edges, state.previous_point, state.ray.d, vertex.point);
    if (state.edges == max_depth_ || vertex.surface->absorbs(vertex.point, state.ray.d)) return false;
    Float footprint = 0;
    if (filters_textures_) {
      state.cone.advance(Float(hit->t));
      footprint = state.cone.footprint(state.ray.d.dot(vertex.point.ng));
    }
    vertex.bsdf = &scene_.bsdf(*vertex.surface, *hit, vertex.point, vertex.bsdf_storage, footprint);
    return true;
  }

  /// Passes the emission at the end of the last edge to `add_radiance`.
  template <class AddRadiance>
  void add_emission(const PathState& state, const Vertex& vertex, const AddRadiance& add_radiance) const {
    if (vertex.escapes) {
      for (const std::uint32_t light : scene_.infinite_lights())
        add_radiance(emitted_contribution(light, nullptr, state));
    } else if (vertex.surface && vertex.surface->light) {
      add_radiance(emitted_contribution(*vertex.surface->light, &vertex.point, state));
    }
  }

  /// Passes the direct lighting of a vertex to `add_radiance` (next-event estimation).
  template <class Stream, class AddRadiance>
  void add_direct(const PathState& state, const Interaction& isect, Stream& stream, std::uint64_t& rays,
                  const AddRadiance& add_radiance) const {
    if (direct_lighting_ == DirectLighting::bsdf_only || !scene_.has_light_sampler()) return;
    const auto light = connect_to_light(scene_, direct_lighting_, direction_mixture_, isect, stream, rays);
    if (!light) return;
    add_radiance(RadianceContribution{state.beta * light->value,
                                      double(light->mis_weight) *
                                          light_mis_.direct_ratio(state.partial_mis, state.edges, isect, *light)});
  }

  /// Samples the next direction. Returns false if the path is absorbed.
  template <class Stream> bool sample_bsdf(PathState& state, const Interaction& isect, Stream& stream) const {
    const auto next = direction_mixture_.sample(isect, stream);
    if (!next) return false;
    state.beta *= next->weight;
    state.previous_pdf = next->pdf;
    state.eta_scale *= mc::sqr(next->eta);
    state.guiding_pdf_ratio =
        next->pdf > 0 ? next->guiding_pdf_ratio : state.guiding_pdf_ratio * next->guiding_pdf_ratio;
    if (is_black(state.beta)) return false;
    light_mis_.scatter(state.partial_mis, state.edges, isect, *next);
    state.previous_point = isect.point.p;
    state.ray = isect.point.spawn_ray(next->d);
    if (filters_textures_) state.cone.scatter(next->pdf);
    state.media = isect.media(next->d);
    return true;
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

  /// The scene.
  const SceneType& scene() const { return scene_; }
  /// Direction sampling of the strategy.
  const DirectionMixture& direction_mixture() const { return direction_mixture_; }
  /// Weights against light paths.
  const LightMis& light_mis() const { return light_mis_; }

 private:
  // A vertex within a medium, with the phase function as BSDF and the direction of arrival as axis. Media that scatter
  // need the scene's BSDFs to be of type Bsdf, and exclude light paths.
  bool scatter_in_medium(PathState& state, Vertex& vertex, const Vec3& p) const {
    if (filters_textures_) state.cone.advance((p - state.previous_point).norm());
    vertex.escapes = false;
    const Vec3 axis = -state.ray.d.normalized();
    vertex.point = {.p = p, .ng = axis, .ns = axis};
    if constexpr (std::same_as<BsdfType, Bsdf>) vertex.bsdf = &state.media.current->phase_function();
    return state.edges != max_depth_;
  }
  // Mean over several branches of the light that a path finds beyond `isect`.
  template <class Stream>
  Spectrum trace_branches(const PathState& state, const Interaction& isect, Stream& stream, std::uint64_t& rays) const {
    const auto [copies, weight] = mc::split<Float>(Float(branches_), 0);
    Spectrum sum = Spectrum::Zero();
    for (std::uint32_t i = 0; i < copies; ++i) {
      PathState own = state;
      Stream numbers = stream.branch(i, copies);
      Spectrum branch = Spectrum::Zero();
      const auto add_to_branch = [&](const RadianceContribution& light) { branch += light.weighted(); };
      if (sample_bsdf(own, isect, numbers) && russian_roulette(own, numbers))
        trace(own, false, numbers, rays, add_to_branch);
      sum += branch;
    }
    return sum * weight;
  }

  // Emission at the end of the last edge, with its MIS weight.
  RadianceContribution emitted_contribution(std::uint32_t light, const SurfacePoint* light_point,
                                            const PathState& state) const {
    const Light& source = scene_.lights()[light];
    const Spectrum Le = source.Le(state.ray.d, light_point);
    if (is_black(Le) || direct_lighting_ == DirectLighting::bsdf_only || !source.is_sampled()) return {state.beta * Le};
    Float weight = 1;
    if (state.previous_pdf > 0) {
      if (direct_lighting_ == DirectLighting::nee) return {Spectrum::Zero()};
      const Float other =
          scene_.light_pmf(state.previous_point, light) * source.pdf(state.previous_point, state.ray.d, light_point);
      weight = mc::power_heuristic(state.previous_pdf, other);
    }
    return {state.beta * (Le * weight),
            double(weight) * light_mis_.emission_ratio(state.partial_mis, state.edges, light, light_point,
                                                       state.previous_point, state.ray.d)};
  }

  const SceneType& scene_;
  DirectLighting direct_lighting_;
  int max_depth_;
  int branches_;
  RayCone cone_;
  bool filters_textures_;
  [[no_unique_address]] LightMis light_mis_;
  DirectionMixture direction_mixture_;
};

} // namespace render
