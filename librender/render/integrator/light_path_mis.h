#pragma once
/// MIS weights of camera paths against light paths.

#include <render/integrator/direct_lighting.h>
#include <render/integrator/light_tracer.h>

namespace render {

/// Policy of a PathIntegrator whose paths compete with the paths of a LightTracer. Each ratio is the squared density of
/// light paths over the squared density of the camera path, for the power heuristic [Veach97]; 0: no light path finds
/// the light.
///   edges       : number of edges of the camera path at this vertex.
///   partial_mis : the ratio so far.
class LightPathMis {
 public:
  /// The ratio along a camera path.
  using PartialWeight = PartialMisWeight;

  /// Weights against the paths of `light_tracer`, which must outlive this.
  explicit LightPathMis(const LightTracer& light_tracer) : light_tracer_(&light_tracer) {}

  /// Direction sampling of the camera paths.
  DirectionMixture directions(const Scene&, const Strategy&) const { return light_tracer_->camera_mixture(); }

  /// Start of a path with the camera direction d.
  PartialMisWeight start(const Vec3& d) const { return {1, light_tracer_->camera_pdf(d), 0}; }

  /// The path arrives at `point` from the point `from`, in the direction d.
  void arrive(PartialMisWeight& partial_mis, int edges, const Vec3& from, const Vec3& d,
              const SurfacePoint& point) const {
    const double cosine = std::abs(double(point.ng.dot(d)));
    const double distance2 = (point.p - from).cast<double>().squaredNorm();
    if (edges > 1) partial_mis.add_vertex(cosine, distance2);
    else partial_mis.add_vertex_from_point(cosine, mc::sqr(light_tracer_->camera().spread(std::sqrt(distance2))));
  }

  /// The path leaves the scene.
  void escape(PartialMisWeight& partial_mis) const { partial_mis.add_vertex(1, 1); }

  /// The path scatters.
  template <class B>
  void scatter(PartialMisWeight& partial_mis, int edges, const ShadingPoint<B>& isect,
               const ScatterSample& next) const {
    const Vec3 wi = isect.frame.to_local(next.d);
    const double cosine = std::abs(double(isect.point.ng.dot(next.d)));
    if (next.pdf > 0) return partial_mis.scatter(pdf_rev_squared(edges, isect, wi), double(next.pdf), cosine);
    // light paths do not connect to the camera there, and scatter only by reversible lobes
    const bool competes = edges > 1 && next.reversible;
    partial_mis.scatter(competes ? mc::sqr(near_specular_reverse_pdf(isect.wo, wi, next.eta)) : 0, 1, cosine);
  }

  /// Ratio for a path that hits a light.
  ///   light_point : point of the light; null for infinite lights.
  ///   from, d     : previous vertex, and direction toward the light.
  double emission_ratio(const PartialMisWeight& partial_mis, int edges, std::uint32_t light,
                        const SurfacePoint* light_point, const Vec3& from, const Vec3& d) const {
    if (edges < LightTracer::min_edges) return 0;
    return partial_mis.squared_ratio(light_tracer_->emission_pdf_squared(light, light_point, from, d));
  }

  /// Ratio for a connection from `isect` to a light.
  template <class B>
  double direct_ratio(const PartialMisWeight& partial_mis, int edges, const ShadingPoint<B>& isect,
                      const LightConnection& light) const {
    if (edges + 1 < LightTracer::min_edges) return 0;
    const Vec3& wi = light.sample.wi;
    const SurfacePoint* end = light.sample.point ? &*light.sample.point : nullptr;
    const double at_light = end ? std::abs(double(end->ng.dot(wi))) : 1,
                 here = std::abs(double(isect.point.ng.dot(wi)));
    return partial_mis.squared_ratio(pdf_rev_squared(edges, isect, isect.frame.to_local(wi))) *
           light_tracer_->emission_pdf_squared(light.index, end, isect.point.p, wi) *
           mc::sqr(here / (double(light.pdf) * at_light));
  }

  /// Ratio for a path that continues from `isect` to a diffuse vertex `next` in the direction d, up to a factor that
  /// depends on `next` alone.
  ///   pdf : density of d [1/sr].
  template <class B>
  double reconnection_ratio(PartialMisWeight partial_mis, int edges, const ShadingPoint<B>& isect,
                            const SurfacePoint& next, const Vec3& d, Float pdf) const {
    scatter(partial_mis, edges, isect, {.d = d, .weight = {}, .pdf = pdf, .eta = 1, .guiding_pdf_ratio = 1});
    const Vec3 way = next.p - isect.point.p;
    partial_mis.add_vertex(std::abs(double(next.ng.dot(d))), way.cast<double>().squaredNorm());
    const Lambert matte; // its density of -d is the same for all directions from which light arrives
    const ShadingPoint at(matte, next, -d);
    return partial_mis.squared_ratio(mc::sqr(double(at.pdf(at.wo))));
  }

 private:
  // Squared density with which a light path that arrives at `isect` from wi scatters back along the camera path.
  template <class B> static double pdf_rev_squared(int edges, const ShadingPoint<B>& isect, const Vec3& wi) {
    if (edges == 1) return 1; // at the first vertex light paths connect to the camera
    return mc::sqr(double(isect.reverse_pdf(wi)));
  }

  const LightTracer* light_tracer_;
};

} // namespace render
