#include <mc/core/error.h>

#include <gtest/gtest.h>

#include <array>

namespace {

TEST(Error, RequireFormatsOneLine) {
  EXPECT_NO_THROW(mc::require(true, "unused {}", 1));
  try {
    mc::require(false, "Table: weights[{}] = {} is not finite and >= 0", 3, -1.5);
    FAIL() << "require(false) must throw";
  } catch (const mc::Error& e) {
    EXPECT_STREQ(e.what(), "Table: weights[3] = -1.5 is not finite and >= 0");
  }
}

TEST(Error, ContextIsPutInFront) {
  EXPECT_EQ(mc::with_context("scene.xml:14", [] { return 7; }), 7);
  try {
    mc::with_context("scene.xml:14: emitter", [] { mc::require(false, "radiance {} is negative", -1); });
    FAIL();
  } catch (const mc::Error& e) {
    EXPECT_STREQ(e.what(), "scene.xml:14: emitter: radiance -1 is negative");
  }
}

TEST(Error, NearestName) {
  const std::array known{"independent", "stratified", "sobol"};
  EXPECT_EQ(mc::did_you_mean("sobal", known), "; did you mean 'sobol'?");
  EXPECT_EQ(mc::did_you_mean("xyzzyxyzzyxyzzy", known), "");
  EXPECT_EQ(mc::edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(mc::edit_distance("", "abc"), 3u);
}

} // namespace
