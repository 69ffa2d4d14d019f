#include <options/checkpoint_options.h>
#include <options/files.h>

#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using namespace carlo;
using support::error_of;
using testing::HasSubstr;

struct CheckpointOptionsTest : support::ScratchTest {};

TEST(ParseDuration, AcceptsUnits) {
  for (const auto& [text, seconds] : {std::pair("90", 90.0), std::pair("90s", 90.0), std::pair("1.5min", 90.0),
                                      std::pair("2h", 7200.0), std::pair("500ms", 0.5), std::pair("0", 0.0)})
    EXPECT_EQ(parse_duration("--every", text), seconds) << text;
  for (const char* text : {"", "s", "-1", "1d", "1 s", "inf", "nan", "1e99", "1s2"})
    EXPECT_THAT(error_of([&] { parse_duration("--every", text); }),
                HasSubstr("--every '" + std::string(text) + "' must be a time in [0, 1e9] s, such as 90s"));
}

// Every kind of option counts, unless it is an output, is not given or is ignored. An input counts by its bytes.
TEST_F(CheckpointOptionsTest, RunIdentity_HasWhatResultsDependOn) {
  bool flag = true, off = false;
  int threads = 3;
  double alpha = 0.01;
  std::optional<double> none, time = 2.5;
  std::string input = write("a", "bytes"), output = path("b"), text = "x*y", folder_name = "out";
  std::vector<std::string> words = {"p", "q"};
  const std::vector<Option> options = {{"--flag", "", &flag, ""},
                                       {"--off", "", &off, ""},
                                       {"--threads", "N", &threads, ""},
                                       {"-a,--alpha", "P", &alpha, ""},
                                       {"--none", "T", &none, ""},
                                       {"--time", "T", &time, ""},
                                       input_file({"--plugin", "FILE", &input, ""}),
                                       output_file({"--json", "FILE", &output, ""}),
                                       output_folder({"-o,--output", "FOLDER", &folder_name, ""}, {"c"}),
                                       {"INTEGRAND", "", &words, ""},
                                       {"--let", "TEXT", &text, ""}};
  mc::RunIdentity identity = run_identity(options, {"--threads"});
  ASSERT_EQ(identity.front().first, "the build");
  identity.erase(identity.begin());
  const std::string hash = identity.at(3).second;
  const mc::RunIdentity expected = {{"--flag", "on"},     {"--alpha", "0.01"},
                                    {"--time", "2.5"},    {"the content of the file of --plugin", hash},
                                    {"INTEGRAND", "p q"}, {"--let", "x*y"}};
  EXPECT_EQ(identity, expected);
  write("a", "other");
  EXPECT_NE(run_identity(options, {}).at(5).second, hash);
}

TEST_F(CheckpointOptionsTest, OpenCheckpoint_WritesToTheFileOfResume) {
  EXPECT_EQ(open_checkpoint({}, {}), nullptr);
  const std::string file = path("a.ckpt");
  open_checkpoint({.checkpoint = file}, {{"--seed", "1"}})->save_and_wait();
  EXPECT_THAT(error_of([&] {
                open_checkpoint({.resume = file}, {{"--seed", "2"}});
              }),
              testing::StartsWith("--resume: '" + file + "' is of another run: --seed was '1' and is '2' now"));
  std::filesystem::last_write_time(file, std::filesystem::file_time_type::min());
  open_checkpoint({.resume = file}, {{"--seed", "1"}})->save_and_wait();
  EXPECT_NE(std::filesystem::last_write_time(file), std::filesystem::file_time_type::min());
  EXPECT_THAT(error_of([&] { open_checkpoint({.checkpoint = file, .every = "x"}, {}); }), HasSubstr("--every 'x'"));
}

} // namespace
