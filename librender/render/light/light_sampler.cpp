#include <render/light/light_sampler.h>

#include <array>
#include <numeric>

namespace render {

namespace {

// Adds a uniform part of 1/3.
void add_defensive_part(std::span<double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w += sum / (2 * double(weights.size()));
}

} // namespace

std::optional<LightSampler> LightSampler::create(std::span<const Light> lights, double radius) {
  LightSampler sampler;
  std::vector<double> powers;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const double power = lights[i].is_sampled() ? lights[i].power(radius) : 0;
    auto& candidate_index = sampler.candidate_index_.emplace_back();
    if (!(power > 0)) continue;
    candidate_index = static_cast<std::uint32_t>(sampler.candidates_.size());
    sampler.candidates_.push_back(i);
    powers.push_back(power);
  }
  if (powers.empty()) return {};
  if (powers.size() > max_weighted_lights) {
    add_defensive_part(powers);
    sampler.power_distribution_.emplace(powers);
  }
  return sampler;
}

mc::ShortDiscrete<Float, LightSampler::max_weighted_lights> LightSampler::distribution_at(std::span<const Light> lights,
                                                                                          const Vec3& ref) const {
  std::array<double, max_weighted_lights> weights;
  const std::span<double> used(weights.data(), candidates_.size());
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = lights[candidates_[i]].irradiance(ref);
  add_defensive_part(used);
  // Normalised, since floats would not represent every irradiance.
  const double sum = std::accumulate(used.begin(), used.end(), 0.0);
  std::array<Float, max_weighted_lights> shares;
  for (std::size_t i = 0; i < used.size(); ++i) shares[i] = Float(used[i] / sum);
  return mc::ShortDiscrete<Float, max_weighted_lights>(std::span<const Float>(shares.data(), used.size()));
}

mc::DiscreteSample<Float> LightSampler::sample_index(std::span<const Light> lights, const Vec3& ref, Float u) const {
  if (candidates_.size() == 1) return {candidates_[0], 1, u};
  const auto s =
      power_distribution_ ? power_distribution_->sample_index(u) : distribution_at(lights, ref).sample_index(u);
  return {candidates_[s.index], s.pmf, s.u_remapped};
}

Float LightSampler::pmf(std::span<const Light> lights, const Vec3& ref, std::size_t light) const {
  const auto candidate_index = candidate_index_[light];
  if (!candidate_index) return 0;
  if (candidates_.size() == 1) return 1;
  return power_distribution_ ? power_distribution_->pmf(*candidate_index)
                             : distribution_at(lights, ref).pmf(*candidate_index);
}

} // namespace render
