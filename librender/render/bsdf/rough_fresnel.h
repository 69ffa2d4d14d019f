#pragma once
/// Directional albedo of a rough dielectric coat.

#include <render/bsdf/microfacet.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>
#include <vector>

namespace render {

/// Facets of a coat; none where it is smooth.
using CoatFacets = std::variant<std::monostate, TrowbridgeReitzFacets, BeckmannFacets>;

/// Shares of the light from one direction that a rough dielectric boundary of the relative index eta reflects and
/// transmits. Light that would hit a second facet is lost, so the sum is at most 1.
///   eval : interpolates a table linearly in the cosine. Error of `transmitted`: .002 for eta in [1.01, 3] and .02 for
///          eta < 1, where it has a steep slope at the critical angle. Error of `reflected` in these ranges: .02 and
///          .07. It only controls sampling.
///   mean_transmitted : transmitted share of uniform light, 2 int T cos dcos; exact for the interpolated table.
///   Source : facets of [WalterEtAl07], integrated as in Mitsuba 0.6's roughplastic.
class RoughFresnel {
 public:
  /// Shares of light.
  struct Albedos {
    Float reflected, ///< Reflected share.
        transmitted; ///< Transmitted share.
  };

  /// Builds the table. The caller checks the arguments.
  ///   eta : relative index > 0.
  RoughFresnel(Float eta, const CoatFacets& facets);

  /// Shares of light from a direction of this cosine.
  Albedos eval(Float cosine) const {
    const std::vector<Node>& nodes = *nodes_;
    const std::size_t i = cell(cosine);
    const Node &a = nodes[i], &b = nodes[i + 1];
    const Float t = std::clamp((cosine - a.cosine) / (b.cosine - a.cosine), Float(0), Float(1));
    return {a.reflected + t * (b.reflected - a.reflected), a.transmitted + t * (b.transmitted - a.transmitted)};
  }
  /// Transmitted share of uniform light.
  Float mean_transmitted() const { return mean_transmitted_; }

 private:
  struct Node {
    Float cosine, reflected, transmitted;
  };
  static constexpr std::size_t above = 64, below = 32; ///< Numbers of cells above and below the critical angle

  // Cell of a cosine. Nodes are dense near the critical angle, or near the horizon if there is no critical angle.
  std::size_t cell(Float cosine) const {
    if (cosine >= critical_) {
      const Float x = std::sqrt((cosine - critical_) / (1 - critical_)) * above;
      return cells_below_ + std::min(static_cast<std::size_t>(x), above - 1);
    }
    const Float x = std::sqrt(std::sqrt(1 - cosine / critical_)) * below;
    return below - 1 - std::min(static_cast<std::size_t>(x), below - 1);
  }

  std::shared_ptr<const std::vector<Node>> nodes_;
  Float critical_;          ///< Cosine of the critical angle: a smooth coat transmits light of larger cosines
  std::size_t cells_below_; ///< 0 or `below`
  Float mean_transmitted_ = 0;
};

} // namespace render
