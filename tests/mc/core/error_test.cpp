#include <mc/core/error.h>

#include <gtest/gtest.h>

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

} // namespace
