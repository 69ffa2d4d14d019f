#pragma once
/// Tests the limit of a family of rough BSDFs at zero roughness.

#include <mc/check/laws/bsdf/bsdf_law.h>

namespace mc {

/// Options of check_limit.
struct RoughnessLimitOptions {
  BsdfOptions bsdf;
  /// Lipschitz constants: a roughness r may change means by slope * r, and f by slope times the relative change of r.
  double slope = 4;
  double noise = 1e-4; ///< rounding error of the means, conceded to them
  int samples = 20'000;
};

/// A family of BSDFs with its smooth limit and a fixed wo, the input of the laws of roughness.
struct RoughnessFamily {
  const std::function<AnyBsdf(double r)>& family;
  const AnyBsdf& limit;
  AnyBsdf::Direction wo;
  const RoughnessLimitOptions& options;
};

/// Tests the continuity of a family of BSDFs in roughness, for one wo. family(r) is the BSDF of roughness r in (0, 1];
/// `limit` is the smooth BSDF.
///   sample : the means of weight, of weight * wi and of the absorbed fraction approach the means of the limit. For r =
///            2^-2, 2^-4, ..., 2^-16 they differ by at most slope r + noise + five standard errors. Both sides use the
///            same random numbers, which keeps the standard errors small.
///   eval   : f at r (1 + d) approaches f at r, for r = 1, 1/4, ..., 2^-10 and d = -1/16, -1/64, -1/256. The mean of
///            |f' - f| |cos| / pdf over samples at r is at most slope |d| + noise + five standard errors. If check_bsdf
///            confirms mass 1 at every r, eval thus approaches the lobe of the limit, since the samples do.
std::vector<Check> check_limit(const std::function<AnyBsdf(double r)>& family, const AnyBsdf& limit,
                               const AnyBsdf::Direction& wo, const RoughnessLimitOptions& options = {});

/// The same for BSDFs over scalar S.

template <Real S, class Family, SamplesDirections<S> Limit>
std::vector<Check> check_roughness_limit(const Family& family, const Limit& limit, const Vec3<S>& wo,
                                         const RoughnessLimitOptions& options = {}) {
  return check_limit([&](double r) { return any_bsdf<S>(family(static_cast<S>(r))); }, any_bsdf<S>(limit),
                     AnyBsdf::Direction(wo.template cast<double>()), options);
}

} // namespace mc
