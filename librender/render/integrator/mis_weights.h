#pragma once
/// Ratios of densities for multiple importance sampling over light paths and camera paths.

#include <render/core/types.h>

#include <algorithm>
#include <cmath>

namespace render {

/// Density of sampling wo from wi by a delta or near-specular lobe that sampled wi from wo, relative to the forward
/// density, which counts as 1. Both directions select the lobe with the same probability, and refraction maps solid
/// angles by d omega_i = cos_o / (eta^2 cos_i) d omega_o.
inline double near_specular_reverse_pdf(const Vec3& wo, const Vec3& wi, Float eta) {
  return std::abs(double(wo.z())) / (mc::sqr(double(eta)) * std::abs(double(wi.z())));
}

/// Squared density with which the other end would generate a path, over the squared density of the path itself. The
/// ratio is updated edge by edge, in areas with cosines to the geometric normals. Squares, because the power heuristic
/// [Veach97] adds squared densities. Reverse factors of the current and the previous vertex are missing until the
/// next directions are sampled.
class PartialMisWeight {
 public:
  /// A ratio of 1.
  PartialMisWeight() = default;
  /// The ratio at the start of a path.
  ///   initial_ratio : squared density of the other end's last step here, over the squared density of starting here.
  ///   pdf_fwd       : density of the first direction [1/sr].
  ///   cosine        : cosine of the first direction at the start of the path.
  PartialMisWeight(double initial_ratio, double pdf_fwd, double cosine)
      : squared_ratio_(initial_ratio), pdf_fwd_(pdf_fwd), cosine_(cosine) {}

  /// Advances to the next vertex, at the squared distance `distance2`; `cosine` is the cosine of arrival.
  void add_vertex(double cosine, double distance2) {
    constexpr double least = 1e-60; // keeps both positive after rounding
    const double d2 = std::max(distance2, least);
    squared_ratio_ /= mc::sqr(pdf_fwd_ * std::max(cosine, least) / d2);
    rev_to_area_ = cosine_ / d2;
  }
  /// Advances to the first vertex after a camera or a point light. The other end connects to such a point and samples
  /// no direction there.
  void add_vertex_from_point(double cosine, double distance2) {
    add_vertex(cosine, distance2);
    rev_to_area_ = 1;
  }
  /// Scatters at the current vertex into a direction of density `pdf_fwd`, with its cosine. The other end would scatter
  /// the opposite way with the squared density `pdf_rev_squared`.
  void scatter(double pdf_rev_squared, double pdf_fwd, double cosine) {
    squared_ratio_ *= pdf_rev_squared * mc::sqr(rev_to_area_);
    pdf_fwd_ = pdf_fwd;
    cosine_ = cosine;
  }
  /// The ratio, if the other end arrives at the previous vertex with the squared density `pdf_rev_squared` [1/sr^2].
  double squared_ratio(double pdf_rev_squared) const {
    return squared_ratio_ * pdf_rev_squared * mc::sqr(rev_to_area_);
  }

 private:
  double squared_ratio_ = 1, pdf_fwd_ = 1, cosine_ = 1;
  double rev_to_area_ = 0; ///< Converts a density [1/sr] at the current vertex to areas at the previous vertex.
};

} // namespace render
