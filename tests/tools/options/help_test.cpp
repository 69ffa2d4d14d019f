// The help of every subcommand: width, groups, sentences, examples.

#include <options/help.h>
#include <terminal/columns.h>
#include <tools/run_carlo.h>

#include <mc/core/text.h>

#include <gmock/gmock.h>

#include <set>

namespace {

using carlo::Option, carlo::Subcommand;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::vector<Subcommand> shown() {
  std::vector<Subcommand> all = carlo::subcommands();
  std::erase_if(all, [](const Subcommand& c) { return c.about.hidden; });
  return all;
}

void expect_fits(const std::string& text, std::size_t columns) {
  for (const std::string_view line : mc::split(text, '\n')) EXPECT_LE(carlo::columns_of(line), columns) << line;
}

TEST(Help, FitsTheWidthOfTheTerminal) {
  for (const std::size_t columns : {72u, 80u, 120u}) {
    expect_fits(help_of(shown(), columns), columns);
    for (const Subcommand& c : shown()) expect_fits(help_of(c, columns), columns);
  }
  expect_fits(support::run(std::string("COLUMNS=60 '" CARLO_PATH "' integrate --help")).output,
              62); // one example is longer
  expect_fits(support::run_carlo("render --help").output, 80);
  EXPECT_THAT(support::run(std::string("COLUMNS=200 '" CARLO_PATH "' render --help")).output,
              testing::ContainsRegex("\n[^\n]{120,200}\n"));
}

TEST(Help, EveryOptionHasAGroupAndSentences) {
  for (const Subcommand& c : shown()) {
    ASSERT_FALSE(c.options.empty()) << c.about.name;
    EXPECT_EQ(c.options.front().group, carlo::common_options) << c.about.name;
    EXPECT_EQ(c.options.back().group, carlo::expert_options) << c.about.name;
    for (const Option& o : c.options) {
      EXPECT_FALSE(o.group.empty()) << c.about.name << ' ' << o.names;
      EXPECT_GE(o.help.size(), 12u) << c.about.name << ' ' << o.names;
      EXPECT_TRUE(o.help.ends_with('.')) << c.about.name << ' ' << o.names;
      EXPECT_TRUE(std::isupper(static_cast<unsigned char>(o.help.front()))) << c.about.name << ' ' << o.names;
    }
  }
}

TEST(Help, AGroupIsOneRunOfOptions) {
  for (const Subcommand& c : shown()) {
    std::set<std::string> closed;
    std::string open;
    for (const Option& o : c.options) {
      if (o.group == open) continue;
      EXPECT_TRUE(closed.insert(o.group).second) << c.about.name << ' ' << o.group;
      open = o.group;
    }
  }
}

TEST(Help, HasThreeExamplesWhoseOptionsExist) {
  for (const Subcommand& c : shown()) {
    EXPECT_EQ(c.about.examples.size(), 3u) << c.about.name;
    std::string names = ",";
    for (const Option& o : c.options) names += o.names + ",";
    for (const carlo::HelpEntry& e : c.about.examples) {
      EXPECT_TRUE(e.term.starts_with("carlo " + c.about.name)) << e.term;
      for (const std::string_view word : mc::split(e.term, ' '))
        if (word.starts_with("-")) {
          EXPECT_THAT(names, HasSubstr("," + std::string(word) + ",")) << e.term;
        }
    }
  }
}

TEST(Help, ShowsWhatItIsMadeOf) {
  const std::string render = support::run_carlo("render --help").output;
  EXPECT_THAT(render, AllOf(HasSubstr("Usage: carlo render [OPTIONS] [SCENE]\n"), HasSubstr("\nExamples:\n"),
                            HasSubstr("\nCommon options:\n"), HasSubstr("\nExpert options:\n"),
                            HasSubstr("\nWhich option when:\n"), HasSubstr("\nExit codes:\n"),
                            HasSubstr("-o, --output FILE"), HasSubstr("Not with --spp."), Not(HasSubstr("Excludes"))));
  EXPECT_THAT(support::run_carlo("points --help").output, HasSubstr("Default: 1024."));
  EXPECT_THAT(support::run_carlo("compare --help").output, HasSubstr("Usage: carlo compare [OPTIONS] A B\n"));
  const std::string all = support::run_carlo("--help").output;
  for (const Subcommand& c : shown()) EXPECT_THAT(all, HasSubstr("\n  " + c.about.name)) << c.about.name;
  EXPECT_THAT(all, AllOf(Not(HasSubstr("worker")), Not(HasSubstr("slips"))));
}

TEST(Help, AnAliasRunsItsSubcommand) {
  EXPECT_EQ(support::run_carlo("slips --list").output, support::run_carlo("known-bugs --list").output);
  EXPECT_EQ(support::run_carlo("slips --help").output, support::run_carlo("known-bugs --help").output);
}

TEST(Help, TwoOptionsThatExcludeEachOtherAreRefusedWithTheReason) {
  for (const Subcommand& c : shown())
    for (const Option& o : c.options)
      for (const carlo::Exclusion& e : o.excludes) {
        EXPECT_GE(e.reason.size(), 20u) << o.names;
        const auto other = std::find_if(c.options.begin(), c.options.end(), [&](const Option& x) {
          return x.names == e.option || x.names.ends_with("," + e.option);
        });
        EXPECT_NE(other, c.options.end())
            << o.names << " excludes " << e.option << ", which " << c.about.name << " lacks";
      }
  EXPECT_EQ(support::run_carlo("render a.xml --spp 1 --time 2").output,
            "carlo: --spp and --time exclude each other: --time and --target-error choose the number of samples; leave "
            "one out (see carlo render --help)\n");
  EXPECT_THAT(support::run_carlo("points sobol --count 9 --points-file a.csv").output,
              HasSubstr("--points-file and --count exclude each other: the file determines its points"));
}

} // namespace
