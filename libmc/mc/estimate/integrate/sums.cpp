#include <mc/estimate/integrate/sums.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mc::detail {

void ScaledMoments::rescale(int exponent) {
  moments_ = moments_.scaled(exponent_ - exponent);
  exponent_ = exponent;
}

void ScaledMoments::add(std::span<double> values, std::uint64_t first, double largest) {
  if (largest > 0 && std::isfinite(largest)) {
    const int size = std::ilogb(largest);
    if (size - exponent_ > 256 || (only_zeros() && size - exponent_ < -256)) rescale(size);
  }
  if (exponent_ != 0)
    for (double& x : values) x = std::ldexp(x, -exponent_);
  moments_.add(values, first);
}

void ScaledMoments::merge(const ScaledMoments& other) {
  ScaledMoments theirs = other;
  if (theirs.exponent_ != exponent_) {
    // Zeros have no scale and take the exponent of the other values.
    int exponent = std::max(exponent_, theirs.exponent_);
    if (only_zeros()) exponent = theirs.exponent_;
    else if (theirs.only_zeros()) exponent = exponent_;
    rescale(exponent);
    theirs.rescale(exponent);
  }
  moments_.merge(theirs.moments_);
}

double ScaledMoments::mean() const { return std::ldexp(moments_.mean(), exponent_); }
double ScaledMoments::std_error() const { return std::ldexp(moments_.std_error(), exponent_); }

void Sums::zero_infinite_values(std::span<double> all_values, std::span<const double> volumes, std::uint64_t first) {
  for (std::size_t i = 0; i < all_values.size(); ++i) {
    if (!std::isinf(all_values[i])) [[likely]]
      continue;
    all_values[i] = 0;
    infinite.resize(outputs.size());
    infinite[i % outputs.size()].merge({1, volumes[i / outputs.size()]});
    if (!first_infinite) first_infinite = first + i / outputs.size();
  }
}

void Sums::add_to_batches(std::size_t output, std::span<const double> added, std::uint64_t first, double largest) {
  constexpr std::size_t length = 32;
  batches.resize(outputs.size() * batch_count);
  for (std::size_t i = 0; i < added.size(); i += length) {
    const std::span<const double> part = added.subspan(i, std::min(length, added.size() - i));
    std::array<double, length> copy;
    std::copy(part.begin(), part.end(), copy.begin());
    batches[output * batch_count + (first + i) / length % batch_count].add(std::span(copy).first(part.size()),
                                                                           first + i, largest);
  }
}

void Sums::merge(Sums other) {
  if (outputs.empty()) {
    *this = std::move(other);
    return;
  }
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    outputs[k].merge(other.outputs[k]);
    sampled[k].merge(other.sampled[k]);
  }
  jacobians += other.jacobians;
  infinite.resize(std::max(infinite.size(), other.infinite.size()));
  for (std::size_t k = 0; k < other.infinite.size(); ++k) infinite[k].merge(other.infinite[k]);
  if (!first_infinite) first_infinite = other.first_infinite;
  batches.resize(std::max(batches.size(), other.batches.size()));
  for (std::size_t i = 0; i < other.batches.size(); ++i) batches[i].merge(other.batches[i]);
}

} // namespace mc::detail
