// The output shown in the README is the output of its commands, except for timings.

#include <tools/run_carlo.h>

#include <mc/core/file.h>

#include <support/files.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>
#include <vector>

namespace {

// Replaces timings by one word each: durations, rates, the last two columns (ns per sample, seconds) of the table of
// verdicts, and the noise of a picture.
std::string without_times(const std::string& line) {
  static const std::regex times(R"([0-9.]+ (ms|s|min)\b)"), rates(R"([0-9.]+ [kM]?(samples|rays)/s)"),
      columns(R"((%|-) +[0-9.-]+ +[0-9.]+$)"), noise(R"(error [0-9.]+ % \(worst block [0-9.]+ %\))");
  const std::string a = std::regex_replace(std::regex_replace(line, rates, "RATE"), noise, "NOISE");
  return std::regex_replace(std::regex_replace(a, times, "TIME"), columns, "$1 TIMES");
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) all.push_back(without_times(line));
  return all;
}

struct ReadmeCommand {
  std::string command;
  std::vector<std::string> output; ///< "..." stands for any lines
};

std::vector<ReadmeCommand> commands(const std::string& readme) {
  std::vector<ReadmeCommand> all;
  bool inside = false;
  for (const std::string& line : lines(readme)) {
    if (line.starts_with("```")) inside = false;
    else if (line.starts_with("$ carlo ")) {
      all.push_back({line.substr(8), {}});
      inside = true;
    } else if (inside) all.back().output.push_back(line);
  }
  return all;
}

bool matches(const std::vector<std::string>& shown, const std::vector<std::string>& printed) {
  std::size_t at = 0;
  bool anywhere = false;
  for (const std::string& line : shown) {
    if (line == "...") {
      anywhere = true;
      continue;
    }
    while (anywhere && at < printed.size() && printed[at] != line) ++at;
    if (at == printed.size() || printed[at] != line) return false;
    ++at;
    anywhere = false;
  }
  return anywhere || at == printed.size();
}

struct Readme : support::ScratchTest {};

TEST_F(Readme, ShownOutputMatchesTheCommands) {
  std::vector<ReadmeCommand> all;
  std::vector<std::filesystem::path> pages = {MC_SOURCE_DIR "/README.md"};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(MC_SOURCE_DIR "/docs"))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  for (const std::filesystem::path& page : pages)
    for (ReadmeCommand& command : commands(mc::read_file(page.string()))) all.push_back(std::move(command));
  EXPECT_GE(all.size(), 5u);
  std::filesystem::create_directory_symlink(MC_SOURCE_DIR "/librender", folder / "librender");
  for (const ReadmeCommand& shown : all) {
    const support::ProcessResult run =
        support::run("cd '" + folder.string() + "' && '" CARLO_PATH "' " + shown.command);
    EXPECT_EQ(run.exit_code, 0) << shown.command;
    EXPECT_TRUE(matches(shown.output, lines(run.output))) << "$ carlo " << shown.command << "\n" << run.output;
  }
}

TEST(ReadmeTest, DetectsDifferences) {
  EXPECT_EQ(without_times("A float pass 0.26 2.6 %  49 %  2.8  0.31"),
            without_times("A float pass 0.26 2.6 %  49 %  7  3"));
  EXPECT_EQ(without_times("in 2 ms by rqmc, 737 ksamples/s"), without_times("in 1.5 s by rqmc, 1 Msamples/s"));
  EXPECT_TRUE(matches({"a", "...", "c"}, {"a", "b", "b", "c"}));
  EXPECT_FALSE(matches({"a", "...", "c"}, {"a", "b"}));
  EXPECT_FALSE(matches({"a"}, {"a", "b"}));
  EXPECT_FALSE(matches({"a", "b"}, {"a"}));
}

} // namespace
