#include <mc/warp/mixture_n.h>

#include <mc/table/discrete.h>
#include <mc/table/table_dist_1d.h>
#include <mc/warp/cone.h>
#include <mc/warp/rotated.h>
#include <mc/warp/tent.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class MixtureNOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(MixtureNOver, Scalars);

// Directions toward `n` cones about random axes; some of the cones overlap.
template <class S, class C> auto cones(const C& choice) {
  std::vector<Rotated<UniformCone<S>>> parts;
  Pcg random(6);
  for (std::size_t i = 0; i < choice.size(); ++i)
    parts.emplace_back(UniformCone<S>::from_angle(S(0.2) + S(0.1) * S(i)),
                       Sphere<S>{}.from_unit(random.point<S, 2>()).normalized());
  return MixtureN(Sphere<S>{}, choice, parts);
}

TYPED_TEST(MixtureNOver, ObeysTheLaws) {
  using S = TypeParam;
  EXPECT_WARP_LAWS(cones<S>(UniformDiscrete<S>(3)), {.statistics = {.samples = 50'000}, .sample_eps = 64});
  EXPECT_WARP_LAWS(cones<S>(TableDist1D<S>(std::vector<double>{1, 0, 5, 2})),
                   {.statistics = {.samples = 50'000}, .sample_eps = 64});
}

// The pixel filter of smallpt on one axis: tents about the centres of the halves of a pixel.
TYPED_TEST(MixtureNOver, TentsObeyTheLaws) {
  using S = TypeParam;
  for (const int n : {1, 2, 3}) {
    std::vector<Tent<S>> tents;
    for (int i = 0; i < n; ++i) tents.emplace_back((S(i) + S(0.5)) / S(n) - S(0.5), S(0.5));
    EXPECT_WARP_LAWS(MixtureN(Interval<S>(-1, 1), UniformDiscrete<S>(std::size_t(n)), tents),
                     {.name = fmt::format("{} tents", n), .statistics = {.samples = 50'000}});
  }
}

TEST(MixtureN, PartsNeedNotBeWarps) {
  const TableDist1D<double> choice(std::vector<double>{1, 0, 3});
  const double densities[] = {2, NAN, 4};
  EXPECT_EQ(mixture_pdf(choice, [&](std::size_t i) { return densities[i]; }), 0.25 * 2 + 0.75 * 4);
}

TEST(MixtureN, RefusesNonsense) {
  EXPECT_THROW(MixtureN(Interval<double>(-1, 1), UniformDiscrete<double>(2), std::vector<Tent<double>>(3)), Error);
}

} // namespace
} // namespace mc
