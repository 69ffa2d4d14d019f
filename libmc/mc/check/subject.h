#pragma once
/// Anything that draws points with a claimed density, reduced to what the statistical tests need.

#include <mc/domain/concept.h>
#include <mc/random/pcg.h>
#include <mc/warp/concept.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace mc {

/// A sampler with its claimed density, seen through the chart of its domain: the tests live on the unit cube and never ask
/// what the domain was. Warps, lambdas, BSDFs, tables, plugins and files of samples all become Subjects.
struct Subject {
  std::string name;
  int dim = 0;

  /// One draw: chart coordinates in [0,1]^dim, or why there are none.
  struct Draw {
    enum class Kind : std::uint8_t { point, failed, outside, not_finite, atom } kind = Kind::point;
    std::array<double, 3> v{};   ///< chart coordinates; unused entries are 0
    double weight = 1;           ///< claimed weight * pdf / f where the sampler states a weight; 1 when it agrees
    bool pdf_positive = true;    ///< the claimed density at the drawn point is positive and finite
    int atom = -1;               ///< index of a discrete outcome (delta lobe, table index)
  };
  /// Appends n draws of the stream `seed` to `out`. Same seed, same draws.
  std::function<void(std::uint64_t seed, std::size_t n, std::vector<Draw>& out)> draw;

  /// Claimed density in chart coordinates, pdf(from_unit(v)) * jacobian(v): integrates to 1 - failure - atoms.
  std::function<double(const std::array<double, 3>& v)> density;

  /// Claimed probabilities of the discrete outcomes; empty for a continuous subject.
  std::vector<double> atoms;
  /// Whether the sampler may fail (return nothing); then the density integrates to 1 - P(failure).
  bool may_fail = false;
};

} // namespace mc
