#include <mc/stats/sort_numbers.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace mc {
namespace {

constexpr int digit_bits = 12;
constexpr std::size_t digits = std::size_t{1} << digit_bits;

// Distributes the numbers by one digit of their keys; equal digits keep their order.
template <class Key> void distribute(std::span<const double> from, std::span<double> to, int shift, const Key& key) {
  std::array<std::size_t, digits + 1> first{};
  for (const double v : from) ++first[(key(v) >> shift & (digits - 1)) + 1];
  for (std::size_t d = 1; d <= digits; ++d) first[d] += first[d - 1];
  for (const double v : from) to[first[key(v) >> shift & (digits - 1)]++] = v;
}

// `other` has room for as many. What shares a key is sorted among itself, by finer keys where it is much.
void sort_numbers(std::span<double> values, std::span<double> other) {
  if (values.size() < 1 << 12) return std::sort(values.begin(), values.end());
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const double lo = *least, range = *largest - lo;
  if (!(range > 0)) return;
  const double scale = static_cast<double>(digits * digits - 1) / range;
  if (!(range <= std::numeric_limits<double>::max() && scale <= std::numeric_limits<double>::max()))
    return std::sort(values.begin(), values.end());
  // Keys never fall where numbers rise.
  const auto key = [=](double v) { return static_cast<std::uint32_t>((v - lo) * scale); };
  distribute(values, other, 0, key);
  distribute(other, values, digit_bits, key);
  for (std::size_t i = 0, end = 0; i < values.size(); i = end) {
    const std::uint32_t k = key(values[i]);
    for (end = i + 1; end < values.size() && key(values[end]) == k; ++end) {
    }
    if (end - i > 1) sort_numbers(values.subspan(i, end - i), other.subspan(i, end - i));
  }
}

} // namespace

void sort_numbers(std::vector<double>& values) {
  std::vector<double> other(values.size());
  sort_numbers(values, other);
}

} // namespace mc
