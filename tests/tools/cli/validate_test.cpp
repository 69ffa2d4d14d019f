// carlo validate: selection, verdicts, files and bad input.

#include <catalogue/catalogue.h>
#include <catalogue/descriptions.h>
#include <tools/run_carlo.h>
#include <tools/run_in_process.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace {

using carlo::ValidateCommandOptions;
using support::Output, support::refusal, support::run;
using testing::HasSubstr;

ValidateCommandOptions few(std::vector<std::string> names) {
  ValidateCommandOptions o;
  o.names = std::move(names);
  o.samples = 5000;
  return o;
}

TEST(Validate, Name_SelectsAllItsCases) {
  const Output out = run(few({"CosineHemisphere", "Linear(a=0, b=1)"}));
  EXPECT_EQ(out.code, carlo::exit_ok) << out.text;
  EXPECT_THAT(out.text, testing::AllOf(HasSubstr("4 of 4 cases passed"), HasSubstr("float   pass"),
                                       HasSubstr("double  pass"), HasSubstr("Linear(a=0, b=1)")));
}

TEST(Validate, FormerName_SelectsTheSameCases) {
  for (const auto& [name, former] : {std::pair{"FuzzyMetal", "Metal"}, std::pair{"LightSampler", "LightChoice"}}) {
    ValidateCommandOptions by_name = few({name}), by_former = few({former});
    by_name.list = by_former.list = true;
    const Output out = run(by_name);
    EXPECT_EQ(out.code, carlo::exit_ok) << out.text;
    EXPECT_EQ(run(by_former).text, out.text) << former;
  }
}

TEST(Validate, Scalar_SelectsOneType) {
  ValidateCommandOptions o = few({"CosineHemisphere"});
  o.scalar = "float";
  EXPECT_THAT(run(o).text, HasSubstr("1 of 1 cases passed"));
}

TEST(Validate, ListDescribesEveryDistribution) {
  ValidateCommandOptions o;
  o.list = true;
  const std::string text = run(o).text;
  for (const carlo::Case& c : carlo::catalogue()) {
    EXPECT_THAT(text, testing::ContainsRegex("(^|\n)" + c.name + "[ \n]"));
    EXPECT_NE(carlo::description_of(c.name), "") << c.name << " lacks a sentence in tools/catalogue/descriptions.cpp";
  }
  EXPECT_THAT(text, HasSubstr(fmt::format("{} cases of ", carlo::catalogue().size())));
  EXPECT_THAT(text, testing::ContainsRegex("CosineHemisphere +2  Directions above a plane"));
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 160);
}

TEST(Validate, ListOfANameShowsItsCases) {
  ValidateCommandOptions o;
  o.list = true;
  o.names = {"Linear"};
  const std::string text = run(o).text;
  EXPECT_THAT(text, testing::ContainsRegex("\n  Linear.a=0, b=1. +float, double\n"));
  EXPECT_THAT(text, testing::StartsWith("Linear: Density on [0,1] that is linear from a at 0 to b at 1.\n"));
}

TEST(Validate, ResultsDoNotDependOnThreads) {
  ValidateCommandOptions one = few({"UniformDisk"}), two = one;
  one.threads = 1;
  two.threads = 2;
  const std::filesystem::path folder = testing::TempDir();
  one.json = (folder / "one.json").string();
  two.json = (folder / "two.json").string();
  run(one);
  run(two);
  const auto p = [](const std::string& file) {
    const std::string text = mc::read_file(file);
    return text.substr(text.find("\"p\""), 40);
  };
  EXPECT_EQ(p(one.json), p(two.json));
  EXPECT_THAT(mc::read_file(one.json), testing::AllOf(HasSubstr("\"verdict\": \"pass\""), HasSubstr("\"passed\": true"),
                                                      HasSubstr("\"commit\"")));
}

TEST(Validate, JunitIsWellFormed) {
  ValidateCommandOptions o = few({"UniformDisk"});
  o.junit = (std::filesystem::path(testing::TempDir()) / "junit.xml").string();
  run(o);
  EXPECT_THAT(mc::read_file(o.junit),
              testing::AllOf(HasSubstr("<testsuite name=\"carlo validate\" tests=\"2\" failures=\"0\""),
                             HasSubstr("<property name=\"ns_per_sample\" value="),
                             HasSubstr("<property name=\"again\" value=\"carlo validate 'UniformDisk' --scalar float"),
                             HasSubstr("</testsuite>")));
}

// A thousand outcomes and equally many samples: a density may be wrong by any factor.
TEST(Validate, DetectableErrorAbove100Percent_IsCapped) {
  ValidateCommandOptions o = few({"TableDist1D(outcomes, n=1000)"});
  o.samples = 1000;
  EXPECT_THAT(run(o).text, testing::AllOf(HasSubstr(" >100 % "), testing::Not(HasSubstr("e+0"))));
}

TEST(Validate, HelpExplainsTheColumns) {
  EXPECT_THAT(support::run_carlo("validate --help").output,
              testing::AllOf(HasSubstr("\n  cell  "), HasSubstr("\n  detects  "), HasSubstr("\n  in a cell  "),
                             HasSubstr("\"detects 3.8 %, in a cell 61 %\"")));
}

TEST(Validate, Detect_ChoosesTheSampleCount) {
  ValidateCommandOptions o = few({"UniformDisk"});
  o.detect = 0.05;
  o.scalar = "double";
  const Output out = run(o);
  EXPECT_EQ(out.code, carlo::exit_ok);
  EXPECT_THAT(out.text, HasSubstr("to detect 5 %"));
}

TEST(Validate, BadInput_IsReportedInOneLine) {
  EXPECT_THAT(refusal(few({"CosineHemispher"})),
              HasSubstr("unknown distribution 'CosineHemispher'; did you mean 'CosineHemisphere'?"));
  EXPECT_THAT(refusal(few({})), HasSubstr("name a distribution, or give --all or --list"));
  ValidateCommandOptions o = few({"UniformDisk"});
  o.alpha = 2;
  EXPECT_THAT(refusal(o), HasSubstr("--alpha 2 must lie in (0, 1)"));
  o = few({"UniformDisk"});
  o.samples = 3;
  EXPECT_THAT(refusal(o), HasSubstr("--samples 3"));
  o = few({"UniformDisk"});
  o.scalar = "half";
  EXPECT_THAT(refusal(o), HasSubstr("--scalar 'half' must be float or double"));
  o = few({"UniformDisk"});
  o.json = "/nonexistent/folder/file.json";
  EXPECT_THAT(refusal(o), HasSubstr("/nonexistent/folder"));
  o = few({"UniformDisk"});
  o.detect = -1;
  EXPECT_THAT(refusal(o), HasSubstr("--detect"));
  o = few({"UniformDisk"});
  o.timeout = 60;
  EXPECT_THAT(refusal(o), HasSubstr("--timeout is for foreign code"));
  o.timeout = {};
  o.memory = 4;
  EXPECT_THAT(refusal(o), HasSubstr("--memory is for foreign code"));
}

} // namespace
