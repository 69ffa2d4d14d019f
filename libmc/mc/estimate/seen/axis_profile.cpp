#include <mc/core/types.h>
#include <mc/estimate/seen/axis_profile.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mc::detail {

namespace {
constexpr std::size_t finest = 64, coarsest = 8, least = 24; // bins, points in one

struct Bin {
  double count = 0, sum = 0, squares = 0;
  double mean() const { return sum / count; }
  double variance() const { return std::max(squares / count - sqr(mean()), 0.0) / (count - 1); } // of the mean
};

double largest_jump(std::span<const Bin> bins) {
  double largest = 0;
  const auto step = [&](std::size_t i) { return std::abs(bins[i + 1].mean() - bins[i].mean()); };
  for (std::size_t i = 0; i + 1 < bins.size(); ++i) {
    const double before = step(i > 0 ? i - 1 : 1), after = step(i + 2 < bins.size() ? i + 1 : i - 1);
    const double error = std::sqrt(bins[i].variance() + bins[i + 1].variance());
    if (step(i) > before + after + 4 * error) largest = std::max(largest, step(i));
  }
  return largest;
}
} // namespace

void AxisProfile::add_points(std::span<const double> u) {
  for (const double x : u) bins_.push_back(static_cast<std::uint8_t>(static_cast<double>(finest) * x));
}

void AxisProfile::add_values(std::size_t output, std::span<const double> values) {
  values_.resize(std::max(values_.size(), output + 1));
  values_[output].insert(values_[output].end(), values.begin(), values.end());
}

void AxisProfile::merge(const AxisProfile& other) {
  bins_.insert(bins_.end(), other.bins_.begin(), other.bins_.end());
  for (std::size_t k = 0; k < other.values_.size(); ++k) add_values(k, other.values_[k]);
}

double AxisProfile::jump(std::size_t output, std::size_t dim) const {
  if (output >= values_.size()) return 0;
  const std::vector<double>& values = values_[output];
  double largest = 0, sum = 0;
  for (const double x : values) largest = std::max(largest, std::abs(x));
  if (!(largest > 0 && std::isfinite(largest))) return 0;
  const int exponent = std::ilogb(largest); // so that no square overflows or vanishes
  for (const double x : values) sum += std::ldexp(x, -exponent);
  const double mean = sum / static_cast<double>(values.size());
  std::size_t count = finest;
  while (count > coarsest && values.size() < least * count) count /= 2;
  double jump = 0;
  for (std::size_t axis = 0; axis < dim; ++axis) {
    std::array<Bin, finest> bins{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      Bin& bin = bins[bins_[i * dim + axis] / (finest / count)];
      const double x = std::ldexp(values[i], -exponent) - mean;
      bin.count += 1;
      bin.sum += x;
      bin.squares += sqr(x);
    }
    const std::span<const Bin> used(bins.data(), count);
    if (std::all_of(used.begin(), used.end(), [](const Bin& b) { return b.count > 1; }))
      jump = std::max(jump, largest_jump(used));
  }
  return std::ldexp(jump, exponent);
}

} // namespace mc::detail
