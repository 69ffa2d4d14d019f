#include <render/integrator/strategy.h>

#include <mc/core/error.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(Strategy, NamesAndTheirSlips) {
  for (const Strategy& s : strategies) EXPECT_EQ(strategy_from(s.name).name, s.name);
  try {
    strategy_from("mist");
    ADD_FAILURE();
  } catch (const mc::Error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("'mis'"));
    EXPECT_THAT(e.what(), testing::HasSubstr("hemisphere"));
  }
}

TEST(Strategy, RowsMakeSense) {
  for (const Strategy& s : strategies) {
    EXPECT_TRUE(s.share >= 0 && s.share <= 1) << s.name;
    EXPECT_EQ(s.share > 0, s.target != Target::nothing) << s.name;
  }
}

} // namespace
