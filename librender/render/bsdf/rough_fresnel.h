#pragma once
/// Directional albedo of a rough dielectric coat.

#include <render/bsdf/microfacet.h>

#include <algorithm>
#include <cmath>
#include <functional>
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
///          .07. It only controls sampling. Interpolation between roughnesses adds .02 to each, at grazing angles or
///          near the critical angle.
///   mean_transmitted : transmitted share of uniform light, 2 int T cos dcos; exact for the interpolated table.
///   Source : facets of [WalterEtAl07], integrated as in Mitsuba 0.6's roughplastic.
class RoughFresnel {
 public:
  /// Shares of light.
  struct Albedos {
    Float reflected, ///< Reflected share.
        transmitted; ///< Transmitted share.
  };

  /// Computes the table of facets of one roughness. The caller checks the arguments.
  ///   eta : relative index > 0.
  RoughFresnel(Float eta, const CoatFacets& facets);
  /// Computes tables for all roughnesses, between which set_alpha() interpolates linearly. The roughness is 1 at first.
  ///   facets_of(alpha) : facets of a roughness.
  static RoughFresnel of_all_roughnesses(Float eta, const std::function<CoatFacets(Float alpha)>& facets_of);

  /// Changes the roughness, if there are tables for all.
  void set_alpha(Float alpha);

  /// Shares of light from a direction of this cosine.
  Albedos eval(Float cosine) const {
    const std::size_t i = cell(cosine);
    const Node &a = first_->nodes[i], &b = first_->nodes[i + 1];
    const Float t = std::clamp((cosine - a.cosine) / (b.cosine - a.cosine), Float(0), Float(1));
    const Albedos low = mix(a, b, t);
    return weight_ == 0 ? low : mix(low, mix(first_[1].nodes[i], first_[1].nodes[i + 1], t), weight_);
  }
  /// Transmitted share of uniform light.
  Float mean_transmitted() const { return mean_transmitted_; }

 private:
  struct Node : Albedos {
    Float cosine;
  };
  /// Nodes of one roughness.
  struct Table {
    std::vector<Node> nodes;
    Float mean_transmitted = 0;
  };
  static constexpr std::size_t above = 64, below = 32; ///< Numbers of cells above and below the critical angle
  static constexpr int roughnesses = 16; ///< Number of intervals of roughness: their ends are cubes of i / 16

  static Albedos mix(const Albedos& a, const Albedos& b, Float t) {
    return {a.reflected + t * (b.reflected - a.reflected), a.transmitted + t * (b.transmitted - a.transmitted)};
  }
  explicit RoughFresnel(Float eta);
  static Float alpha_of_table(int i);
  Table table_of(Float eta, const CoatFacets& facets) const;

  // Cell of a cosine. Nodes are dense near the critical angle, or near the horizon if there is no critical angle.
  std::size_t cell(Float cosine) const {
    if (cosine >= critical_) {
      const Float x = std::sqrt((cosine - critical_) / (1 - critical_)) * above;
      return cells_below_ + std::min(static_cast<std::size_t>(x), above - 1);
    }
    const Float x = std::sqrt(std::sqrt(1 - cosine / critical_)) * below;
    return below - 1 - std::min(static_cast<std::size_t>(x), below - 1);
  }

  std::shared_ptr<const std::vector<Table>> tables_; ///< One, or one per end of an interval of roughness
  const Table* first_ = nullptr;                     ///< The table in use
  Float weight_ = 0;                                 ///< Weight of the table after it
  Float critical_;          ///< Cosine of the critical angle: a smooth coat transmits light of larger cosines
  std::size_t cells_below_; ///< 0 or `below`
  Float mean_transmitted_ = 0;
};

} // namespace render
