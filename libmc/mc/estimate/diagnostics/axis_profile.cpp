#include <mc/core/types.h>
#include <mc/estimate/diagnostics/axis_profile.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mc::detail {

namespace {
constexpr std::size_t finest = 64, coarsest = 8, least = 24; // numbers of bins, and minimum number of points per bin

struct Bin {
  double count = 0, sum = 0;
  double variance = 0; // of the mean
  double mean() const { return sum / count; }
};
using Bins = std::array<Bin, finest>;

// Adds the variance of each bin mean. Points of one replicate are dependent, like points of a net in other coordinates.
// The variance therefore comes from the total deviation of each replicate in a bin.
void add_variances(Bins& bins, std::span<const std::size_t> bin_of, std::span<const double> values,
                   std::size_t replicates) {
  const std::size_t points = values.size() / replicates;
  for (std::size_t r = 0; r < replicates; ++r) {
    std::array<double, finest> off{};
    for (std::size_t i = r * points; i < (r + 1) * points; ++i) off[bin_of[i]] += values[i] - bins[bin_of[i]].mean();
    for (std::size_t b = 0; b < finest; ++b) bins[b].variance += sqr(off[b]);
  }
  const double r = static_cast<double>(replicates);
  for (Bin& b : bins) b.variance *= b.count > 0 ? r / ((r - 1) * sqr(b.count)) : 0;
}

// Largest step that exceeds the steps on both sides by two standard errors. False alarms at two consecutive lengths are
// rare for smooth integrands.
double largest_jump(std::span<const Bin> bins) {
  double largest = 0;
  const auto step = [&](std::size_t i) { return std::abs(bins[i + 1].mean() - bins[i].mean()); };
  for (std::size_t i = 0; i + 1 < bins.size(); ++i) {
    const bool first = i == 0, last = i + 2 == bins.size();
    const double before = step(first ? 1 : i - 1), after = step(last ? i - 1 : i + 1);
    const double beside = bins[first ? 2 : i - 1].variance + bins[last ? i - 1 : i + 2].variance;
    const double error = std::sqrt(4 * (bins[i].variance + bins[i + 1].variance) + beside);
    if (step(i) > before + after + 2 * error) largest = std::max(largest, step(i));
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

double AxisProfile::jump(std::size_t output, std::size_t dim, std::size_t replicates) const {
  if (output >= values_.size()) return 0;
  double largest = 0;
  for (const double x : values_[output]) largest = std::max(largest, std::abs(x));
  if (!(largest > 0 && std::isfinite(largest))) return 0;
  const int exponent = std::ilogb(largest); // scales so that no square overflows or underflows
  std::vector<double> values;
  for (const double x : values_[output]) values.push_back(std::ldexp(x, -exponent));
  std::size_t count = finest;
  while (count > coarsest && values.size() < least * count) count /= 2;
  double jump = 0;
  std::vector<std::size_t> bin_of(values.size());
  for (std::size_t axis = 0; axis < dim; ++axis) {
    Bins bins{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      bin_of[i] = bins_[i * dim + axis] / (finest / count);
      bins[bin_of[i]].count += 1;
      bins[bin_of[i]].sum += values[i];
    }
    const std::span<const Bin> used(bins.data(), count);
    if (!std::all_of(used.begin(), used.end(), [](const Bin& b) { return b.count > 1; })) continue;
    add_variances(bins, bin_of, values, replicates);
    jump = std::max(jump, largest_jump(used));
  }
  return std::ldexp(jump, exponent);
}

} // namespace mc::detail
