#include <mc/domain/triangle.h>

#include "support/domain_laws.h"

namespace {

TEST(Triangle, Chart) {
  // The second coordinate is divided by 1 - b0, so the samples must come close to that corner.
  support::expect_domain_laws(mc::Triangle<float>(), 4000);
  support::expect_domain_laws(mc::Triangle<double>(), 4000);
}

TEST(Triangle, Edges) {
  const mc::Triangle<float> t;
  EXPECT_TRUE(t.contains({1, 0}));
  EXPECT_TRUE(t.contains({0.5f, 0.5f}));
  EXPECT_FALSE(t.contains({0.6f, 0.5f}));
  EXPECT_FALSE(t.contains({-0.1f, 0.5f}));
  EXPECT_EQ(t.to_unit({1, 0}), mc::Vec2<float>(1, 0));
}

} // namespace
