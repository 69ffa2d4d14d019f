#pragma once
/// Whether a family of rough BSDFs tends to its smooth limit.

#include <mc/check/laws/bsdf/bsdf_law.h>

namespace mc {

struct RoughnessLimitOptions {
  BsdfOptions bsdf;
  double slope = 4; ///< what a roughness of r may change: means by slope r, f by slope times the relative change of r
  double noise = 1e-4; ///< rounding error of the means, conceded to them
  int samples = 20'000;
};

/// Continuity in the limits of roughness, at one wo. family(r) is the BSDF of roughness r in (0, 1], `limit` what it is
/// at 0.
///   sample : the means of weight, of weight wi and of the share that is absorbed tend to those of the limit: at r =
///            2^-2, 2^-4 ... 2^-16 they differ by at most slope r + noise + five standard errors; the same random
///            numbers on both sides keep those small
///   eval   : f at r (1 + d) tends to f at r, for r = 1, 1/4 ... 2^-10 and d = -1/16, -1/64, -1/256: the mean of |f' -
///            f| |cos| / pdf over samples of r is at most slope |d| + noise + five standard errors. With mass 1 at
///            every r (check_bsdf) eval then tends to the limit's lobe, since its samples do
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
