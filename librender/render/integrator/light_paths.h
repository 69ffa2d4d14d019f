#pragma once
/// Paths from the lights, connected to the camera.

#include <render/integrator/media.h>
#include <render/integrator/odds.h>
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
class LightPaths {
 public:
  static constexpr int least_edges = 3; ///< of the paths that they find

  /// None where the strategy has none, or the scene no light that they start from, or nothing narrow or transparent:
  /// elsewhere they would cost more than they bring. None either where the filter is wider than SplatFilter can share.
  ///   aspect : width / height of the film
  static std::optional<LightPaths> of(const Scene& scene, const Strategy& strategy, Float aspect);

  /// Of paths that start from where the direction wi from `ref` meets a light, back along it, per path from the camera:
  /// the squared density [1/sr] times that per area, of the light's point `met`, or of lines along wi across it where
  /// they start at one point or at infinity (null); 0 for lights that none starts from.
  double start2(std::uint32_t light, const SurfacePoint* met, const Vec3& ref, const Vec3& wi) const;

  /// Per path from the camera.
  double rate() const { return rate_; }

  /// Density of the direction d from the camera [1/sr], in paths over the whole film.
  double camera_density(const Vec3& d) const { return double(scene_->camera().density(d, tan_half_)); }

  /// The choice of directions of the paths from the camera beside them.
  const Directions& of_camera() const { return of_camera_; }

  /// Traces one path of at most max_depth edges to the camera (-1: no limit): give(s, value) for each of its
  /// connections, where s is the point of the film, as of ThinLens::ray, or one beside it, and value what it counts of
  /// the radiance there: of n paths over a film of N pixels, sum(value) / (n / (rate N)) is the radiance of a pixel.
  template <class Stream, class Give>
  void trace(Stream& stream, int max_depth, std::uint64_t& rays, const Give& give) const;

  LightPaths(LightPaths&&) = default; // targets_ are of casters_
  LightPaths& operator=(LightPaths&&) = default;

 private:
  LightPaths(const Scene& scene, const Strategy& strategy, Float aspect, std::vector<Shape> casters,
             const std::vector<double>& shares);

  struct Start {
    Ray ray;
    std::optional<SurfacePoint> point; ///< of the light, with the normals of the side that shines; none: infinitely far
    Spectrum beta = Spectrum::Zero();  ///< light that the path carries, of the unit `area`
    double area = 0;                   ///< over the density, which no float need hold
    Odds odds = {};
  };
  template <class Stream> std::optional<Start> sample_start(std::uint32_t light, const Vec2& u, Stream& stream) const;
  template <class Stream>
  std::optional<Start> sample_start_at(const AreaLight& lamp, double pmf, const Vec2& u, Stream& stream) const;
  std::optional<Start> sample_start_from(const PointLight& lamp, double pmf, const Vec2& u) const;
  template <class Stream>
  std::optional<Start> sample_start_afar(const Light& light, double pmf, const Vec2& u, Stream& stream) const;
  // Of directions from a point [1/sr]: for a direction aimed at one of the balls, this one says its own density.
  struct Aimed {
    std::size_t at;
    Float pdf;
  };
  double around(const Vec3& p, const Vec3& d, const std::optional<Aimed>& aimed = {}) const;
  // As LightLike's pdf; of the one direction of a delta light 1.
  double direction_pdf(const Light& light, const Vec3& ref, const Vec3& wi, const SurfacePoint* met) const {
    return light.is_delta() ? 1 : double(light.pdf(ref, wi, met));
  }
  // Per area across the line through p along d.
  double across(const Vec3& p, const Vec3& d) const;

  struct Walk {
    Ray ray;
    Vec3 previous;
    Spectrum beta;
    double area;
    Odds odds;
    Media media = {};
    Float full = 0;          ///< the largest component of beta at first
    double connection2 = 0;  ///< squared density of the connection from the first vertex to the light [1/sr^2]
    bool from_delta = false; ///< the light is not met by chance
    int edges = 0;
  };
  // Density of paths from the camera that go on from `at`, where they come from wi, by chance the way that this came.
  template <class B>
  double pdf_of_camera(const Vertex<B>& at, const Walk& walk, const Vec3& wi, bool narrow, Float eta) const {
    if (narrow) return reverse_pdf(at.bsdf, at.wo, wi, narrow, eta);
    return double(of_camera_.pdf(Vertex<B>{at.bsdf, at.point, at.frame, wi}, at.wo, -walk.ray.d));
  }
  // Squared, with that of a connection.
  template <class B>
  double reverse2(const Vertex<B>& at, const Walk& walk, const Vec3& wi, bool narrow, Float eta) const {
    const bool first = walk.edges == 1;
    const double by_chance = first && walk.from_delta ? 0 : mc::sqr(pdf_of_camera(at, walk, wi, narrow, eta));
    return first && !narrow ? by_chance + walk.connection2 : by_chance;
  }
  // Light meets a surface by its true cosine, and the BSDF reckons with that of the shading normal.
  template <class B> static Float shading(const Vertex<B>& at) {
    if (at.point.ns == at.point.ng) return 1;
    return std::abs(at.wo.z() / at.frame.to_world(at.wo).dot(at.point.ng));
  }
  template <class Stream, class Give>
  void connect(const Meeting<Bsdf>& at, const Walk& walk, Stream& stream, std::uint64_t& rays, const Give& give) const;
  template <class Stream> bool scatter(const Meeting<Bsdf>& at, Walk& walk, Stream& stream) const;

