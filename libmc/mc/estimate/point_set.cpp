#include <mc/estimate/point_set.h>

#include <array>

namespace mc {

namespace {

constexpr std::uint64_t window = 256; // points whose index differs in the low bits only

template <Sampler T> void fill(const T& sampler, std::uint64_t first, std::size_t dim, std::span<double> u) {
  for (std::size_t i = 0; i < u.size(); i += dim)
    for (std::size_t d = 0; d < dim; ++d) u[i + d] = coordinate<double>(sampler, first + i / dim, static_cast<std::uint32_t>(d));
}

void fill(const ScrambledSobol& set, std::uint64_t first, std::size_t dim, std::span<double> u) {
  const Sobol sobol(set.seed);
  const std::uint64_t last = first + u.size() / dim;
  std::array<std::uint32_t, window> x;
  for (std::uint64_t begin = first; begin < last;) {
    const std::uint64_t base = begin / window * window, end = std::min(base + window, last);
    double* out = u.data() + (begin - first) * dim;
    const auto skip = static_cast<std::size_t>(begin - base), count = static_cast<std::size_t>(end - begin);
    for (std::size_t d = 0; d < dim; ++d) {
      const auto dimension = static_cast<std::uint32_t>(d);
      if (dimension >= Sobol::dimensions) {
        for (std::size_t i = 0; i < count; ++i) out[i * dim + d] = coordinate<double>(sobol, begin + i, dimension);
        continue;
      }
      // Points base .. base + 2^k - 1 from the first half of them.
      x[0] = sobol.unscrambled(static_cast<std::uint32_t>(base), dimension);
      for (std::uint32_t half = 1; half < skip + count; half *= 2) {
        const std::uint32_t column = sobol.unscrambled(half, dimension);
        for (std::uint32_t i = 0; i < half; ++i) x[half + i] = x[i] ^ column;
      }
      const auto key = static_cast<std::uint32_t>(hash(set.seed, dimension) >> 32);
      for (std::size_t i = skip; i < skip + count; ++i) x[i] = owen_scramble(x[i], key);
      for (std::size_t i = 0; i < count; ++i) out[i * dim + d] = (static_cast<double>(x[skip + i]) + 0.5) * 0x1p-32;
    }
    begin = end;
  }
}

} // namespace

void fill_points(const PointSet& set, std::uint64_t first, int dim, std::span<double> u) {
  std::visit([&](const auto& s) { fill(s, first, static_cast<std::size_t>(dim), u); }, set);
}

} // namespace mc
