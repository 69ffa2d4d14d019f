#include <documents/completion.h>

#include <tools/run_carlo.h>

#include <gmock/gmock.h>

#include <fstream>

namespace {

using carlo::Option, carlo::Subcommand;
using testing::HasSubstr;
using testing::Not;

std::string written(const std::string& name, const std::string& text) {
  const std::string file = testing::TempDir() + name;
  std::ofstream(file) << text;
  return file;
}

// What bash offers for the words of a command line, the last of which is not finished.
std::string offered(const std::string& words) {
  static const std::string file = written("carlo_completion.bash", bash_completion(carlo::subcommands()));
  return support::run("bash -c 'source " + file + "; COMP_WORDS=(" + words +
                      "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); compopt() { :; }; _carlo; echo \"${COMPREPLY[*]}\"'")
      .output;
}

TEST(Completion, Bash_OffersCommandsOptionsAndChoices) {
  EXPECT_EQ(offered("carlo int"), "integrate\n");
  EXPECT_THAT(offered("carlo \"\""), HasSubstr("known-bugs"));
  EXPECT_THAT(offered("carlo \"\""), Not(HasSubstr("worker")));
  EXPECT_EQ(offered("carlo render --target"), "--target-error\n");
  EXPECT_THAT(offered("carlo render --adaptive o"), testing::AnyOf("on off\n", "off on\n"));
  EXPECT_EQ(offered("carlo render --seed 1"), "\n");
}

TEST(Completion, EveryShellKnowsEveryOption) {
  const std::vector<Subcommand> all = carlo::subcommands();
  const std::string bash = bash_completion(all), zsh = zsh_completion(all), fish = fish_completion(all);
  for (const Subcommand& c : all) {
    if (c.about.hidden) continue;
    for (const Option& o : c.options) {
      if (!o.names.starts_with('-') || o.hidden) continue;
      const std::string name = o.names.substr(o.names.find(',') + 1);
      EXPECT_THAT(bash, HasSubstr(name));
      EXPECT_THAT(zsh, HasSubstr(name + "["));
      const std::string spelled = name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      EXPECT_THAT(fish, HasSubstr("'__fish_seen_subcommand_from " + c.about.name + "'"));
      EXPECT_THAT(fish, HasSubstr(spelled)) << c.about.name;
    }
  }
}

TEST(Completion, ScriptsParse) {
  const std::vector<Subcommand> all = carlo::subcommands();
  const auto parses = [](const std::string& shell, const std::string& file) {
    if (support::run("command -v " + shell).exit_code != 0) return std::string();
    return support::run(shell + " -n '" + file + "' 2>&1").output;
  };
  EXPECT_EQ(parses("bash", written("carlo.bash", bash_completion(all))), "");
  EXPECT_EQ(parses("zsh", written("_carlo", zsh_completion(all))), "");
  EXPECT_EQ(parses("fish", written("carlo.fish", fish_completion(all))), "");
}

} // namespace
