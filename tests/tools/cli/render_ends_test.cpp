// End conditions of carlo render: a target error, a time, or an interrupt.

#include <tools/interrupt_carlo.h>

#include <render/io/image/image_io.h>

#include <mc/core/file.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <regex>

namespace {

using support::run_carlo;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

struct RenderEnds : support::ScratchTest {
  const std::string scenes = MC_SOURCE_DIR "/librender/scenes/";
};

TEST_F(RenderEnds, ReachesTheTargetError) {
  const std::string target = " --target-error 0.1 --size 32x32 -o ";
  for (const std::string more : {"", " --adaptive off", " --error-of worst"}) {
    const support::ProcessResult run =
        run_carlo(fmt::format("render {}cbox.xml{}{}{}", scenes, more, target, path("a.exr")));
    ASSERT_EQ(run.exit_code, 0) << run.output;
    std::smatch errors;
    ASSERT_TRUE(std::regex_search(run.output, errors, std::regex("error ([0-9.]+) % .worst block ([0-9.]+) %")))
        << run.output;
    EXPECT_LE(std::stod(errors[more == " --error-of worst" ? 2 : 1]), 10.0);
  }
}

TEST_F(RenderEnds, StopsAtTimeOrErrorWhicheverComesFirst) {
  const std::string line = "render sphere-light --size 8x6 -o " + path("a.exr"), late = "was not reached in the time";
  const support::ProcessResult by_error = run_carlo(line + " --time 1000 --target-error 0.2");
  EXPECT_EQ(by_error.exit_code, 0) << by_error.output;
  EXPECT_THAT(by_error.output, Not(HasSubstr(late)));
  const support::ProcessResult by_time = run_carlo(line + " --time 0.05 --target-error 1e-9");
  EXPECT_EQ(by_time.exit_code, 0) << by_time.output;
  EXPECT_THAT(by_time.output, HasSubstr("the error of 1e-07 % " + late));
}

// The progress line shows the bound of the error, which the target is compared with.
TEST_F(RenderEnds, ProgressShowsTheBoundOfTheError) {
  const support::ProcessResult run = support::interrupt_carlo(
      "render book3-cornell-glass --size 64x64 --strategy mis --target-error 0.001 -o " + path("a.exr"), "at most");
  EXPECT_EQ(run.exit_code, 130) << run.output;
  EXPECT_THAT(run.output, ContainsRegex("left  error [0-9.]+ %  at most [0-9.]+ %  [0-9.]+ .?samples/s"));
}

// Interrupts the first pass, in which pixels take long.
TEST_F(RenderEnds, IncompletePass_IsNotAdded) {
  const std::string line = "render " + scenes + "cbox.xml --size 2000x2000 --splat off --threads 1 -o " + path("r.exr");
  const support::ProcessResult first = support::interrupt_carlo(line + " --spp 1000000");
  EXPECT_EQ(first.exit_code, 130) << first.output;
  const char* how_far =
      "interrupted in its first pass: [0-9]+ of 2000 rows were rendered, the others repeat the nearest";
  EXPECT_THAT(first.output, ContainsRegex("PARTIAL: interrupted in its first pass: [0-9]+ of 2000 rows were rendered, "
                                          ""
                                          "the[\r\n ]+others[\r\n ]+repeat[\r\n ]+the[\r\n ]+nearest[\r\n]+/"));
  const render::Image early = render::read_image(path("r.exr"));
  EXPECT_EQ(early.metadata.at("carlo.unsampled"), "some pixels");
  EXPECT_THAT(early.metadata.at("carlo.partial"), ContainsRegex(how_far));
  EXPECT_TRUE(early.variance.empty());
  const std::string small = "render " + scenes + "cbox.xml --size 300x300 --threads 1 -o " + path("s.exr");
  ASSERT_EQ(run_carlo(small + " --spp 2").exit_code, 0);
  const std::string before = mc::read_file(path("s.exr"));
  const support::ProcessResult more = support::interrupt_carlo(small + " --spp 1000000 --resume");
  EXPECT_EQ(more.exit_code, 130) << more.output;
  EXPECT_THAT(more.output, HasSubstr("s.exr is unchanged"));
  EXPECT_EQ(mc::read_file(path("s.exr")), before);
}

TEST_F(RenderEnds, CtrlCAndSigterm_WriteAPartialPicture) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}}) {
    const std::string output = path(fmt::format("{}.exr", signal));
    const support::ProcessResult run = support::interrupt_carlo(
        "render " + scenes + "cbox.xml --spp 100000000 --size 16x16 -o " + output, "  error ", signal);
    EXPECT_EQ(run.exit_code, code) << run.output;
    EXPECT_THAT(run.output, HasSubstr("PARTIAL: interrupted before the end\r\n" + output));
    const render::Image image = render::read_image(output);
    EXPECT_TRUE(image.metadata.contains("carlo.partial"));
    EXPECT_FALSE(image.variance.empty());
    EXPECT_GT(image.at(8, 8).sum(), 0);
  }
}

} // namespace
