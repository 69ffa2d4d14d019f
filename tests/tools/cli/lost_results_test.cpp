// Results that an interrupt, a signal, a full disk or a wrong name must not destroy.

#include <terminal/file_lock.h>
#include <tools/interrupt_carlo.h>

#include <render/io/image/image_io.h>

#include <mc/core/file.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <regex>

namespace {

namespace fs = std::filesystem;

using support::ProcessResult;
using support::run_carlo;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct LostResults : support::ScratchTest {
  const std::string endless = "render cbox --spp 100000000 --size 64x64 -o ";

  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {})); }
  void expect_refusal(const std::string& arguments, const std::string& words) const {
    const ProcessResult run = support::run("cd '" + folder.string() + "' && '" CARLO_PATH "' " + arguments);
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_THAT(run.output, HasSubstr(words));
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
  }
};

// The picture is complete, or has more samples. It is replaced only by a better partial one.
TEST_F(LostResults, InterruptedRender_KeepsABetterPicture) {
  const std::string a = path("a.exr"), beside = path("a.partial.exr");
  ASSERT_EQ(run_carlo("render cbox --spp 2 --size 64x64 -o " + a).exit_code, 0);
  const std::string complete = mc::read_file(a);
  const ProcessResult run = support::interrupt_carlo(endless + a + " --intervals " + path("i.pfm"), "  error ");
  EXPECT_EQ(run.exit_code, 130) << run.output;
  EXPECT_THAT(run.output, HasSubstr("'" + a + "' stays as it was; this partial result is '" + beside + "'"));
  EXPECT_EQ(mc::read_file(a), complete);
  EXPECT_TRUE(render::read_image(beside).metadata.contains("carlo.partial"));
  EXPECT_TRUE(fs::exists(path("i.pfm"))) << "nothing was there";
  write("i.pfm", "complete");
  support::interrupt_carlo(endless + path("new.exr") + " --intervals " + path("i.pfm"), "  error ");
  EXPECT_TRUE(fs::exists(path("new.exr")) && fs::exists(path("i.partial.pfm")));
  EXPECT_EQ(mc::read_file(path("i.pfm")), "complete");

  render::Image better = render::read_image(beside);
  better.metadata["carlo.samples_per_pixel"] = "1e9";
  render::write_image(beside, better);
  const ProcessResult lesser = support::interrupt_carlo(endless + a, "  error ");
  EXPECT_THAT(lesser.output, HasSubstr("a.partial.exr' has more samples; nothing was written"));
  EXPECT_EQ(render::read_image(beside).metadata.at("carlo.samples_per_pixel"), "1e9");

  better.metadata["carlo.samples_per_pixel"] = "1e-9";
  render::write_image(a, better);
  EXPECT_THAT(support::interrupt_carlo(endless + a, "  error ").output, Not(HasSubstr("stays as it was")));
  EXPECT_NE(render::read_image(a).metadata.at("carlo.samples_per_pixel"), "1e-9");
}

TEST_F(LostResults, InterruptedFolderCommands_KeepCompleteFiles) {
  for (const std::string name : {"slopes.csv", "pi.csv", "index.html"}) write(name, "complete");
  const ProcessResult curves = support::interrupt_carlo("converge pi --all --max-n 1e8 --threads 1 --report '" +
                                                        folder.string() + "' -o '" + folder.string() + "'");
  EXPECT_EQ(curves.exit_code, 130) << curves.output;
  for (const std::string name : {"slopes.csv", "pi.csv", "index.html"}) {
    EXPECT_EQ(mc::read_file(path(name)), "complete") << curves.output;
    EXPECT_NE(mc::read_file(path("partial/" + name)), "complete");
  }
  write("index.html", "complete");
  const ProcessResult pictures = support::interrupt_carlo(
      "gallery cbox book3-cornell-glass --spp 100000 --scale 0.1 -o '" + folder.string() + "'", "1 of 2");
  EXPECT_EQ(pictures.exit_code, 130) << pictures.output;
  EXPECT_EQ(mc::read_file(path("index.html")), "complete");
  write("v.json", "complete");
  support::interrupt_carlo("validate --all --threads 1 --samples 400000 --json " + path("v.json"));
  EXPECT_EQ(mc::read_file(path("v.json")), "complete");
  EXPECT_THAT(mc::read_file(path("v.partial.json")), HasSubstr("\"interrupted\": true"));
}

TEST_F(LostResults, SignalsOfBatchQueuesAndTerminals_WriteThePicture) {
  for (const int signal : {SIGHUP, SIGUSR1, SIGXCPU}) {
    const std::string output = path(fmt::format("{}.exr", signal));
    const ProcessResult run = support::interrupt_carlo(endless + output, "  error ", signal);
    EXPECT_EQ(run.exit_code, 128 + signal) << run.output;
    EXPECT_TRUE(render::read_image(output).metadata.contains("carlo.partial"));
  }
  const std::string command = "trap '' HUP; '" CARLO_PATH "' integrate pi --rel-error 1e-30 --max-calls 1e8 & "
                              "sleep 0.3; kill -HUP $!; wait $!";
  const ProcessResult ignored = support::run(command);
  EXPECT_EQ(ignored.exit_code, 1) << "as under nohup";
  EXPECT_THAT(ignored.output, AllOf(HasSubstr("stopped: "), Not(HasSubstr("stopped: interrupted"))));
}

// In the foreground, timeout sends the signal once; a second one would end carlo without a message.
TEST_F(LostResults, CtrlCWhileAPluginLoads_EndsWith130) {
  const std::string command = "timeout --foreground --preserve-status -s INT 1 '" CARLO_PATH
                              "' validate --plugin '" PLUGIN_DIR "/hang_on_load.so' 2>&1";
  const ProcessResult run = support::run(command);
  EXPECT_EQ(run.exit_code, 130) << run.output;
  EXPECT_THAT(run.output, HasSubstr("interrupted before anything was checked"));
}

