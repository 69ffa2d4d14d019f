#include <render/integrator/strategy.h>

#include <mc/core/error.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(Strategy, UnknownName_SuggestsNearest) {
  for (const Strategy& s : strategies) EXPECT_EQ(strategy_from(s.name).name, s.name);
  try {
    strategy_from("mist");
    ADD_FAILURE();
  } catch (const mc::Error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("'mis'"));
    EXPECT_THAT(e.what(), testing::HasSubstr("hemisphere"));
  }
}

TEST(Strategy, TableIsConsistent) {
  for (const Strategy& s : strategies) {
    EXPECT_TRUE(s.guiding_fraction >= 0 && s.guiding_fraction <= 1) << s.name;
    EXPECT_EQ(s.guiding_fraction > 0, s.guiding_target != GuidingTarget::none) << s.name;
  }
}

} // namespace
