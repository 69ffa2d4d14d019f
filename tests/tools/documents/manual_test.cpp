#include <documents/manual.h>

#include <mc/core/text.h>
#include <tools/run_carlo.h>

#include <gmock/gmock.h>

namespace {

using carlo::Option, carlo::Subcommand;
using testing::HasSubstr;

std::string in_troff(std::string text) {
  for (std::size_t at = 0; (at = text.find('-', at)) != text.npos; at += 2) text.replace(at, 1, "\\-");
  return text;
}

TEST(Manual, NamesEveryOption) {
  for (const Subcommand& c : carlo::subcommands()) {
    const std::string page = manual_page("carlo-" + c.about.name, help_page(c), "9.8.7", {"carlo"});
    EXPECT_THAT(page, HasSubstr(".SH SYNOPSIS\n.B carlo " + in_troff(c.about.name)));
    for (const Option& o : c.options) {
      if (o.hidden) continue;
      EXPECT_THAT(page, HasSubstr(in_troff(o.names.substr(o.names.find(',') + 1)))) << c.about.name;
    }
  }
}

TEST(Manual, NoTextIsTakenForACommand) {
  carlo::HelpPage page{"Sums .5 and \\n", "carlo x", {}, {{"Notes", {{"", ".5 is a number"}, {"'", "'quoted' text"}}}}};
  const std::string text = manual_page("carlo-x", page, "1.0.0", {"carlo", "carlo-y"});
  EXPECT_THAT(text, HasSubstr(".PP\n\\&.5 is a number\n"));
  EXPECT_THAT(text, HasSubstr("\n\\&'quoted' text\n"));
  EXPECT_THAT(text, HasSubstr("and \\en"));
  EXPECT_THAT(text, HasSubstr(".BR carlo (1),\n.BR carlo\\-y (1)\n"));
  for (const std::string_view line : mc::split(text, '\n'))
    if (line.starts_with('.')) {
      EXPECT_THAT(std::string(line.substr(0, 3)), testing::AnyOf(".TH", ".SH", ".PP", ".TP", ".B ", ".BR")) << line;
    }
}

// groff reports commands that it does not know and fonts that stay open.
TEST(Manual, GroffHasNoWarnings) {
  if (support::run("command -v groff").exit_code != 0) GTEST_SKIP() << "groff is not installed";
  for (const Subcommand& c : carlo::subcommands()) {
    const std::string file = testing::TempDir() + "carlo_manual.1";
    FILE* out = std::fopen(file.c_str(), "w");
    std::fputs(manual_page("carlo-" + c.about.name, help_page(c), "1.0.0", {"carlo"}).c_str(), out);
    std::fclose(out);
    const auto run = support::run("groff -man -Tutf8 -ww '" + file + "' 2>&1 >/dev/null");
    EXPECT_EQ(run.output, "") << c.about.name;
  }
}

} // namespace
