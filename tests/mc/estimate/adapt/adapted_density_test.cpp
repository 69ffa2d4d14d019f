#include <mc/estimate/adapt/adapted_density.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <array>

namespace {

TEST(AdaptedDensity, IsTheInverseOfTheJacobian) {
  mc::AdaptedDensity density{mc::ImportanceGrid(3)};
  std::vector<double> power(3 * mc::ImportanceGrid::bins);
  for (std::size_t i = 0; i < power.size(); ++i) power[i] = mc::hash_uniform<double>(1, i);
  density.grid.refine(power, 1'000'000);
  for (const bool with_tree : {false, true}) {
    if (with_tree)
      density.tree = mc::BoxTree::from_function(
          3, [](std::span<const double> x) { return x[0] * x[1] + 0.1; }, 50);
    for (std::uint64_t i = 0; i < 1000; ++i) {
      std::array<double, 3> x, scratch;
      for (std::size_t d = 0; d < 3; ++d) x[d] = mc::hash_uniform<double>(2, i, d);
      const double jacobian = density.map(x);
      EXPECT_NEAR(jacobian * density.density(x, scratch), 1, 1e-9);
    }
  }
}

} // namespace
