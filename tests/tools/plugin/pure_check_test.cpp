#include <plugin/pure_check.h>
#include <support/files.h>

#include <gmock/gmock.h>

#include <cmath>

namespace {

using carlo::PureCheck;
using testing::HasSubstr;

// Two outputs, x and 2 x.
PureCheck sound() {
  const auto eval = [](std::span<const double> x, std::span<double> values) {
    for (std::size_t i = 0; i < x.size(); ++i) values[2 * i] = x[i], values[2 * i + 1] = 2 * x[i];
  };
  return {.name = "Pair",
          .dim = 1,
          .outputs = 2,
          .point = [](std::size_t i, std::span<double> x) { x[0] = static_cast<double>(i) / 300; },
          .each = eval,
          .many = eval,
          .many_name = "eval_many",
          .many_remedy = "mend it"};
}

std::string refusal_of(const PureCheck& check) {
  return support::error_of([&] { carlo::require_pure(check); });
}

TEST(PureCheck, AcceptsAFunction) {
  EXPECT_EQ(refusal_of(sound()), "");
  PureCheck alone = sound();
  alone.many = {};
  EXPECT_EQ(refusal_of(alone), "");
}

TEST(PureCheck, AcceptsRoundingAndNaN) {
  PureCheck check = sound();
  check.many = [f = check.many](std::span<const double> x, std::span<double> values) {
    f(x, values);
    for (double& value : values) value *= 1 + 1e-12;
  };
  EXPECT_EQ(refusal_of(check), "");
  check.each = check.many = [](std::span<const double>, std::span<double> values) { values[0] = 1; };
  check.outputs = 1;
  EXPECT_THAT(refusal_of(check), HasSubstr("as point 1 of ")) << "only the first value of a batch is written";
}

TEST(PureCheck, RefusesMemory) {
  PureCheck check = sound();
  int calls = 0;
  check.each = [f = check.each, &calls](std::span<const double> x, std::span<double> values) {
    f(x, values);
    values[1] += 1e-3 * ++calls;
  };
  EXPECT_THAT(refusal_of(check), HasSubstr("Pair: at x = ("));
  EXPECT_THAT(refusal_of(check), HasSubstr(" output 1 eval says "));
  EXPECT_THAT(refusal_of(check), HasSubstr("; it must depend on x alone"));
}

TEST(PureCheck, RefusesBatchesThatDiffer) {
  PureCheck check = sound();
  check.many = [f = check.many](std::span<const double> x, std::span<double> values) {
    f(x, values);
    if (x.size() == 7) values[12] = 9;
  };
  EXPECT_THAT(refusal_of(check), HasSubstr("and eval_many, as point 6 of 7, 9; mend it"));
}

} // namespace
