#include <mc/core/sum.h>
#include <mc/estimate/diagnostics/extremes.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace mc {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}

Extremes::Extremes() : high_cut_(-infinity), low_cut_(infinity), hi_(-infinity), lo_(infinity) {}

void Extremes::add(std::span<const double> values) {
  if (values.empty()) return;
  const double n = static_cast<double>(values.size());
  const double sum = interleaved_sum(values.size(), [&](std::size_t i) { return std::abs(values[i]); });
  std::uint64_t zeros = 0;
  for (const double x : values) zeros += x == 0;
  double mean = sum / n;
  if (!std::isfinite(sum)) { // non-finite values, or an overflow of the sum
    std::vector<double> finite;
    for (const double x : values)
      if (std::isfinite(x)) finite.push_back(x);
    if (finite.size() < values.size()) return add(finite);
    mean = 0;
    for (const double x : values) mean += std::abs(x) / n;
  }
  count_ += values.size();
  zeros_ += zeros;
  mean_size_ += (mean - mean_size_) * (n / static_cast<double>(count_));
  constexpr std::size_t together = 32; // of which mostly none is kept
  for (; !values.empty(); values = values.subspan(std::min(together, values.size()))) {
    const std::span<const double> part = values.first(std::min(together, values.size()));
    std::uint64_t beyond = 0;
    for (const double x : part) beyond += (x > high_cut_) | (x < low_cut_);
    if (beyond > 0) keep(part);
  }
}

void Extremes::keep(std::span<const double> values) {
  for (const double x : values) {
    if (x > high_cut_) {
      hi_ = std::max(hi_, x);
      high_.push_back(x);
    }
    if (x < low_cut_) {
      lo_ = std::min(lo_, x);
      low_.push_back(x);
    }
    if (std::max(high_.size(), low_.size()) >= 4 * capacity) compact();
  }
}

void Extremes::compact() {
  const auto keep = [](std::vector<double>& values, double& cut, auto before) {
    if (values.size() <= capacity) return;
    const auto last = values.begin() + capacity - 1;
    std::nth_element(values.begin(), last, values.end(), before);
    values.resize(capacity);
    cut = values.back();
  };
  keep(high_, high_cut_, std::greater<>());
  keep(low_, low_cut_, std::less<>());
}

void Extremes::merge(const Extremes& other) {
  if (other.count_ == 0) return;
  count_ += other.count_;
  zeros_ += other.zeros_;
  mean_size_ += (other.mean_size_ - mean_size_) * (static_cast<double>(other.count_) / static_cast<double>(count_));
  hi_ = std::max(hi_, other.hi_);
  lo_ = std::min(lo_, other.lo_);
  high_cut_ = std::max(high_cut_, other.high_cut_);
  low_cut_ = std::min(low_cut_, other.low_cut_);
  high_.insert(high_.end(), other.high_.begin(), other.high_.end());
  low_.insert(low_.end(), other.low_.begin(), other.low_.end());
  if (std::max(high_.size(), low_.size()) >= 4 * capacity) compact();
}

Extremes Extremes::for_more_values() const {
  Extremes full = *this;
  full.compact();
  Extremes next;
  next.high_cut_ = full.high_cut_;
  next.low_cut_ = full.low_cut_;
  next.hi_ = full.hi_;
  next.lo_ = full.lo_;
  return next;
}

namespace {
// The first k values in an order, or all that are kept.
template <class Order> std::vector<double> first_values(std::vector<double> values, std::size_t k, Order before) {
  k = std::min({k, values.size(), Extremes::capacity});
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(k), values.end(), before);
  values.resize(k);
  std::sort(values.begin(), values.end(), before);
  return values;
}
} // namespace

std::vector<double> Extremes::largest(std::size_t k) const { return first_values(high_, k, std::greater<>()); }
std::vector<double> Extremes::smallest(std::size_t k) const { return first_values(low_, k, std::less<>()); }

} // namespace mc