TEST_F(LostResults, InterruptedIntegral_EndsWith130) {
  const ProcessResult run = support::interrupt_carlo(
      "integrate pi --method rqmc --rel-error 1e-30 --max-calls 1e15 --save-density " + path("d.json"));
  EXPECT_EQ(run.exit_code, 130) << run.output;
}

TEST_F(LostResults, KnownBugs_EndWithinABug) {
  const ProcessResult run = support::interrupt_carlo("known-bugs P1 --samples 1e9", "corrected");
  EXPECT_EQ(run.exit_code, 130) << run.output;
  EXPECT_THAT(run.output, HasSubstr("interrupted: 0 of 1 bugs")) << "a bug takes a minute";
}

// A limit of the file size fails every write, as a full disk does.
TEST_F(LostResults, LimitOfTheFileSize_IsAnErrorAndKeepsTheOldPicture) {
  const std::string a = path("a.exr");
  ASSERT_EQ(run_carlo("render cbox --spp 1 --size 64x64 -o " + a).exit_code, 0);
  const std::string before = mc::read_file(a);
  const ProcessResult run =
      support::run("ulimit -f 8; '" CARLO_PATH "' render cbox --spp 2 --size 64x64 -o " + a + " 2>&1");
  EXPECT_EQ(run.exit_code, 2) << run.output;
  EXPECT_THAT(run.output, HasSubstr("carlo: cannot write '" + a + "': File too large\n"));
  EXPECT_EQ(mc::read_file(a), before);
  EXPECT_EQ(files(), 1u);
}

TEST_F(LostResults, FolderThatVanishes_PictureIsSavedElsewhere) {
  fs::create_directories(path("out"));
  const ProcessResult run =
      support::run("(cd '" + folder.string() +
                   "'; export TMPDIR=$PWD; '" CARLO_PATH
                   "' render cbox --time 6 --size 32x32 -o out/a.exr & sleep 3; rm -r out; wait $!)");
  EXPECT_EQ(run.exit_code, 2) << run.output;
  std::smatch place;
  ASSERT_TRUE(std::regex_search(run.output, place, std::regex("the result is in '(.*)'"))) << run.output;
  EXPECT_EQ(render::read_image(place[1]).width, 32);
}

// Kills runs at moments from their start to their end.
TEST_F(LostResults, KilledRuns_LeaveAWholePicture) {
  const std::string a = path("a.exr"), line = "'" CARLO_PATH "' render cbox --size 64x64 --spp 2 --layers -o " + a;
  ASSERT_EQ(support::run(line).exit_code, 0);
  int killed = 0;
  for (int k = 0; k < 60; ++k) {
    const ProcessResult run = support::run(fmt::format("timeout -s KILL {:.4f} {} --resume", 0.003 * k, line));
    killed += run.exit_code == 137;
    const render::Image picture = render::read_image(a);
    ASSERT_EQ(picture.width, 64);
    ASSERT_FALSE(picture.variance.empty());
  }
  EXPECT_GE(killed, 3);
}

TEST_F(LostResults, SecondResumeOfAPicture_IsRefused) {
  const std::string a = path("a.exr"), resume = "render cbox --spp 2 --size 32x32 --resume -o " + a;
  ASSERT_EQ(run_carlo("render cbox --spp 2 --size 32x32 -o " + a).exit_code, 0);
  {
    const carlo::FileLock first(a);
    expect_refusal(resume, "another run is working on '" + a + "'; wait for its end");
  }
  EXPECT_EQ(run_carlo(resume).exit_code, 0);
}

TEST_F(LostResults, UnwritableOutput_IsRefusedBeforeTheWork) {
  const std::string work = "render cbox --spp 100000000 ";
  expect_refusal(work + "-o /proc/a.exr", "cannot write '/proc/a.exr'");
  fs::create_directories(path("folder.exr"));
  expect_refusal(work + "-o folder.exr", "cannot write 'folder.exr': it is a folder; name a file in it");
  const std::string long_name = std::string(252, 'a') + ".exr";
  expect_refusal(work + "-o " + long_name, "File name too long");
  expect_refusal(work + "-o a.exr --intervals /proc/i.exr", "cannot write '/proc/i.exr'");
  fs::create_symlink("loop.exr", path("loop.exr"));
  expect_refusal(work + "-o loop.exr", "its links lead in a circle");
}

TEST_F(LostResults, OutputsOverInputs_AreRefused) {
  write("s.csv", "0.1\n0.2\n");
  expect_refusal("validate --samples-file s.csv --pdf 1 --json s.csv", "--json would write 's.csv' over the file of");
  expect_refusal("validate --all --json q --junit ./q", "--json and --junit would both write 'q'");
  write("d.json", "{}");
  expect_refusal("integrate pi --load-density d.json --json d.json", "over the file of --load-density");
  expect_refusal("integrate pi --save-density d --json ./d", "would both write");
  write("g.so", "");
  expect_refusal("validate --plugin g.so --json g.so", "over the file of --plugin");
  write("points.csv", "0.1,0.2\n");
  expect_refusal("points -o . --points-file points.csv", "over the file of --points-file");
  std::string points;
  for (int i = 0; i < 64; ++i) points += fmt::format("{},{}\n", i / 64.0, i / 64.0);
  write("pi.csv", points);
  expect_refusal("converge pi -o . --points-file pi.csv", "-o would write './pi.csv' over the file of --points-file");
  expect_refusal("compare s.csv d.json --diff s.csv", "over A");
  EXPECT_EQ(mc::read_file(path("pi.csv")), points);
}

} // namespace
