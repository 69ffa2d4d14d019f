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

// Start index of the numbers with each digit.
using Begins = std::array<std::uint32_t, digits + 1>;

void accumulate(Begins& counts) {
  for (std::size_t d = 1; d <= digits; ++d) counts[d] += counts[d - 1];
}

// Sorts `values` with `other` as a buffer of the same size. Sorts numbers with equal keys among themselves, by finer
// keys if there are many.
void sort_numbers(std::span<double> values, std::span<double> other) {
  if (values.size() < 1 << 12 || values.size() > std::numeric_limits<std::uint32_t>::max())
    return std::sort(values.begin(), values.end());
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const double lo = *least, range = *largest - lo;
  if (!(range > 0)) return;
  const double scale = static_cast<double>(digits * digits - 1) / range;
  if (!(range <= std::numeric_limits<double>::max() && scale <= std::numeric_limits<double>::max()))
    return std::sort(values.begin(), values.end());
  // Keys are monotone in the numbers. Radix sort by the lower digit, then by the upper digit; both passes are stable.
  const auto key = [=](double v) { return static_cast<std::uint32_t>((v - lo) * scale); };
  Begins lower{}, upper{};
  for (const double v : values) {
    ++lower[(key(v) & (digits - 1)) + 1];
    ++upper[(key(v) >> digit_bits) + 1];
  }
  accumulate(lower);
  accumulate(upper);
  for (const double v : values) other[lower[key(v) & (digits - 1)]++] = v;
  for (const double v : other.first(values.size())) values[upper[key(v) >> digit_bits]++] = v;
  // Only numbers with equal keys can still be out of order.
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(values[i] < values[i - 1])) continue;
    const std::uint32_t k = key(values[i]);
    std::size_t begin = i - 1, end = i + 1;
    while (begin > 0 && key(values[begin - 1]) == k) --begin;
    while (end < values.size() && key(values[end]) == k) ++end;
    sort_numbers(values.subspan(begin, end - begin), other.subspan(begin, end - begin));
    i = end;
  }
}

} // namespace

void sort_numbers(std::vector<double>& values) {
  std::vector<double> other(values.size());
  sort_numbers(values, other);
}

} // namespace mc
