#include <mc/estimate/diagnostics/sampled_values.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mc {

void SampledValues::add_weighted(std::span<const double> values, std::span<const double> inverse_densities) {
  const bool first = integrand.count() == 0;
  const double lo = integrand.lo(), hi = integrand.hi();
  std::uint64_t beyond = 0;
  for (const double x : values) beyond += (x < lo) | (x > hi);
  if (first || beyond > 0) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const auto weight = [&](auto at) { return inverse_densities[static_cast<std::size_t>(at - values.begin())]; };
    if (first || *least < lo) weights[0] = weight(least);
    if (first || *most > hi) weights[1] = weight(most);
  }
  integrand.add(values);
  std::vector<double> weighted(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) weighted[i] = values[i] * inverse_densities[i];
  averaged.add(weighted);
}

void SampledValues::merge(const SampledValues& other) {
  if (other.integrand.count() > 0) {
    const bool first = integrand.count() == 0;
    if (first || other.integrand.lo() < integrand.lo()) weights[0] = other.weights[0];
    if (first || other.integrand.hi() > integrand.hi()) weights[1] = other.weights[1];
  }
  averaged.merge(other.averaged);
  integrand.merge(other.integrand);
}

} // namespace mc
