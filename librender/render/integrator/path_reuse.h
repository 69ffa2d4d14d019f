#pragma once
/// Paths of neighbouring pixels that lend each other their ends.

#include <render/integrator/path_integrator.h>

#include <array>
#include <span>

namespace render {

/// A camera ray of a pixel, and what the rest of its path is made from.
template <class Stream> struct CameraRay {
  Ray ray;
  MediumStack media; ///< through what it starts
  Stream stream;
};

/// Path tracing for tiles of 2x2 pixels. The path of a pixel goes on in one direction where it first meets a surface
/// that is not a delta. Where that leads to a diffuse surface, which looks the same from everywhere, the light that
/// leaves it is found once and counts for all four: their paths could have come there, too. With pixel i at x_i, light
/// L that leaves y, found by one of them, gives
///   f_i |cos_i| g_i V_i L / sum_j p_j g_j V_j,  g = |cos at y| / |x - y|^2
/// to each, the balance heuristic over the densities [1/sr] by which the others would have come to y. So up to four
/// times as many paths light a pixel, for the price of three shadow rays. No pixel is biased; the noise of the four is
/// alike, see noise_area.
///   Shared : where y is diffuse, among paths of as many edges before, and not where the direction was a narrow lobe's.
///            Paths from the lights weigh every path as if its own pixel had found it
///   Gain   : the time of paths that share nothing but split in two, to a given error: .49 in book3-cornell-white, .55
///            in arcade, .60 in cbox, .73 to .91 in leaves, book3-cornell-glass, smallpt, materials, veach-mi,
///            book3-cornell-aluminium and textures, 1.35 in book1-cover, where neighbours see other balls. CPU seconds
///            times the variance of six seeds, 64 samples a pixel. Two directions at each fork: .41 in
///            book3-cornell-white, but 1.03 to 1.25 times as much as by one in all others except book1-cover (.89).
///            Tiles of 4x4: .29 in book3-cornell-white, of noise that 16 pixels share
///   Source : [BekaertSbertHalton02]; balance heuristic [Veach97] section 9.2
template <class SceneType> class PathReuseIntegrator {
 public:
  static constexpr int side = 2;
  static constexpr std::size_t pixels = side * side;
  /// The variance of a sum of many pixels is at most this times the sum of their variances.
  static constexpr double noise_area = pixels;

  /// light_tracer : see PathIntegrator
  ///   throws    : Error where something else than radiance is to be shown
  PathReuseIntegrator(const SceneType& scene, const PathOptions& options, const LightTracer* light_tracer = nullptr)
      : steps_(scene, options.strategy, options.max_depth, light_tracer) {
    mc::require(options.aov.kind == Aov::radiance,
                "render: tiles share radiance, not normals or ambient occlusion; leave out tiles");
  }

  /// Radiance that arrives along the rays of a tile's pixels, one sample of each. `rays` counts the rays traced.
  template <class Stream>
  std::array<Spectrum, pixels> radiances(std::array<CameraRay<Stream>, pixels>& tile, std::uint64_t& rays) const;

 private:
  using Steps = PathSteps<SceneType>;
  using Radiances = std::array<Spectrum, pixels>;

  /// Where the path of a pixel first meets a surface that is not a delta.
  struct ForkVertex {
    PathState state;
    typename Steps::PathVertex vertex;
    bool reached = false;
  };
  using Forks = std::array<ForkVertex, pixels>;

  /// Where the path of a pixel came to a diffuse surface.
  struct SharedVertex {
    std::size_t owner;
    SurfacePoint point;
    Vec3 d;    ///< by which the owner came
    Float pdf; ///< of that [1/sr]
    Spectrum light = Spectrum::Zero();
    std::vector<RadianceContribution> light_traced =
        {}; ///< that paths from the lights could have found, by the owner's odds

    void add(const RadianceContribution& contribution) {
      if (contribution.mis_ratio == 0) light += contribution.value;
      else light_traced.push_back(contribution);
    }
    bool is_dark() const { return light_traced.empty() && (light == 0).all(); }
  };

  /// An end as a fork sees it.
  struct Reconnection {
    Spectrum f;       ///< beta f, and what is left of light on the way
    double measure;   ///< |cos| g: solid angle at the fork to area at the end, projected at both
    double area_pdf;  ///< per area at the end, of the fork's path there
    double mis_ratio; ///< of paths from the lights, but for a factor that is the same for all forks
  };

  // The rest of a path from its fork; an end if it can be shared, and whatever else it finds.
  template <class Stream, class AddRadiance>
  std::optional<SharedVertex> extend_to_shared_vertex(std::size_t owner, const ForkVertex& fork, Stream& stream,
                                                      std::uint64_t& rays, const AddRadiance& add_radiance) const;

  std::optional<Reconnection> reconnect(const ForkVertex& fork, const SharedVertex& shared, bool is_owner,
                                        std::uint64_t& rays) const;

  // Gives all that see an end its light.
  void distribute(const SharedVertex& shared, const Forks& forks, std::uint64_t& rays, Radiances& radiances) const;

  Steps steps_;
};

template <class SceneType>
template <class Stream, class AddRadiance>
auto PathReuseIntegrator<SceneType>::extend_to_shared_vertex(std::size_t owner, const ForkVertex& fork, Stream& stream,
                                                             std::uint64_t& rays, const AddRadiance& add_radiance) const
    -> std::optional<SharedVertex> {
  PathState state = fork.state;
  typename Steps::PathVertex vertex;
  if (!steps_.sample_bsdf(fork.vertex.interaction(state), state, stream)) return {};
  if (!steps_.intersect_next(state, vertex, stream, rays, add_radiance)) return {};
  const auto isect = vertex.interaction(state);
  if (state.previous_pdf == 0 || !isect.bsdf.is_diffuse()) {
    if (steps_.shade_and_scatter(isect, state, stream, rays, add_radiance))
      steps_.trace_remaining(state, stream, rays, add_radiance);
    return {};
  }
  SharedVertex shared{owner, vertex.point, state.ray.d, state.previous_pdf};
  const auto add_to_shared = [&](const RadianceContribution& light) { shared.add(light); };
  state.eta_scale *= state.beta.maxCoeff();
  state.beta = Spectrum::Ones();
  if (steps_.shade_and_scatter(isect, state, stream, rays, add_to_shared))
    steps_.trace_remaining(state, stream, rays, add_to_shared);
  return shared.is_dark() ? std::nullopt : std::optional(std::move(shared));
}

template <class SceneType>
auto PathReuseIntegrator<SceneType>::reconnect(const ForkVertex& fork, const SharedVertex& shared, bool is_owner,
                                               std::uint64_t& rays) const -> std::optional<Reconnection> {
  const auto isect = fork.vertex.interaction(fork.state);
  if (isect.bsdf.is_near_specular()) return {};
  const Vec3d way = shared.point.p.template cast<double>() - isect.point.p.template cast<double>();
  const double distance2 = way.squaredNorm(), distance = std::sqrt(distance2);
  if (!(distance2 > 0)) return {};
  const Vec3 d = is_owner ? shared.d : Vec3((way / distance).template cast<Float>());
  const auto same_side = [&](const Vec3& n) { return (d.dot(n) < 0) == (shared.d.dot(n) < 0); };
  if (!same_side(shared.point.ng) || !same_side(shared.point.ns)) return {};
  const Vec3 wi = isect.frame.to_local(d);
  if (!same_geometric_side(isect, wi, d)) return {};
  Spectrum f = fork.state.beta * isect.bsdf.eval(isect.wo, wi);
  const Float pdf = is_owner ? shared.pdf : steps_.direction_mixture().pdf(isect, wi, d);
  if (is_black(f) || !(pdf > 0)) return {}; // its path would never come there
  Float transmittance = 1;
  if (!is_owner || steps_.scene().has_masks()) {
    const auto ray = isect.point.spawn_ray_to(shared.point, d);
    transmittance = ray ? shadow_transmittance(steps_.scene(), *ray, shared.point, rays) : Float(0);
    if (transmittance == 0) return {};
  }
  if (const HomogeneousMedium* medium = isect.media(d).current) [[unlikely]]
    f *= medium->transmittance(Float(distance));
  const double g = std::abs(double(d.dot(shared.point.ng))) / distance2;
  return Reconnection{f, transmittance * std::abs(double(wi.z())) * g, transmittance * double(pdf) * g,
                      steps_.mis_ratio_at(shared.point, isect, fork.state, d, pdf)};
}

template <class SceneType>
void PathReuseIntegrator<SceneType>::distribute(const SharedVertex& shared, const Forks& forks, std::uint64_t& rays,
                                                Radiances& radiances) const {
  const ForkVertex& owner = forks[shared.owner];
  const auto own = reconnect(owner, shared, true, rays);
  if (!own) return;
  std::array<std::optional<Reconnection>, pixels> reconnections;
  double density = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (i == shared.owner) reconnections[i] = own;
    else if (forks[i].reached && forks[i].state.edges == owner.state.edges)
      reconnections[i] = reconnect(forks[i], shared, false, rays);
    if (reconnections[i] && (reconnections[i]->mis_ratio > 0) != (own->mis_ratio > 0)) reconnections[i].reset();
    if (reconnections[i]) density += reconnections[i]->area_pdf;
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!reconnections[i]) continue;
    Spectrum light = shared.light;
    for (const RadianceContribution& contribution : shared.light_traced)
      light += RadianceContribution{contribution.value,
                                    contribution.mis_ratio * (reconnections[i]->mis_ratio / own->mis_ratio)}
                   .weighted();
    radiances[i] += reconnections[i]->f * light * Float(reconnections[i]->measure / density);
  }
}

template <class SceneType>
template <class Stream>
auto PathReuseIntegrator<SceneType>::radiances(std::array<CameraRay<Stream>, pixels>& tile, std::uint64_t& rays) const
    -> Radiances {
  Forks forks;
  Radiances radiances;
  std::array<std::optional<SharedVertex>, pixels> shared_vertices;
  for (std::size_t i = 0; i < pixels; ++i) {
    auto& [ray, media, stream] = tile[i];
    ForkVertex& fork = forks[i];
    radiances[i] = Spectrum::Zero();
    const auto add_radiance = [&](const RadianceContribution& light) { radiances[i] += light.weighted(); };
    fork.state = steps_.start_path(ray, media);
    fork.reached = steps_.skip_delta_bounces(fork.state, fork.vertex, stream, rays, add_radiance);
    if (!fork.reached) continue;
    steps_.sample_direct(fork.vertex.interaction(fork.state), fork.state, stream, rays, add_radiance);
    shared_vertices[i] = extend_to_shared_vertex(i, fork, stream, rays, add_radiance);
  }
  for (const auto& shared : shared_vertices)
    if (shared) distribute(*shared, forks, rays, radiances);
  return radiances;
}

} // namespace render
