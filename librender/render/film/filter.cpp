#include <render/film/filter.h>

#include <numeric>

namespace render {

SplatFilter::SplatFilter(const Filter& filter) : filter_(filter) {
  mc::require(filter.radius() <= max_radius,
              "splats reach {:.3g} pixels by this filter, and at most {}; take a narrower one or samples of their own",
              filter.radius(), max_radius);
  const auto reach = static_cast<std::size_t>(std::max(0.0, std::ceil(filter.radius() - 0.5)));
  squared_weights_.resize(2 * reach + 1);
  std::vector<double> values(squared_weights_.size());
  constexpr int steps = 4096; // of the midpoint rule; relative error about 1e-6, for a box 3e-4
  for (int i = 0; i < steps; ++i) {
    profile((i + 0.5) / steps - 0.5, values);
    for (std::size_t j = 0; j < values.size(); ++j) squared_weights_[j] += mc::sqr(values[j]) / steps;
  }
  noise_area_ = 1 / mc::sqr(std::accumulate(squared_weights_.begin(), squared_weights_.end(), 0.0));
}

void SplatFilter::profile(double offset, std::vector<double>& values) const {
  dispatch(filter_, [&](const auto& f) {
    double x = offset + reach();
    for (double& value : values) value = f.profile(x--);
  });
}

} // namespace render
