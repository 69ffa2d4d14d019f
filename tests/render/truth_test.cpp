// Random scenes: for every strategy and sampler the errors match the error bars. These are a few of the hundreds of
// scenes of bench_render_truth, with fixed seeds.

#include <render/truth/measure.h>

#include <gtest/gtest.h>

namespace {

using namespace render;
using namespace render::truth;

constexpr std::uint32_t sets = 32, points = 256;

struct Truth {
  double value = 0, error = 0, dof = mc::infinity<double>;
};

Truth truth_of(const Family& family, std::uint64_t seed) {
  if (family.truth) return {*family.truth};
  const auto m = measure(family.pictures[0], strategy_from("mis"), PixelSampler::sobol, seed, 8 * sets, points);
  return {m.means.mean(), m.means.std_error(), double(m.means.count() - 1)};
}

// Strategies that sample lights or aim at them, and all samplers in turn. Skewness makes a z-score of 3 as large as 4,
// so the bound is 6. By chance one z-score in twenty exceeds 1.96.
void expect_right(Family (*make)(mc::Pcg&), int families) {
  int tried = 0, beyond = 0;
  for (int i = 0; i < families; ++i) {
    mc::Pcg random(2026, std::uint64_t(i));
    const Family family = make(random);
    const Truth truth = truth_of(family, mc::hash(7, std::uint64_t(i)));
    for (const Picture& picture : family.pictures)
      for (const char* strategy : {"mixture", "nee", "mis"}) {
        const auto sampler = std::array{PixelSampler::independent, PixelSampler::stratified,
                                        PixelSampler::sobol}[std::size_t(tried % 3)];
        const Measured m =
            measure(picture, strategy_from(strategy), sampler, mc::hash(8, std::uint64_t(tried)), sets, points);
        const double z = z_score(m, truth.value, truth.error, truth.dof, family.rounding * truth.value);
        ++tried;
        beyond += std::abs(z) > 1.96;
        EXPECT_LE(std::abs(z), 6) << family.kind << " " << i << ", " << picture.variant << ", " << strategy << ", "
                                  << name(sampler) << ": " << m.means.mean() << " +- " << m.means.std_error() << " for "
                                  << truth.value;
      }
  }
  const double expected = 0.05 * tried;
  EXPECT_LE(beyond, expected + 4 * std::sqrt(expected));
}

TEST(Truth, OfFurnaces) { expect_right(furnace, 30); }
TEST(Truth, OfDirectLight) { expect_right(direct_light, 30); }
TEST(Truth, OfRooms) { expect_right(room, 4); }

// The scores detect an error of two hundredths.
TEST(Truth, IsNotAnything) {
  mc::Pcg random(5);
  const Family family = furnace(random);
  const Measured m = measure(family.pictures[0], strategy_from("mis"), PixelSampler::sobol, 1, sets, points);
  EXPECT_GE(std::abs(z_score(m, 1.02, 0, mc::infinity<double>, 1e-4)), 6);
}

} // namespace
