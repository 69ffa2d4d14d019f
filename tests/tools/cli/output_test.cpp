// carlo with an output that cannot be written, and with an output that is no file.

#include <tools/interrupt_carlo.h>
#include <tools/run_carlo.h>

#include <support/files.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <algorithm>
#include <filesystem>

namespace {

using support::ProcessResult;
using testing::AllOf;
using testing::HasSubstr;

struct OutputTest : support::ScratchTest {
  static constexpr const char* integral = "' integrate 'x*x' -d x=0:1 --max-calls 1000 ";
  std::string carlo(const std::string& arguments) const { return "'" CARLO_PATH + (integral + arguments); }
  void expect_one_line(const ProcessResult& run, const std::string& words) const {
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_THAT(run.output, AllOf(testing::StartsWith("carlo: "), HasSubstr(words)));
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
  }
};

TEST_F(OutputTest, FullStandardOutput_IsAnError) {
  expect_one_line(support::run("(" + carlo("3>&1 1>/dev/full 2>&3") + ")"),
                  "cannot write to standard output: No space left on device");
  for (const char* words : {"--help", "--version", "integrate --list", "known-bugs --list"})
    expect_one_line(support::run(std::string("('" CARLO_PATH "' ") + words + " 3>&1 1>/dev/full 2>&3)"),
                    "cannot write to standard output");
}

TEST_F(OutputTest, ClosedStandardOutput_IsAnErrorAndTouchesNoFile) {
  const std::string json = write("kept.json", "");
  expect_one_line(support::run("(" + carlo("--json '" + json + "' 3>&1 1>&- 2>&3") + ")"),
                  "cannot write to standard output");
  EXPECT_THAT(mc::read_file(json), HasSubstr("\"value\"")) << "the file has its content and no line of the output";
}

// The reader closes the pipe before carlo writes. Like a program of coreutils, carlo ends silently by SIGPIPE, which a
// shell reports as 141.
TEST_F(OutputTest, AClosedPipeEndsQuietly) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  for (const std::string& command : {carlo(""), carlo("--json -"), std::string("'" CARLO_PATH "' --help "),
                                     std::string("'" CARLO_PATH "' --version "),
                                     std::string("'" CARLO_PATH "' validate UniformDisk --samples 1000 ")}) {
    const std::string script = "exec 3<>'" + path("pipe") + "' 4>'" + path("pipe") + "' 3<&-; " + command +
                               " 1>&4 2>'" + path("error") + "'; echo $? > '" + path("code") + "'";
    support::run(script);
    EXPECT_EQ(mc::read_file(path("code")), "141\n") << command;
    EXPECT_THAT(mc::read_file(path("error")), testing::Not(HasSubstr("ipe"))) << command;
  }
}

TEST_F(OutputTest, DevStdout_AcceptsJson) {
  const ProcessResult run = support::run(carlo("--json /dev/stdout"));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LT(run.output.find("calls in"), run.output.find("\"commit\"")) << run.output;
  support::run(carlo("--json /dev/stdout > '" + path("both") + "'"));
  EXPECT_THAT(mc::read_file(path("both")), AllOf(HasSubstr("calls in"), HasSubstr("\"commit\"")));
}

// All other messages go to standard error, and no file "-" is created.
TEST_F(OutputTest, Dash_IsStandardOutputForJson) {
  const auto said = [&](const std::string& arguments) { // on standard output; standard error goes to a file
    return support::run("(cd '" + folder.string() + "' && '" CARLO_PATH "' " + arguments + " 2>words)").output;
  };
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  const std::string validate = "validate UniformDisk --samples 1000 --scalar double";
  for (const std::string& command : {std::string("integrate 'x*x' -d x=0:1 --max-calls 1000"),
                                     std::string("known-bugs P1 --samples 8000"), validate}) {
    const std::string json = said(command + " --json -");
    EXPECT_TRUE(nlohmann::json::accept(json)) << json;
    EXPECT_THAT(json, HasSubstr("\"commit\""));
    const std::string words = mc::read_file(path("words"));
    EXPECT_EQ(lines(words), lines(said(command))) << words;
    EXPECT_FALSE(std::filesystem::exists(path("-")));
  }
  EXPECT_THAT(said(validate + " --junit -"), AllOf(testing::StartsWith("<?xml"), testing::EndsWith("</testsuite>\n")));
  expect_one_line(support::run_carlo(validate + " --junit - --json -"), "--json and --junit would both write '-'");
  expect_one_line(support::run_carlo("validate --list --json -"), "--list checks nothing");
  expect_one_line(support::run_carlo("integrate 'x' -d x=0:1 --save-density -"), "a density goes to a file");
  expect_one_line(support::run_carlo("integrate 1/0 -d x=2:3 --json -"), "must be finite");
  EXPECT_THAT(support::run("(" + carlo("--json - 3>&1 1>/dev/full 2>&3") + ")").output,
              HasSubstr("carlo: cannot write to standard output: No space left on device\n"));
}

