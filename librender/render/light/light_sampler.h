#pragma once
/// Which light to connect to.

#include <render/light/light.h>

#include <mc/table/discrete.h>
#include <mc/table/table_dist_1d.h>

#include <optional>
#include <span>
#include <vector>

namespace render {

/// Chooses among the lights that are sampled and not dark, as it suits the point that is lit: two times of three by
/// Light::irradiance there, or where there are more than `max_weighted_lights`, by their power; else all alike, since what could give
/// most may stand behind a wall, or beside what a glossy surface mirrors. So none of n lights has a probability below
/// 1 / (3 n), wherever it stands. With a uniform part of a tenth veach-mi, metals and tinted-glass take half as much
/// time again to a given error, and no scene of the gallery takes clearly less.
///   Source : the uniform part is a defensive mixture [Hesterberg95]
class LightSampler {
 public:
  static constexpr std::size_t max_weighted_lights = 16;

  /// None where no light can be chosen. The lights must outlive it; a ball of `radius` holds the scene.
  static std::optional<LightSampler> create(std::span<const Light> lights, double radius);

  /// An index into the lights.
  mc::DiscreteSample<Float> sample_index(std::span<const Light> lights, const Vec3& ref, Float u) const;
  /// Its probability; 0 of lights that are never chosen.
  Float pmf(std::span<const Light> lights, const Vec3& ref, std::size_t light) const;

 private:
  mc::ShortDiscrete<Float, max_weighted_lights> distribution_at(std::span<const Light> lights, const Vec3& ref) const;

  std::vector<std::uint32_t> candidates_;
  std::vector<std::optional<std::uint32_t>> candidate_index_; ///< of a light among the candidates, if it is one
  std::optional<mc::TableDist1D<Float>> power_distribution_;  ///< where they are many
};

} // namespace render
