// Parameter sets and sweeps.

#include <input/parameters.h>

#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using carlo::ParameterSet, carlo::parse_parameters;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Parameters, SingleValues_AreOneSet) {
  EXPECT_THAT(parse_parameters("alpha=0.1, n=3"), ElementsAre(ParameterSet{{"alpha", 0.1}, {"n", 3}}));
  EXPECT_THAT(parse_parameters("x = -1e-3"), ElementsAre(ParameterSet{{"x", -1e-3}}));
}

TEST(Parameters, ListsAndRanges_AreEveryCombination) {
  EXPECT_THAT(parse_parameters("a=1,2,n=3,4"),
              ElementsAre(ParameterSet{{"a", 1}, {"n", 3}}, ParameterSet{{"a", 1}, {"n", 4}},
                          ParameterSet{{"a", 2}, {"n", 3}}, ParameterSet{{"a", 2}, {"n", 4}}));
  // A range includes both ends, and 0.3 is exact, unlike 0.1 + 0.1 + 0.1.
  EXPECT_THAT(parse_parameters("a=0.1:0.5:0.1"),
              ElementsAre(ParameterSet{{"a", 0.1}}, ParameterSet{{"a", 0.2}}, ParameterSet{{"a", 0.3}},
                          ParameterSet{{"a", 0.4}}, ParameterSet{{"a", 0.5}}));
  EXPECT_THAT(parse_parameters("a=1:0:-0.5,7"), ElementsAre(ParameterSet{{"a", 1}}, ParameterSet{{"a", 0.5}},
                                                            ParameterSet{{"a", 0}}, ParameterSet{{"a", 7}}));
}

TEST(Parameters, InvalidText_IsOneLineError) {
  const auto refused = [](const std::string& text) { return support::error_of([&] { parse_parameters(text); }); };
  EXPECT_THAT(refused(""), HasSubstr("not of the form name=number"));
  EXPECT_THAT(refused("0.1,a=1"), HasSubstr("'0.1' in '0.1,a=1' is not of the form name=number"));
  EXPECT_THAT(refused("a=1,a=2"), HasSubstr("'a' stands twice"));
  EXPECT_THAT(refused("a=0:1"), HasSubstr("not of the form name=first:last:step"));
  EXPECT_THAT(refused("a=0:1:-1"), HasSubstr("does not lead from 0 to 1"));
  EXPECT_THAT(refused("a=0:1:0"), HasSubstr("does not lead from 0 to 1"));
  EXPECT_THAT(refused("a=0:1:1e-9"), HasSubstr("at most 10000"));
  EXPECT_THAT(refused("a=0:99:1,b=0:999:1"), HasSubstr("more than 10000 sets"));
  EXPECT_THAT(refused("a=inf"), HasSubstr("not of the form"));
}

} // namespace