TEST_F(OutputTest, Device_IsNotReplaced) {
  const std::string full = path("full.json");
  if (mknod(full.c_str(), S_IFCHR | 0666, makedev(1, 7)) != 0 || !std::ofstream(full).is_open())
    GTEST_SKIP() << "device nodes cannot be made here";
  const ProcessResult run = support::run(carlo("--json '" + full + "'"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, HasSubstr("full.json': No space left on device"));
  EXPECT_TRUE(std::filesystem::is_character_file(full));
}

TEST_F(OutputTest, FolderWithQuotes_GetsItsPlots) {
  const std::string out = path("it's \"$(here)\"");
  const ProcessResult run =
      support::run_carlo("converge pi --max-n 64 --replicates 8 -o \"" + path("it's \\\"\\$(here)\\\"") + "\"");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_TRUE(std::filesystem::exists(out + "/pi.csv")) << run.output;
  if (!support::has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_TRUE(std::filesystem::exists(out + "/pi.svg")) << run.output;
  EXPECT_TRUE(std::filesystem::exists(out + "/pi.png"));
  EXPECT_FALSE(std::filesystem::exists(out + "/pi.log"));
}

TEST_F(OutputTest, FullDisk_PlotIsAnErrorAndUserFilesStay) {
  if (!support::has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const std::string arguments = "converge pi --max-n 64 --replicates 8 -o '" + folder.string() + "'";
  write("pi.log", "mine");
  std::filesystem::create_symlink("/dev/full", path("pi.svg"));
  const ProcessResult full = support::run("('" CARLO_PATH "' " + arguments + " 2>&1 >/dev/null)");
  expect_one_line(full, "pi.svg': No space left on device");
  std::filesystem::remove(path("pi.svg"));
  const ProcessResult run = support::run_carlo(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_EQ(mc::read_file(path("pi.log")), "mine");
}

TEST_F(OutputTest, CtrlC_WritesFinishedResults) {
  const ProcessResult run =
      support::interrupt_carlo("validate --all --threads 1 --samples 400000 --json '" + path("v.json") + "'", " pass ");
  EXPECT_EQ(run.exit_code, 130) << run.output;
  EXPECT_THAT(run.output, HasSubstr("interrupted: "));
  EXPECT_THAT(mc::read_file(path("v.json")),
              AllOf(HasSubstr("\"interrupted\": true"), HasSubstr("\"passed\": false"), HasSubstr("\"name\": ")));
  // Interrupts within a case, which has far too many samples to finish.
  const ProcessResult one =
      support::interrupt_carlo("validate CosineHemisphere --threads 1 --samples 1e12", "in a cell");
  EXPECT_EQ(one.exit_code, 130) << one.output;
  EXPECT_THAT(one.output, HasSubstr("interrupted: 0 of 2 cases were finished"));
  const ProcessResult slips = support::interrupt_carlo("known-bugs --threads 1 --json '" + path("s.json") + "'");
  EXPECT_EQ(slips.exit_code, 130) << slips.output;
  EXPECT_THAT(slips.output, HasSubstr("interrupted: "));
  EXPECT_THAT(mc::read_file(path("s.json")), AllOf(HasSubstr("\"interrupted\": true"), HasSubstr("\"passed\": false")));
  const ProcessResult curves = support::interrupt_carlo("converge --max-n 4e6 --threads 1 -o '" + path("c") + "'");
  EXPECT_EQ(curves.exit_code, 130) << curves.output;
  EXPECT_THAT(curves.output, HasSubstr("interrupted: "));
}

} // namespace
