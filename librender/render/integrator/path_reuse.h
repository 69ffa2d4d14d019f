#pragma once
/// Path reuse between neighbouring pixels.

#include <render/integrator/path_integrator.h>

#include <array>
#include <span>

namespace render {

/// A camera ray of a pixel, with the random numbers for the rest of its path.
template <class Stream> struct CameraRay {
  /// The ray through the pixel.
  Ray ray;
  MediumStack media; ///< Media at the origin of the ray.
  /// Random numbers of the sample.
  Stream stream;
};

/// Path tracer for tiles of 2x2 pixels that share diffuse vertices.
/// The path of pixel i first reaches a non-delta vertex at x_i and continues there in one direction. If this leads to a
/// diffuse surface at y, the radiance L that leaves y is estimated once and counts for all four pixels. Pixel i gets
///   f_i |cos_i| g_i V_i L / sum_j p_j g_j V_j, with g = |cos at y| / |x - y|^2.
/// p_j is the density [1/sr] with which pixel j would sample the direction to y: the weights are the balance heuristic.
/// Each pixel gets up to four paths for the price of one path and three shadow rays. No pixel is biased. The noise of
/// the four pixels is correlated; see noise_area.
///   Shared : y is diffuse, the paths have the same number of edges before y, and no near-specular lobe was sampled at
///            x_i. The MIS weight against light paths is computed for each pixel as if it had found the path.
///   Gain   : see docs/methods/path-reuse.md and notebooks-data/adaptive/spp64.csv. It is lost where neighbouring
///            pixels show different objects.
///   Source : [BekaertSbertHalton02]; balance heuristic [Veach97] section 9.2.
template <class SceneType, class LightMis = NoLightPaths> class PathReuseIntegrator {
 public:
  /// Width and height of a tile [pixels].
  static constexpr int side = 2;
  /// Number of pixels in a tile.
  static constexpr std::size_t pixels = side * side;
  /// Bound of the noise area: the variance of a sum of many pixels is at most this times the sum of their variances.
  static constexpr double noise_area = pixels;

  /// Prepares path tracing of a scene.
  ///   options, light_mis : as for PathIntegrator; paths do not split.
  PathReuseIntegrator(const SceneType& scene, const PathOptions& options, const LightMis& light_mis = {})
      : paths_(scene, options, light_mis) {}

  /// Estimates the radiance along the rays of a tile's pixels, with one sample each. `rays` counts the rays traced.
  template <class Stream>
  std::array<Spectrum, pixels> radiances(std::array<CameraRay<Stream>, pixels>& tile, std::uint64_t& rays) const;

 private:
  using Paths = PathIntegrator<SceneType, LightMis>;
  using PathState = typename Paths::PathState;
  using Vertex = typename Paths::Vertex;
  using Radiances = std::array<Spectrum, pixels>;

  /// First non-delta vertex of a pixel's path.
  struct ForkVertex {
    PathState state;
    Vertex vertex;
    bool reached = false;
  };
  using Forks = std::array<ForkVertex, pixels>;

  /// A diffuse vertex that a pixel's path reached.
  struct SharedVertex {
    std::size_t owner;
    SurfacePoint point;
    Vec3 d;    ///< Direction in which the owner arrived.
    Float pdf; ///< Density of d [1/sr].
    Spectrum light = Spectrum::Zero();
    std::vector<RadianceContribution> light_traced = {}; ///< Contributions that light paths can find, too.

    void add(const RadianceContribution& contribution) {
      if (contribution.mis_ratio == 0) light += contribution.value;
      else light_traced.push_back(contribution);
    }
    bool is_dark() const { return light_traced.empty() && (light == 0).all(); }
  };

  /// Connection of a non-delta vertex (fork) to a shared vertex.
  struct Reconnection {
    Spectrum f_cos;   ///< beta f |cos|, with the transmittance of the medium.
    double measure;   ///< V g: visibility, and solid angle to area at the shared vertex.
    double area_pdf;  ///< Density of the fork's own path at the shared vertex [1/area], times V.
    double mis_ratio; ///< Squared density ratio of light paths, up to a factor common to all forks.
  };

  // Traces a path to its next vertex. Returns false if the path ends.
  template <class Stream, class AddRadiance>
  bool next_vertex(PathState& state, Vertex& vertex, Stream& stream, std::uint64_t& rays,
                   const AddRadiance& add_radiance) const {
    if (!state.beta.isFinite().all()) [[unlikely]] {
      add_radiance(RadianceContribution{state.beta}); // the caller counts an invalid sample
      return false;
    }
    const bool scatters = paths_.intersect(state, vertex, stream, rays);
    paths_.add_emission(state, vertex, add_radiance);
    return scatters;
  }

  // Continues a path beyond a vertex, to its end.
  template <class Stream, class AddRadiance>
  void trace_on(PathState& state, const Vertex& vertex, Stream& stream, std::uint64_t& rays,
                const AddRadiance& add_radiance) const {
    const auto isect = vertex.interaction(state);
    if (!isect.bsdf.lobes().is_delta()) paths_.add_direct(state, isect, stream, rays, add_radiance);
    if (paths_.sample_bsdf(state, isect, stream) && Paths::russian_roulette(state, stream))
      paths_.trace(state, false, stream, rays, add_radiance);
  }

  // Follows a path to its first non-delta vertex. Returns false if the path ends before.
  template <class Stream, class AddRadiance>
  bool reach_fork(ForkVertex& fork, Stream& stream, std::uint64_t& rays, const AddRadiance& add_radiance) const {
    while (next_vertex(fork.state, fork.vertex, stream, rays, add_radiance)) {
      if (!fork.vertex.bsdf->lobes().is_delta()) return true;
      const auto isect = fork.vertex.interaction(fork.state);
      if (!paths_.sample_bsdf(fork.state, isect, stream) || !Paths::russian_roulette(fork.state, stream)) return false;
    }
    return false;
  }

  template <class Stream, class AddRadiance>
  std::optional<SharedVertex> extend_to_shared_vertex(std::size_t owner, const ForkVertex& fork, Stream& stream,
                                                      std::uint64_t& rays, const AddRadiance& add_radiance) const;

  std::optional<Reconnection> reconnect(const ForkVertex& fork, const SharedVertex& shared, bool is_owner,
                                        std::uint64_t& rays) const;

  // Adds the light of a shared vertex to every pixel that can connect to it.
  void distribute(const SharedVertex& shared, const Forks& forks, std::uint64_t& rays, Radiances& radiances) const;

  // Squared density ratio of light paths if the path of a fork continued to `shared`; see reconnection_ratio().
  double mis_ratio(const ForkVertex& fork, const typename Paths::Interaction& isect, const SharedVertex& shared,
                   const Vec3& d, Float pdf) const {
    return paths_.light_mis().reconnection_ratio(fork.state.partial_mis, fork.state.edges, isect, shared.point, d, pdf);
  }

  Paths paths_;
};

/// Traces a path beyond its fork. Returns its next vertex if it can be shared; adds all other light to the pixel.
template <class SceneType, class LightMis>
template <class Stream, class AddRadiance>
auto PathReuseIntegrator<SceneType, LightMis>::extend_to_shared_vertex(std::size_t owner, const ForkVertex& fork,
                                                                       Stream& stream, std::uint64_t& rays,
                                                                       const AddRadiance& add_radiance) const
    -> std::optional<SharedVertex> {
  PathState state = fork.state;
  Vertex vertex;
  if (!paths_.sample_bsdf(state, fork.vertex.interaction(state), stream)) return {};
  if (!next_vertex(state, vertex, stream, rays, add_radiance)) return {};
  if (state.previous_pdf == 0 || !vertex.bsdf->lobes().is_diffuse() ||
      ShadingFrame::faces_away(vertex.point, -state.ray.d)) {
    trace_on(state, vertex, stream, rays, add_radiance);
    return {};
  }
  SharedVertex shared{owner, vertex.point, state.ray.d, state.previous_pdf};
  state.eta_scale *= state.beta.maxCoeff();
  state.beta = Spectrum::Ones();
  trace_on(state, vertex, stream, rays, [&](const RadianceContribution& light) { shared.add(light); });
  return shared.is_dark() ? std::nullopt : std::optional(std::move(shared));
}

template <class SceneType, class LightMis>
auto PathReuseIntegrator<SceneType, LightMis>::reconnect(const ForkVertex& fork, const SharedVertex& shared,
                                                         bool is_owner, std::uint64_t& rays) const
    -> std::optional<Reconnection> {
  const auto isect = fork.vertex.interaction(fork.state);
  if (isect.bsdf.lobes().is_near_specular()) return {};
  const Vec3d way = shared.point.p.template cast<double>() - isect.point.p.template cast<double>();
  const double distance2 = way.squaredNorm(), distance = std::sqrt(distance2);
  if (!(distance2 > 0)) return {};
  const Vec3 d = is_owner ? shared.d : Vec3((way / distance).template cast<Float>());
  if ((d.dot(shared.point.ng) < 0) != (shared.d.dot(shared.point.ng) < 0)) return {};
  if (ShadingFrame::faces_away(shared.point, -d)) return {}; // it would reflect other light to the fork
  const Vec3 wi = isect.frame.to_local(d);
  Spectrum f_cos = fork.state.beta * isect.f_cos(wi);
  const Float pdf = is_owner ? shared.pdf : paths_.direction_mixture().pdf(isect, wi, d);
  if (is_black(f_cos) || !(pdf > 0)) return {}; // its path could not have sampled y
  Float transmittance = 1;
  if (!is_owner || paths_.scene().has_masks()) {
    const auto ray = isect.point.spawn_ray_to(shared.point, d);
    transmittance = ray ? shadow_transmittance(paths_.scene(), *ray, shared.point, rays) : Float(0);
    if (transmittance == 0) return {};
  }
  if (const HomogeneousMedium* medium = isect.media(d).current) [[unlikely]]
    f_cos *= medium->transmittance(Float(distance));
  const double g = std::abs(double(d.dot(shared.point.ng))) / distance2;
  return Reconnection{f_cos, transmittance * g, transmittance * double(pdf) * g,
                      mis_ratio(fork, isect, shared, d, pdf)};
}

template <class SceneType, class LightMis>
void PathReuseIntegrator<SceneType, LightMis>::distribute(const SharedVertex& shared, const Forks& forks,
                                                          std::uint64_t& rays, Radiances& radiances) const {
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
    radiances[i] += reconnections[i]->f_cos * light * Float(reconnections[i]->measure / density);
  }
}

/// One sample of the radiance of each pixel, with reuse of shared vertices.
template <class SceneType, class LightMis>
template <class Stream>
auto PathReuseIntegrator<SceneType, LightMis>::radiances(std::array<CameraRay<Stream>, pixels>& tile,
                                                         std::uint64_t& rays) const -> Radiances {
  Forks forks;
  Radiances radiances;
  std::array<std::optional<SharedVertex>, pixels> shared_vertices;
  for (std::size_t i = 0; i < pixels; ++i) {
    auto& [ray, media, stream] = tile[i];
    ForkVertex& fork = forks[i];
    radiances[i] = Spectrum::Zero();
    const auto add_radiance = [&](const RadianceContribution& light) { radiances[i] += light.weighted(); };
    fork.state = paths_.start_path(ray, media);
    fork.reached = reach_fork(fork, stream, rays, add_radiance);
    if (!fork.reached) continue;
    paths_.add_direct(fork.state, fork.vertex.interaction(fork.state), stream, rays, add_radiance);
    shared_vertices[i] = extend_to_shared_vertex(i, fork, stream, rays, add_radiance);
  }
  for (const auto& shared : shared_vertices)
    if (shared) distribute(*shared, forks, rays, radiances);
  return radiances;
}

} // namespace render
