#pragma once
/// Paths of neighbouring pixels that lend each other their ends.

#include <render/integrator/path.h>

#include <array>
#include <span>

namespace render {

/// A camera ray of a pixel, and what the rest of its path is made from.
template <class Stream> struct TileRay {
  Ray ray;
  Media around; ///< through what it starts
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
template <class SceneType> class TileIntegrator {
 public:
  static constexpr int side = 2;
  static constexpr std::size_t pixels = side * side;
  /// The variance of a sum of many pixels is at most this times the sum of their variances.
  static constexpr double noise_area = pixels;

  /// light_paths : see PathIntegrator
  ///   throws    : Error where something else than radiance is to be shown
  TileIntegrator(const SceneType& scene, const PathOptions& options, const LightPaths* light_paths = nullptr)
      : steps_(scene, options.strategy, options.max_depth, light_paths) {
    mc::require(options.shown.what == Shown::radiance,
                "render: tiles share radiance, and normals or openness are to be shown; leave out tiles");
  }

  /// Radiance that arrives along the rays of a tile's pixels, one sample of each. `rays` counts the rays traced.
  template <class Stream>
  std::array<Spectrum, pixels> radiances(std::array<TileRay<Stream>, pixels>& tile, std::uint64_t& rays) const;

 private:
  using Steps = PathSteps<SceneType>;
  using Radiances = std::array<Spectrum, pixels>;

  /// Where the path of a pixel first meets a surface that is not a delta.
  struct Fork {
    Walk walk;
    typename Steps::Place place;
    bool reached = false;
  };
  using Forks = std::array<Fork, pixels>;

  /// Where the path of a pixel came to a diffuse surface.
  struct End {
    std::size_t owner;
    SurfacePoint point;
    Vec3 d;    ///< by which the owner came
    Float pdf; ///< of that [1/sr]
    Spectrum light = Spectrum::Zero();
    std::vector<FoundLight> contested = {}; ///< that paths from the lights could have found, by the owner's odds

    void add(const FoundLight& found) {
      if (found.odds == 0) light += found.value;
      else contested.push_back(found);
    }
    bool is_dark() const { return contested.empty() && (light == 0).all(); }
  };

  /// An end as a fork sees it.
  struct View {
    Spectrum f;     ///< beta f, and what is left of light on the way
    double measure; ///< |cos| g: solid angle at the fork to area at the end, projected at both
    double density; ///< per area at the end, of the fork's path there
    double odds;    ///< of paths from the lights, but for a factor that is the same for all forks
  };

  // The rest of a path from its fork; an end if it can be shared, and whatever else it finds.
  template <class Stream, class Found>
  std::optional<End> extend(std::size_t owner, const Fork& fork, Stream& stream, std::uint64_t& rays,
                            const Found& found) const;

  std::optional<View> view(const Fork& fork, const End& end, bool is_owner, std::uint64_t& rays) const;

  // Gives all that see an end its light.
  void share(const End& end, const Forks& forks, std::uint64_t& rays, Radiances& radiances) const;

  Steps steps_;
};

template <class SceneType>
template <class Stream, class Found>
auto TileIntegrator<SceneType>::extend(std::size_t owner, const Fork& fork, Stream& stream, std::uint64_t& rays,
                                       const Found& found) const -> std::optional<End> {
  Walk walk = fork.walk;
  typename Steps::Place place;
  if (!steps_.turn(fork.place.at(walk), walk, stream)) return {};
  if (!steps_.arrive(walk, place, stream, rays, found)) return {};
  const auto at = place.at(walk);
  if (walk.previous_pdf == 0 || !at.bsdf.is_diffuse()) {
    if (steps_.leave(at, walk, stream, rays, found)) steps_.follow(walk, stream, rays, found);
    return {};
  }
  End end{owner, place.point, walk.ray.d, walk.previous_pdf};
  const auto found_beyond = [&](const FoundLight& light) { end.add(light); };
  walk.worth *= walk.beta.maxCoeff();
  walk.beta = Spectrum::Ones();
  if (steps_.leave(at, walk, stream, rays, found_beyond)) steps_.follow(walk, stream, rays, found_beyond);
  return end.is_dark() ? std::nullopt : std::optional(std::move(end));
}

template <class SceneType>
auto TileIntegrator<SceneType>::view(const Fork& fork, const End& end, bool is_owner, std::uint64_t& rays) const
    -> std::optional<View> {
  const auto at = fork.place.at(fork.walk);
  if (at.bsdf.is_narrow()) return {};
  const Vec3d way = end.point.p.template cast<double>() - at.point.p.template cast<double>();
  const double distance2 = way.squaredNorm(), distance = std::sqrt(distance2);
  if (!(distance2 > 0)) return {};
  const Vec3 d = is_owner ? end.d : Vec3((way / distance).template cast<Float>());
  const auto same_side = [&](const Vec3& n) { return (d.dot(n) < 0) == (end.d.dot(n) < 0); };
  if (!same_side(end.point.ng) || !same_side(end.point.ns)) return {};
  const Vec3 wi = at.frame.to_local(d);
  if (!is_real(at, wi, d)) return {};
  Spectrum f = fork.walk.beta * at.bsdf.eval(at.wo, wi);
  const Float pdf = is_owner ? end.pdf : steps_.directions().pdf(at, wi, d);
  if (is_black(f) || !(pdf > 0)) return {}; // its path would never come there
  Float open = 1;
  if (!is_owner || steps_.scene().has_masks()) {
    const auto ray = at.point.spawn_ray_to(end.point, d);
    open = ray ? open_share(steps_.scene(), *ray, end.point, rays) : Float(0);
    if (open == 0) return {};
  }
  if (const HomogeneousMedium* medium = at.media(d).here) [[unlikely]]
    f *= medium->transmittance(Float(distance));
  const double g = std::abs(double(d.dot(end.point.ng))) / distance2;
  return View{f, open * std::abs(double(wi.z())) * g, open * double(pdf) * g,
              steps_.odds_at(end.point, at, fork.walk, d, pdf)};
}

template <class SceneType>
void TileIntegrator<SceneType>::share(const End& end, const Forks& forks, std::uint64_t& rays,
                                      Radiances& radiances) const {
  const Fork& owner = forks[end.owner];
  const auto own = view(owner, end, true, rays);
  if (!own) return;
  std::array<std::optional<View>, pixels> views;
  double density = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (i == end.owner) views[i] = own;
    else if (forks[i].reached && forks[i].walk.edges == owner.walk.edges) views[i] = view(forks[i], end, false, rays);
    if (views[i] && (views[i]->odds > 0) != (own->odds > 0)) views[i].reset();
    if (views[i]) density += views[i]->density;
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!views[i]) continue;
    Spectrum light = end.light;
    for (const FoundLight& found : end.contested)
      light += FoundLight{found.value, found.odds * (views[i]->odds / own->odds)}.counted();
    radiances[i] += views[i]->f * light * Float(views[i]->measure / density);
  }
}

template <class SceneType>
template <class Stream>
auto TileIntegrator<SceneType>::radiances(std::array<TileRay<Stream>, pixels>& tile, std::uint64_t& rays) const
    -> Radiances {
  Forks forks;
  Radiances radiances;
  std::array<std::optional<End>, pixels> ends;
  for (std::size_t i = 0; i < pixels; ++i) {
    auto& [ray, around, stream] = tile[i];
    Fork& fork = forks[i];
    radiances[i] = Spectrum::Zero();
    const auto found = [&](const FoundLight& light) { radiances[i] += light.counted(); };
    fork.walk = steps_.start(ray, around);
    fork.reached = steps_.arrive_at_rough(fork.walk, fork.place, stream, rays, found);
    if (!fork.reached) continue;
    steps_.connect(fork.place.at(fork.walk), fork.walk, stream, rays, found);
    ends[i] = extend(i, fork, stream, rays, found);
  }
  for (const auto& end : ends)
    if (end) share(*end, forks, rays, radiances);
  return radiances;
}

} // namespace render
