#include <mc/sampler/padded_sobol_4d.h>
#include <mc/sampler/sobol.h>

#include <boost/random/detail/sobol_table.hpp>

#include <vector>

namespace mc {

// Computes the direction numbers by the recurrence of a primitive polynomial over GF(2) from its first values
// [BratleyFox88].
const std::uint32_t* Sobol::direction_numbers() {
  static const std::vector<std::uint32_t> table = [] {
    using Table = boost::random::detail::qrng_tables::sobol;
    std::vector<std::uint32_t> columns(std::size_t{dimensions} * 32);
    for (std::uint32_t k = 0; k < 32; ++k) columns[k] = 1u << k;
    for (std::uint32_t dim = 1; dim < dimensions; ++dim) {
      const std::uint32_t polynomial = Table::polynomial(dim - 1);
      const auto degree = static_cast<std::uint32_t>(31 - __builtin_clz(polynomial));
      std::uint32_t m[32] = {};
      for (std::uint32_t k = 0; k < 32; ++k) {
        if (k < degree) {
          m[k] = Table::minit(dim - 1, k);
        } else {
          m[k] = m[k - degree];
          for (std::uint32_t i = 0; i < degree; ++i)
            if (polynomial >> i & 1) m[k] ^= m[k - (degree - i)] << (degree - i);
        }
        columns[std::size_t{dim} * 32 + k] = reverse_bits(m[k] << (31 - k));
      }
    }
    return columns;
  }();
  return table.data();
}

const detail::SobolNibbles& detail::sobol_nibbles() {
  static const SobolNibbles nibbles = [] {
    const Sobol sobol;
    SobolNibbles n{};
    for (std::uint32_t k = 0; k < 8; ++k)
      for (std::uint32_t bits = 0; bits < 16; ++bits)
        for (std::uint32_t d = 2; d < 4; ++d)
          n[k][bits] |= std::uint64_t{reverse_bits(sobol.unscrambled(bits << 4 * k, d))} << (d == 2 ? 0 : 32);
    return n;
  }();
  return nibbles;
}

} // namespace mc
