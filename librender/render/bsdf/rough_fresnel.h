#pragma once
/// What a rough coat does with all the light of one direction.

#include <render/core/types.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace render {

/// The shares of the light from one direction that the facets of GGX, of a boundary to a medium of relative index eta,
/// reflect and let through. What would meet a second facet is in neither, so that their sum is at most 1.
///   of     : by a table, linear in the cosine between its nodes. transmitted within .002 for eta in [1.01, 3], and
///            within .02 below 1, where it starts with a steep slope at the critical angle; reflected, which steers
///            samples, within .02 and .07
///   mean_transmitted : what is let through of light that comes from everywhere, 2 int T cos dcos: exactly that of the
///            table
///   Source : the facets of [WalterEtAl07], as Mitsuba 0.6 integrates them for its rough plastic
class RoughFresnel {
 public:
  struct Albedos {
    Float reflected, transmitted;
  };

  /// alpha 0 for a smooth coat or in [1e-4, 1], eta > 0, both checked by those who have them.
  RoughFresnel(Float eta, Float alpha);

  Albedos eval(Float cosine) const {
    const std::vector<Node>& nodes = *nodes_;
    const std::size_t i = cell(cosine);
    const Node &a = nodes[i], &b = nodes[i + 1];
    const Float t = std::clamp((cosine - a.cosine) / (b.cosine - a.cosine), Float(0), Float(1));
    return {a.reflected + t * (b.reflected - a.reflected), a.transmitted + t * (b.transmitted - a.transmitted)};
  }
  Float mean_transmitted() const { return mean_transmitted_; }

 private:
  struct Node {
    Float cosine, reflected, transmitted;
  };
  static constexpr std::size_t above = 64, below = 32; ///< cells on the sides of the critical angle

  /// Nodes stand the closer the nearer they are to the critical angle, or to the horizon where there is none.
  std::size_t cell(Float cosine) const {
    if (cosine >= critical_) {
      const Float x = std::sqrt((cosine - critical_) / (1 - critical_)) * above;
      return cells_below_ + std::min(static_cast<std::size_t>(x), above - 1);
    }
    const Float x = std::sqrt(std::sqrt(1 - cosine / critical_)) * below;
    return below - 1 - std::min(static_cast<std::size_t>(x), below - 1);
  }

  std::shared_ptr<const std::vector<Node>> nodes_;
  Float critical_;          ///< cosine from which on light is let through by a smooth coat
  std::size_t cells_below_; ///< 0 or `below`
  Float mean_transmitted_ = 0;
};

} // namespace render
