#include <mc/check/subject/make_distribution.h>

#include <mc/table/alias_table.h>
#include <mc/warp/disk.h>

#include <gtest/gtest.h>

namespace {

using mc::PointArray, mc::AnyDistribution;

TEST(MakeDistribution, Warp_SetsInverseOracleAndBreaks) {
  const mc::UniformDisk<float> disk;
  const AnyDistribution s = mc::make_distribution("disk", disk);
  EXPECT_TRUE(s.is_float);
  EXPECT_EQ(s.uniforms, 2);
  EXPECT_EQ(s.domain.point_size, 2);
  const auto drawn = s.sample({0.25, 0.75});
  const mc::Vec2<float> x = disk.sample({0.25f, 0.75f});
  EXPECT_EQ(drawn->x, (PointArray{static_cast<double>(x[0]), static_cast<double>(x[1])}));
  EXPECT_EQ(s.pdf(drawn->x), static_cast<double>(disk.pdf(x)));
  EXPECT_NEAR((*s.invert(drawn->x))[1], 0.75, 1e-6);
  EXPECT_NEAR(static_cast<double>((*s.oracle->sample({0.25, 0.75}))[0]), drawn->x[0], 1e-6);
  EXPECT_GT(s.ns_per_sample(), 0);
}

TEST(MakeDistribution, Chart_IsInDouble) {
  const AnyDistribution s = mc::make_distribution("disk", mc::UniformDisk<float>());
  const mc::AnyDomain::Coordinates v{0.3, 0.7};
  const mc::AnyDomain::DomainPoint image = s.domain.from_unit(v);
  EXPECT_NEAR(s.domain.to_unit(image.x)[0], v[0], 1e-15);
  EXPECT_NEAR(image.jacobian, mc::pi<double>, 1e-14);
  EXPECT_FALSE(s.domain.contains({2, 0}));
}

TEST(MakeDistribution, StatedWeight_IsComparedWithF) {
  struct Weighted {
    double x, weight;
  };
  const auto with = [](double bug) {
    return mc::make_distribution(
        "weighted", mc::Interval<double>(),
        [bug](double u) {
          return Weighted{u, bug * u / 1.0};
        },
        [](double) { return 1.0; }, [](double x) { return x; });
  };
  EXPECT_NEAR(with(1).sample({0.5})->weight, 1, 1e-12);
  EXPECT_NEAR(with(1.1).sample({0.5})->weight, 1.1, 1e-12);
}

TEST(MakeDistribution, StatedPdfWithoutWeight_IsComparedWithPdf) {
  struct Dense {
    double x, pdf;
  };
  const auto with = [](double bug) {
    return mc::make_distribution(
        "dense", mc::Interval<double>(),
        [bug](double u) {
          return Dense{std::sqrt(u), bug * 2 * std::sqrt(u)};
        },
        [](double x) { return 2 * x; });
  };
  EXPECT_TRUE(with(1).states_weight);
  EXPECT_NEAR(with(1).sample({0.5})->weight, 1, 1e-12);
  EXPECT_NEAR(with(0.9).sample({0.5})->weight, 1.1, 1e-12);
}

TEST(MakeDistribution, DiscreteDistribution_HasOutcomesOnly) {
  const AnyDistribution s = mc::make_discrete_distribution("alias", mc::AliasTable(std::vector<double>{1, 0, 3}));
  EXPECT_EQ(s.domain.dim, 0);
  EXPECT_EQ(s.atoms, (std::vector<double>{0.25, 0, 0.75}));
  EXPECT_NE(s.sample({0})->atom, 1);
}

} // namespace
