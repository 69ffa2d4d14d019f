#include <render/core/dispatch.h>

#include <gtest/gtest.h>

namespace {

struct Number : std::variant<int, double> {
  using variant::variant;
};

TEST(Dispatch, CallsWithTheMemberOfADerivedVariant) {
  const auto twice = [](auto x) { return double(x + x); };
  EXPECT_EQ(render::dispatch(Number(3), twice), 6);
  EXPECT_EQ(render::dispatch(Number(1.5), twice), 3);
}

} // namespace
