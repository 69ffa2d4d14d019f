#include <render/light/choice.h>

#include <array>
#include <numeric>

namespace render {

namespace {

// Adds a uniform part of a third.
void defend(std::span<double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w += sum / (2 * double(weights.size()));
}

} // namespace

std::optional<LightChoice> LightChoice::of(std::span<const Light> lights, double radius) {
  LightChoice choice;
  std::vector<double> powers;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const double power = lights[i].is_sampled() ? lights[i].power(radius) : 0;
    auto& place = choice.place_.emplace_back();
    if (!(power > 0)) continue;
    place = static_cast<std::uint32_t>(choice.candidates_.size());
    choice.candidates_.push_back(i);
    powers.push_back(power);
  }
  if (powers.empty()) return {};
  if (powers.size() > few) {
    defend(powers);
    choice.by_power_.emplace(powers);
  }
  return choice;
}

mc::ShortDiscrete<Float, LightChoice::few> LightChoice::seen_from(std::span<const Light> lights,
                                                                  const Vec3& ref) const {
  std::array<double, few> weights;
  const std::span<double> used(weights.data(), candidates_.size());
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = lights[candidates_[i]].irradiance(ref);
  defend(used);
  // Shares, since floats would not hold every irradiance.
  const double sum = std::accumulate(used.begin(), used.end(), 0.0);
  std::array<Float, few> shares;
  for (std::size_t i = 0; i < used.size(); ++i) shares[i] = Float(used[i] / sum);
  return mc::ShortDiscrete<Float, few>(std::span<const Float>(shares.data(), used.size()));
}

mc::DiscreteSample<Float> LightChoice::sample_index(std::span<const Light> lights, const Vec3& ref, Float u) const {
  if (candidates_.size() == 1) return {candidates_[0], 1, u};
  const auto s = by_power_ ? by_power_->sample_index(u) : seen_from(lights, ref).sample_index(u);
  return {candidates_[s.index], s.pmf, s.u_remapped};
}

Float LightChoice::pmf(std::span<const Light> lights, const Vec3& ref, std::size_t light) const {
  const auto place = place_[light];
  if (!place) return 0;
  if (candidates_.size() == 1) return 1;
  return by_power_ ? by_power_->pmf(*place) : seen_from(lights, ref).pmf(*place);
}

} // namespace render