  const Scene* scene_;
  double rate_;
  Vec2 tan_half_;
  mc::TableDist1D<Float> lights_;
  std::vector<Shape> casters_;        ///< balls that paths from infinite lights are aimed at
  std::vector<const Shape*> targets_; ///< those of them that paths from the others are aimed at
  Directions starts_, follows_, of_camera_;
  mc::Bernoulli<Float> aims_; ///< of paths from points
  bool absorbs_;              ///< some surface holds a medium
  Bsdf lamp_;                 ///< as whose reflection a lamp's light leaves it
};

/// The strategies that find every light of the scene, each once: without mis+lt where it is mis.
std::vector<Strategy> strategies_for(const Scene& scene);

template <class Stream>
std::optional<LightPaths::Start> LightPaths::sample_start_at(const AreaLight& lamp, double pmf, const Vec2& u,
                                                             Stream& stream) const {
  auto point = lamp.shape().sample_area(u);
  if (!point) return {};
  if (lamp.is_two_sided() && mc::Bernoulli<Float>(Float(0.5)).sample_index(stream.next()).index == 1)
    point->ng = -point->ng;
  point->ns = point->ng;
  const auto frame = mc::Frame<Float>::from_z(point->ng);
  const auto next = starts_.choose(Vertex<Bsdf>{lamp_, *point, frame, Vec3::UnitZ()}, stream);
  if (!next || is_black(next->weight)) return {};
  const double sides = lamp.is_two_sided() ? 2 : 1, area_pdf = pmf / lamp.shape().area();
  return Start{point->spawn_ray(next->d), point, lamp.radiance() * next->weight, mc::pi<double> * sides / area_pdf,
               Odds(1 / mc::sqr(area_pdf), double(next->pdf) / sides, std::abs(double(point->ng.dot(next->d))))};
}

template <class Stream>
std::optional<LightPaths::Start> LightPaths::sample_start_afar(const Light& light, double pmf, const Vec2& u,
                                                               Stream& stream) const {
  const auto s = light.sample(Vec3::Zero(), u);
  if (!s || is_black(s->radiance)) return {};
  const std::size_t target = mc::UniformDiscrete<Float>(casters_.size()).sample_index(stream.next()).index;
  const Sphere& aim = std::get<Sphere>(casters_[target]);
  const Vec2 disk = mc::UniformDisk<Float>{}.sample(stream.next2());
  const Vec3d wi = s->wi.template cast<double>();
  const Vec3d across_ball = mc::Frame<Float>::from_z(s->wi).to_world({disk[0], disk[1], 0}).template cast<double>();
  const Vec3d crossing = aim.center() + aim.radius() * across_ball;
  // No further away than before all that may shade the ball: a float resolves little of one beside a huge ground.
  const Vec3 p = (crossing + (scene_->bounds().last(crossing, wi) + aim.radius()) * wi).template cast<Float>();
  const double pdf = pmf * double(s->pdf), area_pdf = across(p, s->wi);
  if (!(area_pdf > 0)) return {}; // rounding
  return Start{{p, -s->wi}, {}, s->radiance / Float(pdf), 1 / area_pdf, Odds(1 / mc::sqr(pdf), area_pdf, 1)};
}

template <class Stream>
std::optional<LightPaths::Start> LightPaths::sample_start(std::uint32_t light, const Vec2& u, Stream& stream) const {
  const auto pmf = double(lights_.pmf(light));
  const Light& source = scene_->lights()[light];
  if (const auto* lamp = std::get_if<AreaLight>(&source)) return sample_start_at(*lamp, pmf, u, stream);
  if (const auto* lamp = std::get_if<PointLight>(&source)) return sample_start_from(*lamp, pmf, u);
  return sample_start_afar(source, pmf, u, stream);
}

