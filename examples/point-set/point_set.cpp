// A point set of your own: the Kronecker sequence of the plastic number, shifted at random. libmc's samplers are pure
// functions from (index, dimension) to 64 bits.
#include <mc/points/star_discrepancy.h>
#include <mc/random/hash.h>
#include <mc/sampler/sobol.h>

#include <fmt/format.h>

#include <cmath>
#include <vector>

struct Kronecker {
  std::uint64_t seed = 0;

  std::uint64_t bits(std::uint64_t index, std::uint32_t dim) const {
    constexpr long double plastic = 1.32471795724474602596L;
    const long double step = dim == 0 ? 1 / plastic : 1 / (plastic * plastic); // two dimensions
    return mc::hash(seed, dim) + index * static_cast<std::uint64_t>(std::ldexp(step, 64));
  }
};
static_assert(mc::Sampler<Kronecker>);

template <mc::Sampler T> double star_discrepancy(const T& sampler, std::uint64_t n) {
  std::vector<double> points;
  for (std::uint64_t i = 0; i < n; ++i)
    for (std::uint32_t k = 0; k < 2; ++k) points.push_back(mc::coordinate<double>(sampler, i, k));
  return mc::star_discrepancy({points, 2}).upper;
}

int main() {
  for (const std::uint64_t n : {64, 256, 1024})
    fmt::print("N = {:4}: star discrepancy {:.4f}, of Sobol' {:.4f}\n", n, star_discrepancy(Kronecker{1}, n),
               star_discrepancy(mc::Sobol(1), n));
  return star_discrepancy(Kronecker{1}, 1024) < 0.01 ? 0 : 1;
}
