#include <input/words.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using testing::ElementsAre;

TEST(Words, StandBetweenSeparatorsWithoutBlanks) {
  EXPECT_THAT(carlo::split("a, b,,c ", ','), ElementsAre("a", "b", "", "c"));
  EXPECT_THAT(carlo::split("0:1:.1", ':'), ElementsAre("0", "1", ".1"));
  EXPECT_THAT(carlo::split("", ','), ElementsAre(""));
  EXPECT_THAT(carlo::split("  ", ','), ElementsAre(""));
  EXPECT_THAT(carlo::split("a,", ','), ElementsAre("a", ""));
  EXPECT_THAT(carlo::split("\ta b\r\n,\nc", ','), ElementsAre("a b", "c"));
}

} // namespace
