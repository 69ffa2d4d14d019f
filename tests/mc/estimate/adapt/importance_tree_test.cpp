#include <mc/estimate/adapt/importance_tree.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace {

// Values at independent uniform points.
template <class F> mc::WeightedSamples samples_of(int dim, std::size_t n, F&& f) {
  mc::WeightedSamples s{dim, {}, {}, std::vector<double>(n, 1.0 / static_cast<double>(n))};
  for (std::size_t i = 0; i < n; ++i) {
    for (int d = 0; d < dim; ++d) s.points.push_back(mc::hash_uniform<double>(1, i, d));
    s.values.push_back(f(s.point(i)));
  }
  return s;
}

// Single axes show no structure of this integrand, so the first cuts gain nothing.
TEST(ImportanceTree, FollowsNonSeparableIntegrand) {
  const auto checks = [](std::span<const double> x) { return (x[0] < 0.5) == (x[1] < 0.5) ? x[2] : 0.0; };
  const mc::BoxTree tree = mc::importance_tree(samples_of(3, 8000, checks));
  EXPECT_GT(tree.leaves(), 3u);
  const auto density = [&](double x, double y) { return tree.density(tree.leaf_of_x(std::array{x, y, 0.8})); };
  EXPECT_GT(density(0.2, 0.3), 4 * density(0.2, 0.8));
  EXPECT_GT(density(0.7, 0.9), 4 * density(0.7, 0.2));
}

// Noise must not be learned: the second half of the points does not confirm the cuts proposed by the first.
TEST(ImportanceTree, DoesNotSplitOnNoise) {
  std::size_t leaves = 0;
  for (std::uint64_t k = 0; k < 20; ++k) {
    std::uint64_t i = 0;
    const auto noise = [&](std::span<const double>) { return 1 + mc::hash_uniform<double>(2, k, i++); };
    leaves += mc::importance_tree(samples_of(4, 3000, noise)).leaves();
  }
  EXPECT_LE(leaves, 100u); // 20 trees with up to 90 boxes each would be possible
}

TEST(ImportanceTree, KeepsATenthUniform) {
  const auto corner = [](std::span<const double> x) { return x[0] < 0.1 && x[1] < 0.1 ? 1.0 : 0.0; };
  const mc::BoxTree tree = mc::importance_tree(samples_of(2, 20'000, corner));
  for (std::size_t leaf = 0; leaf < tree.leaves(); ++leaf) EXPECT_GE(tree.density(leaf), 0.1 - 1e-12);
  EXPECT_GT(tree.density(tree.leaf_of_x(std::array{0.05, 0.05})), 5);
}

// Boxes that contain the peak keep a share of the probability beside it, although no point there indicates it.
TEST(ImportanceTree, KeepsProbabilityBesideAPeak) {
  const auto corner = [](std::span<const double> x) { return x[0] < 0.1 && x[1] < 0.1 ? 1.0 : 0.0; };
  const mc::BoxTree tree = mc::importance_tree(samples_of(2, 20'000, corner));
  const auto density = [&](double x, double y) { return tree.density(tree.leaf_of_x(std::array{x, y})); };
  EXPECT_GT(density(0.15, 0.05), 2 * density(0.9, 0.9));
}

// Near 1 doubles are 2^-53 apart. A box of few doubles would show its largest value as a bound of the pole.
TEST(ImportanceTree, BoxesContainManyDoubles) {
  mc::WeightedSamples s = samples_of(1, 20'000, [](std::span<const double>) { return 1.0; });
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double rest = std::exp2(-50 * s.points[i]); // points as a density would draw them that follows 1 / (1 - x)
    s.points[i] = 1 - rest;
    s.values[i] = 1 / rest;
    s.weights[i] *= 50 * std::log(2.0) * rest;
  }
  const mc::BoxTree tree = mc::importance_tree(s);
  EXPECT_GT(tree.leaves(), 5u);
  double largest = 0;
  for (std::size_t leaf = 0; leaf < tree.leaves(); ++leaf) largest = std::max(largest, tree.density(leaf));
  EXPECT_LE(largest, 0x1p12 * 8);
}

TEST(ImportanceTree, NoSamples_GivesOneBox) {
  EXPECT_EQ(mc::importance_tree(samples_of(2, 0, [](std::span<const double>) { return 0.0; })).leaves(), 1u);
  EXPECT_EQ(mc::importance_tree(samples_of(2, 5000, [](std::span<const double>) { return 0.0; })).leaves(), 1u);
}

} // namespace
