#pragma once
/// What a law of BSDFs is: one function in a file of its own, one row of the table in bsdf_laws.cpp.

#include <mc/check/laws/worst_error.h>
#include <mc/check/report/report.h>
#include <mc/check/subject/any_bsdf.h>
#include <mc/check/subject/any_distribution.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mc {

/// f, both ways where that means something, and the density of one pair of directions.
struct DirectionPair {
  AnyBsdf::Direction wi;
  bool transmitted = false; ///< wo and wi lie on two sides of the surface
  bool has_reverse = false; ///< f_reverse is f(wi, wo)
  Channels f, f_reverse;
  double pdf = 0;
};

/// What the laws look at: one BSDF seen from one direction.
struct BsdfView {
  const AnyBsdf& bsdf;
  AnyBsdf::Direction wo;
  const BsdfOptions& options;
  std::vector<DirectionPair> pairs; ///< at sampled wi and at uniform ones
  bool transmissive = false;        ///< light crosses the surface, so directions on its other side mean something
};

struct BsdfFindings {
  std::vector<Check> checks;
  std::vector<ReportedValue> figures;
};
using BsdfLaw = BsdfFindings(const BsdfView& view);

/// The largest |a / b - 1| over the channels, 0 where both are 0.
double relative_difference(double a, double b);
double relative_difference(const Channels& a, const Channels& b);
Channels scaled(Channels f, double factor);

/// |cos wi| where eval leaves it out.
double cosine_factor(const AnyBsdf::Direction& wi, const BsdfOptions& options);
/// What one sample stands for: f |cos| / pdf per channel; 0 where pdf = 0.
Channels throughput(const AnyBsdf::Sample& sample, const BsdfOptions& options);
/// The squared index of the medium that w runs in, which radiance carries.
double squared_index(const AnyBsdf::Direction& w, const BsdfOptions& options);
/// "wo = (0.6, 0, 0.8) [theta 36.9 deg, phi 0 deg], wi = ..."
std::string describe(const BsdfView& view, const DirectionPair& pair);
/// "(0.6, 0, 0.8) [theta 36.9 deg, phi 0 deg]"
std::string describe_direction(const AnyBsdf& bsdf, const AnyBsdf::Direction& w);

/// The BSDF with fixed wo as a sampler on the sphere of wi. Delta lobes, at most one on either side, become discrete
/// outcomes: 0 reflection, 1 transmission.
///   weight : 1 where the f, weight and pdf of a sample agree with eval and pdf, or a delta lobe repeats its
///            probability
AnyDistribution bsdf_distribution(const AnyBsdf& bsdf, const AnyBsdf::Direction& wo, const BsdfOptions& options);

} // namespace mc