template <class Stream, class Give>
void LightPaths::trace(Stream& stream, int max_depth, std::uint64_t& rays, const Give& give) const {
  const Vec2 u = stream.next2();
  const auto choice = lights_.sample_index(u[0]);
  const auto light = static_cast<std::uint32_t>(choice.index);
  const auto begin = sample_start(light, {choice.u_remapped, u[1]}, stream);
  if (!begin) return;
  const SurfacePoint* source = begin->point ? &*begin->point : nullptr;
  Walk walk{begin->ray, source ? source->p : begin->ray.o, begin->beta, begin->area, begin->odds};
  walk.from_delta = scene_->lights()[light].is_delta();
  walk.full = walk.beta.maxCoeff();
  if (absorbs_) [[unlikely]]
    walk.media = media_at(*scene_, walk.ray);
  while (max_depth < 0 || walk.edges + 1 < max_depth) {
    ++walk.edges;
    const auto hit = meet(*scene_, walk.ray, rays, [&](Float opacity) {
      return opacity == 0 || mc::Bernoulli<Float>(opacity).sample_index(stream.next()).index == 0;
    });
    if (!hit) return;
    const Surface& surface = scene_->surface(*hit);
    const SurfacePoint point = surface.shape->surface_point(walk.ray, *hit);
    const bool from_afar = walk.edges == 1 && !source;
    const double distance2 = (point.p - walk.previous).template cast<double>().squaredNorm();
    if (walk.media.here) [[unlikely]]
      walk.beta *= walk.media.here->transmittance(from_afar ? mc::infinity<Float> : Float(std::sqrt(distance2)));
    const double cosine = std::abs(double(point.ng.dot(walk.ray.d)));
    if (walk.edges == 1 && walk.from_delta) walk.odds.meet_from_point(cosine, from_afar ? 1 : distance2);
    else walk.odds.meet(cosine, from_afar ? 1 : distance2);
    const auto frame = mc::Frame<Float>::from_z(point.ns);
    std::optional<Bsdf> varied;
    const Meeting<Bsdf> at{
        {scene_->bsdf(surface, *hit, point, varied), point, frame, frame.to_local(-walk.ray.d)}, surface, walk.media};
    if (walk.edges == 1)
      walk.connection2 = mc::sqr(double(scene_->light_pmf(point.p, light)) *
                                 direction_pdf(scene_->lights()[light], point.p, -walk.ray.d, source));
    if (walk.edges > 1 && !at.bsdf.is_narrow()) connect(at, walk, stream, rays, give);
    if (!scatter(at, walk, stream)) return;
  }
}

template <class Stream, class Give>
void LightPaths::connect(const Meeting<Bsdf>& at, const Walk& walk, Stream& stream, std::uint64_t& rays,
                         const Give& give) const {
  const ThinLens& camera = scene_->camera();
  const auto seen =
      camera.sample_lens(at.point.p, tan_half_, camera.radius() > 0 ? stream.next2() : Vec2(Vec2::Zero()));
  if (!seen) return;
  const Vec3 wi = at.frame.to_local(seen->d);
  if (!is_real(at, wi, seen->d)) return;
  const Spectrum f = at.bsdf.eval(wi, at.wo);
  if (is_black(f)) return;
  Ray ray = at.point.spawn_ray(seen->d);
  ray.t_max = seen->reach;
  const Float open = open_share(*scene_, ray, {}, rays);
  if (open == 0) return;
  const double from_camera =
      double(seen->density) * std::abs(double(at.point.ng.dot(seen->d))) / mc::sqr(double(seen->distance));
  const double odds = walk.odds.with(reverse2(at, walk, wi, false, 1)) * mc::sqr(from_camera / rate_);
  Spectrum value = open * walk.beta * f;
  if (const HomogeneousMedium* medium = at.media(seen->d).here) [[unlikely]]
    value *= medium->transmittance(seen->distance);
  give(seen->s, Spectrum(value * Float(walk.area * from_camera / (rate_ * (1 + odds))) * shading(at)));
}

template <class Stream> bool LightPaths::scatter(const Meeting<Bsdf>& at, Walk& walk, Stream& stream) const {
  const auto next = follows_.choose(at, stream);
  if (!next) return false;
  const bool narrow = next->pdf == 0;
  const Vec3 wi = at.frame.to_local(next->d);
  const double cosine = std::abs(double(at.point.ng.dot(next->d)));
  // A connection to a light that no chance meets may use what chance follows as a narrow lobe.
  const bool as_narrow = narrow && (walk.edges > 1 || !walk.from_delta || at.bsdf.has_delta());
  Float pdf = next->pdf;
  if (narrow) pdf = as_narrow ? Float(1) : at.bsdf.pdf(at.wo, wi);
  // Light goes from wo to wi, and not all BSDFs are reciprocal; those of narrow lobes are but for the compression in
  // glass, which does not change what a path carries.
  const Spectrum weight = narrow ? Spectrum(next->weight * (mc::sqr(next->eta) / std::abs(wi.z())))
                                 : Spectrum(at.bsdf.eval(wi, at.wo) / next->pdf);
  walk.beta *= weight * (shading(at) * Float(cosine));
  if (is_black(walk.beta)) return false;
  walk.odds.turn(reverse2(at, walk, wi, as_narrow, next->eta), double(pdf), cosine);
  if (walk.edges >= 4) {
    const Float survival =
        std::clamp(4 * walk.beta.maxCoeff() / walk.full, std::numeric_limits<Float>::min(), Float(0.99));
    const auto roulette = mc::russian_roulette<Float>(survival, stream.next());
    if (!roulette.survives) return false;
    walk.beta *= roulette.weight;
  }
  walk.previous = at.point.p;
  walk.ray = at.point.spawn_ray(next->d);
  walk.media = at.media(next->d);
  return true;
}

} // namespace render
