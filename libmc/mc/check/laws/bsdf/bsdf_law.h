#pragma once
/// Interface of the laws of BSDFs. Each law is one function in a file of its own and one row of table.cpp:
///   Findings law(const BsdfView& view);

#include <mc/check/laws/worst_error.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/any_bsdf.h>
#include <mc/check/subject/any_distribution.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {

/// Values of f (both ways, if defined) and pdf for one pair of directions.
struct DirectionPair {
  AnyBsdf::Direction wi;
  bool transmitted = false; ///< wo and wi are on opposite sides of the surface
  bool has_reverse = false; ///< f_reverse is f(wi, wo)
  Channels f, f_reverse;
  double pdf = 0;
};

/// One BSDF with a fixed wo, the input of the laws.
struct BsdfView {
  const AnyBsdf& bsdf;
  AnyBsdf::Direction wo;
  const BsdfOptions& options;
  AnyDistribution distribution;     ///< of wi; see bsdf_distribution()
  std::vector<DirectionPair> pairs; ///< pairs with sampled and with uniform wi
  bool transmissive = false;        ///< samples cross the surface, so directions on the other side are defined
};

/// Returns the largest |a / b - 1| over the channels; 0 for equal values.
double relative_difference(double a, double b);
double relative_difference(const Channels& a, const Channels& b);
/// Returns f times a factor.
Channels scaled(Channels f, double factor);

/// Returns |cos wi| if eval leaves it out, else 1.
double cosine_factor(const AnyBsdf::Direction& wi, const BsdfOptions& options);
/// Returns the contribution of a sample, f |cos| / pdf, per channel; 0 if pdf = 0.
Channels throughput(const AnyBsdf::Sample& sample, const BsdfOptions& options);
/// Returns the squared refractive index of the medium that contains w; radiance scales with it.
double squared_index(const AnyBsdf::Direction& w, const BsdfOptions& options);
/// Returns "wo = (0.6, 0, 0.8) [theta 36.9 deg, phi 0 deg], wi = ...".
std::string describe(const BsdfView& view, const DirectionPair& pair);
/// Returns "(0.6, 0, 0.8) [theta 36.9 deg, phi 0 deg]".
std::string describe_direction(const AnyBsdf& bsdf, const AnyBsdf::Direction& w);

/// Throws Error unless wo has length 1, to 1e-5.
void require_unit(const AnyBsdf::Direction& wo);

/// Returns the distribution of wi on the sphere for a fixed wo. Delta lobes, at most one per side, become discrete
/// outcomes: 0 is reflection, 1 is transmission.
///   weight : 1 if the stated f, weight and pdf of a sample agree with eval and pdf. For a delta lobe, 1 if its stated
///            probability is constant.
AnyDistribution bsdf_distribution(const AnyBsdf& bsdf, const AnyBsdf::Direction& wo, const BsdfOptions& options);

} // namespace mc
