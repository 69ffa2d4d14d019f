// Every command states the memory that it needs, and refuses before it allocates.

#include <tools/run_carlo.h>

#include <render/io/image/image_io.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <regex>

namespace {

using support::ProcessResult;
using testing::AllOf;
using testing::ContainsRegex;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::string cbox = MC_SOURCE_DIR "/librender/scenes/cbox.xml";

struct MemoryOfCommands : support::ScratchTest {
  void SetUp() override {
    ScratchTest::SetUp();
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers reserve more memory than any limit allows";
#endif
  }

  // Runs carlo in the scratch folder with at most so much data.
  ProcessResult run_within(int mib, const std::string& arguments) const {
    return support::run("cd '" + folder.string() + "' && ulimit -d " + std::to_string(1024 * mib) +
                        " && '" CARLO_PATH "' " + arguments);
  }

  void expect_refused(int mib, const std::string& arguments, const std::string& what, const std::string& remedy) const {
    const ProcessResult run = run_within(mib, arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_THAT(run.output, AllOf(StartsWith("carlo: "), HasSubstr(what), ContainsRegex("need [0-9.e+]+ GiB of memory"),
                                  HasSubstr(remedy), EndsWith(" sets another limit\n")))
        << arguments;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
  }

  // The need that a command states under a limit below it [bytes].
  double stated(const std::string& arguments) const {
    const ProcessResult run = run_within(48, arguments);
    std::smatch match;
    EXPECT_TRUE(std::regex_search(run.output, match, std::regex("need ([0-9.e+-]+) GiB"))) << run.output;
    return match.empty() ? 0 : std::stod(match[1]) * 0x1p30;
  }

  // The largest resident memory of a command [bytes].
  double peak(const std::string& arguments) const {
    const std::string command = "cd '" + folder.string() + "' && exec '" CARLO_PATH "' " + arguments;
    const pid_t child = fork();
    if (child == 0) {
      const int null = open("/dev/null", O_WRONLY);
      dup2(null, STDOUT_FILENO);
      dup2(null, STDERR_FILENO);
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    int status = -1;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) <= 1) << arguments;
    return 1024.0 * double(usage.ru_maxrss);
  }

  void expect_peak_as_stated(const std::string& arguments) const {
    const double need = stated(arguments), taken = peak(arguments);
    EXPECT_GE(taken, 0.8 * need) << arguments;
    EXPECT_LE(taken, 1.25 * need) << arguments;
  }
};

TEST_F(MemoryOfCommands, HugePictures_AreRefused) {
  expect_refused(1000, "render " + cbox + " --size 40000x40000", "render: 40000x40000 pixels need ",
                 "; a smaller --size or --crop needs less; --memory sets");
  expect_refused(1000, "render " + cbox + " --compare-strategies --size 4000x4000 -o a.png", "4000x4000 pixels",
                 "--memory sets");
  expect_refused(120, "gallery cbox smallpt --spp 1 -o g", "smallpt: 1024x768 pixels", "a smaller --scale needs less");
  for (const std::string command : {"converge ", "trade "})
    expect_refused(1000, command + cbox + " --size 9000x9000 -o c", "pictures of 9000x9000 pixels",
                   "a smaller --size or fewer methods need less; ulimit -v sets");
  EXPECT_FALSE(std::filesystem::exists(folder / "g" / "cbox.exr")); // the first scene fits
}

TEST_F(MemoryOfCommands, HugeMeasurements_AreRefused) {
  expect_refused(1000, "converge books --all --max-n 268435456 --replicates 100000 -o c",
                 "converge: the replicates of 14 methods and ", "fewer --replicates need less");
  expect_refused(1000, "validate --all --threads 400 --samples 1e9", "validate: 400 cases at a time",
                 "fewer --threads need less");
  expect_refused(300, "integrate \"a*x\" -d x=0:1 --set a=1:400:1 --max-calls 1e9", "1 dimensions and 400 outputs",
                 "the method plain needs less");
}

// The stages of a render double. A part is refused before the one that does not fit, and what it has goes on.
TEST_F(MemoryOfCommands, PartOfManyLightPaths_EndsBeforeAStageThatDoesNotFit) {
  const std::string part =
      "render '" MC_SOURCE_DIR "/librender/scenes/book3-cornell-glass.xml' --size 32x32 --spp 65536 "
      "--adaptive off --strategy mis+lt --part 1/2 -o p.ckpt";
  expect_refused(60, part, "the results of part 1/2 need ", "more parts need less each");
  const auto size = std::filesystem::file_size(folder / "p.ckpt");
  EXPECT_GT(size, 1'000'000u);
  expect_refused(60, part, "the results of part 1/2 need ", "more parts need less each");
  EXPECT_GE(std::filesystem::file_size(folder / "p.ckpt"), size);
}

TEST_F(MemoryOfCommands, HugeFiles_AreRefused) {
  for (const std::string name : {"a.csv", "a.ckpt", "a.ply"}) {
    write(name, "");
    std::filesystem::resize_file(path(name), std::uintmax_t{1} << 40);
  }
  for (const std::string& arguments :
       std::vector<std::string>{"points --points-file a.csv", "validate --samples-file a.csv --pdf 1 --domain x=0:1",
                                "merge a.ckpt", "converge x -d x=0:1 --points-file a.csv",
                                "integrate x -d x=0:1 --load-density a.csv", "render " + cbox + " --resume a.ckpt"})
    expect_refused(1000, arguments, "its bytes", "");
}

TEST_F(MemoryOfCommands, PeakOfPictures_IsAsStated) {
  const std::string render = "render " + cbox + " --size 1024x1024 --spp 2 --max-depth 1 -o a.exr";
  expect_peak_as_stated(render);
  expect_peak_as_stated(render + " --splat on");
  expect_peak_as_stated(render + " --checkpoint a.ckpt");
  expect_peak_as_stated("render " + cbox + " --size 1024x1024 --spp 18 --max-depth 1 -o a.exr"); // plans its samples
}

TEST_F(MemoryOfCommands, PeakOfMeasurements_IsAsStated) {
  expect_peak_as_stated("validate UniformSphere --scalar double --samples 1e7");
  std::string sum = "0", domain;
  for (int i = 0; i < 40; ++i) {
    sum += "+x" + std::to_string(i);
    domain += (i > 0 ? ",x" : "x") + std::to_string(i) + "=0:1";
  }
  expect_peak_as_stated("integrate \"exp(-(" + sum + ")^2/30)\" -d " + domain +
                        " --method vegas --rel-error 0 --abs-error 1e-99 --max-calls 2e6");
}

// The record of points contains one value for each wanted output, and none for a bin.
TEST_F(MemoryOfCommands, BinsOfHistogram_TakeNoRecord) {
  EXPECT_LE(peak("integrate \"exp(-x)+y\" -d x=0:1,y=0:1 --histogram x=1000 --rel-error 0 --abs-error 1e-99 "
                 "--max-calls 1e5"),
            0x1p29);
}

} // namespace
