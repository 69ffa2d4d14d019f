#pragma once
/// Weights of paths that could have been found from the other end.

#include <render/core/types.h>

#include <algorithm>
#include <cmath>

namespace render {

/// Density of leaving by wo [1/sr], for a path that comes from wi, where one that came from wo left by wi. Of a narrow
/// lobe over the density of the latter, in which case both have 1 for it: a lobe has the same probability both ways,
/// and refraction takes solid angles d omega_o to d omega_i = cos_o / (eta^2 cos_i) d omega_o.
template <class B> double reverse_pdf(const B& bsdf, const Vec3& wo, const Vec3& wi, bool near_specular, Float eta) {
  if (near_specular) return std::abs(double(wo.z())) / (mc::sqr(double(eta)) * std::abs(double(wi.z())));
  return double(bsdf.pdf(wi, wo));
}

/// The squared density of paths that come from the other end over that of one under way, as far as both are known: of
/// the others it lacks the last vertex that was met and the one before, as where they come from decides about these.
/// Squares, since the power heuristic [Veach97] adds them. Densities per area, by the true surfaces' cosines.
class PartialMisWeight {
 public:
  PartialMisWeight() = default;
  /// initial_ratio : the squared density of what others have at this end, over that of starting there
  /// pdf_fwd   : of the first direction [1/sr]; cosine: of it where the path starts
  PartialMisWeight(double initial_ratio, double pdf_fwd, double cosine)
      : squared_ratio_(initial_ratio), pdf_fwd_(pdf_fwd), cosine_(cosine) {}

  /// At the next vertex.
  void add_vertex(double cosine, double distance2) {
    constexpr double least = 1e-60; // rounding makes both 0
    const double d2 = std::max(distance2, least);
    squared_ratio_ /= mc::sqr(pdf_fwd_ * std::max(cosine, least) / d2);
    rev_to_area_ = cosine_ / d2;
  }
  /// At the first vertex from a camera or a point light, to which others connect: there is no direction for them to
  /// choose.
  void add_vertex_from_point(double cosine, double distance2) {
    add_vertex(cosine, distance2);
    rev_to_area_ = 1;
  }
  /// On by a direction of density `pdf_fwd` at a cosine; the others would come back with the squared density `pdf_rev_squared`.
  void scatter(double pdf_rev_squared, double pdf_fwd, double cosine) {
    squared_ratio_ *= pdf_rev_squared * mc::sqr(rev_to_area_);
    pdf_fwd_ = pdf_fwd;
    cosine_ = cosine;
  }
  /// With the vertex before, to which others come back with the squared density `pdf_rev_squared` [1/sr^2].
  double squared_ratio(double pdf_rev_squared) const {
    return squared_ratio_ * pdf_rev_squared * mc::sqr(rev_to_area_);
  }

 private:
  double squared_ratio_ = 1, pdf_fwd_ = 1, cosine_ = 1;
  double rev_to_area_ =
      0; ///< a density [1/sr] at the vertex just met, times this, is one per area at the vertex before
};

} // namespace render
