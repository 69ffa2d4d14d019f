#pragma once
/// Selection of a light for next-event estimation.

#include <render/light/light.h>

#include <mc/table/discrete.h>
#include <mc/table/table_dist_1d.h>

#include <optional>
#include <span>
#include <vector>

namespace render {

/// Selects one of the sampled lights that are not black. With probability 2/3 the selection is in proportion to
/// Light::irradiance at the reference point, or to the power if there are more than `max_weighted_lights`. With
/// probability 1/3 it is uniform, because the strongest light may be occluded or outside a glossy reflection. So each
/// of n lights has a probability of at least 1 / (3 n).
///   Source : the uniform part is a defensive mixture [Hesterberg95].
class LightSampler {
 public:
  static constexpr std::size_t max_weighted_lights = 16; ///< Largest number of lights that are weighted by irradiance.

  /// A sampler of `lights`, which must outlive it; none if no light can be selected.
  ///   radius : radius of a ball that contains the scene.
  static std::optional<LightSampler> create(std::span<const Light> lights, double radius);

  /// Selects the index of a light for the reference point `ref`, with its probability.
  mc::DiscreteSample<Float> sample_index(std::span<const Light> lights, const Vec3& ref, Float u) const;
  /// Probability of selecting a light; 0 for lights that are never selected.
  Float pmf(std::span<const Light> lights, const Vec3& ref, std::size_t light) const;

 private:
  mc::ShortDiscrete<Float, max_weighted_lights> distribution_at(std::span<const Light> lights, const Vec3& ref) const;

  std::vector<std::uint32_t> candidates_;
  /// Index of each light among the candidates, if it is one.
  std::vector<std::optional<std::uint32_t>> candidate_index_;
  std::optional<mc::TableDist1D<Float>> power_distribution_; ///< Distribution by power, for many lights.
};

} // namespace render
