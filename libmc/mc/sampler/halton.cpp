#include <mc/sampler/halton.h>

#include <array>
#include <vector>

namespace mc::detail {

namespace {

constexpr std::uint32_t largest_group = 1024; // so that the tables of many dimensions stay in the first cache

struct HaltonTables {
  std::array<HaltonBase, Halton::dimensions> bases{};
  std::vector<std::uint16_t> reversals; // tables of all bases

  HaltonTables() {
    std::vector<std::uint32_t> primes;
    for (std::uint32_t i = 2; primes.size() < bases.size(); ++i) {
      bool prime = true;
      for (std::size_t k = 0; prime && k < primes.size() && primes[k] * primes[k] <= i; ++k) prime = i % primes[k] != 0;
      if (prime) primes.push_back(i);
    }
    std::vector<std::size_t> places; // of the tables of each base
    for (std::size_t d = 0; d < primes.size(); ++d) {
      const std::uint32_t base = primes[d];
      std::uint32_t digits = 0, group_digits = 1, group = base;
      std::uint64_t period = 1;
      while (period * base <= std::uint64_t{1} << 32) period *= base, ++digits;
      while (group * base <= largest_group) group *= base, ++group_digits;
      const std::uint32_t last = digits % group_digits == 0 ? group_digits : digits % group_digits;
      std::uint32_t rest = 1;
      for (std::uint32_t k = 0; k < last; ++k) rest *= base;
      constexpr std::uint64_t most = ~std::uint64_t{0};
      bases[d] = {.base = base,
                  .group = group,
                  .rest = rest,
                  .groups = (digits - last) / group_digits,
                  .period = period,
                  .units = period / base,
                  .group_inverse = most / group,
                  .rest_inverse = most / rest,
                  .width = most / period,
                  .reversed = nullptr,
                  .reversed_rest = nullptr};
      places.push_back(reversals.size());
      if (group_digits == 1) continue;
      append_reversals(base, group);
      append_reversals(base, rest);
    }
    for (std::size_t d = 0; d < primes.size(); ++d) {
      if (bases[d].group == bases[d].base) continue;
      bases[d].reversed = reversals.data() + places[d];
      bases[d].reversed_rest = bases[d].reversed + bases[d].group;
    }
  }

  // For all numbers below `size`, a power of the base.
  void append_reversals(std::uint32_t base, std::uint32_t size) {
    for (std::uint32_t i = 0; i < size; ++i) {
      std::uint32_t value = 0;
      for (std::uint32_t scale = 1, left = i; scale < size; scale *= base, left /= base)
        value = value * base + left % base;
      reversals.push_back(static_cast<std::uint16_t>(value));
    }
  }
};

} // namespace

const HaltonBase* halton_bases() {
  static const HaltonTables tables;
  return tables.bases.data();
}

} // namespace mc::detail
