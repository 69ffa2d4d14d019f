// gnuplot pictures are written completely or not at all, and other files in the folder stay unchanged.

#include <report/plot.h>

#include <tools/run_carlo.h>

#include <mc/core/file.h>

#include <support/files.h>

#include <cstdlib>

namespace {

using testing::AllOf;
using testing::HasSubstr;

struct Plot : support::ScratchTest {
  void SetUp() override {
    ScratchTest::SetUp();
    path_ = std::getenv("PATH");
    write("a.csv", "n,error\n1,1\n2,0.5\n4,0.25\n");
    write("a.gp", carlo::plot_header("a", 300, 200) + "plot \"a.csv\" skip 1 using 1:2 with lines\n");
  }
  void TearDown() override {
    setenv("PATH", path_.c_str(), 1);
    ScratchTest::TearDown();
  }
  // Puts a program named gnuplot first in PATH.
  void put_for_gnuplot(const std::string& script) const {
    std::filesystem::create_directory(folder / "programs");
    std::filesystem::permissions(write("programs/gnuplot", "#!/bin/sh\n" + script), std::filesystem::perms::owner_all);
    setenv("PATH", (path("programs") + ":" + path_).c_str(), 1);
  }
  bool draw() const { return carlo::draw_plot(folder, "a", {"a.csv"}); }
  std::string complaint() const {
    return support::error_of([&] { draw(); });
  }

  std::string path_;
};

TEST_F(Plot, ReplacesOnlyItsOwnFiles) {
  if (!support::has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  write("target", "mine");
  std::filesystem::create_symlink(path("target"), path("a.log"));
  ASSERT_TRUE(draw());
  EXPECT_THAT(mc::read_file(path("a.svg")), HasSubstr("</svg>"));
  EXPECT_THAT(mc::read_file(path("a.png")), HasSubstr("IEND"));
  EXPECT_TRUE(std::filesystem::is_symlink(path("a.log")));
  EXPECT_EQ(mc::read_file(path("target")), "mine");
}

TEST_F(Plot, ScriptRunsByHand) {
  if (!support::has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const support::ProcessResult run =
      support::run("cd '" + folder.string() + "' && gnuplot a.gp && gnuplot -e 'kind=\"png\"' a.gp");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_TRUE(std::filesystem::exists(path("a.svg")) && std::filesystem::exists(path("a.png")));
}

TEST_F(Plot, FullDisk_IsAnError) {
  if (!support::has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  std::filesystem::create_symlink("/dev/full", path("a.png"));
  EXPECT_THAT(complaint(), AllOf(HasSubstr("a.png"), HasSubstr("No space left on device")));
  EXPECT_TRUE(std::filesystem::is_symlink(path("a.png")));
}

TEST_F(Plot, PartialPicture_IsAnErrorAndTheOldOneStays) {
  write("a.svg", "old");
  put_for_gnuplot("printf '<svg>' > a.svg\n");
  EXPECT_THAT(complaint(), HasSubstr("gnuplot drew only a part of 'a.svg'"));
  put_for_gnuplot("exit 0\n");
  EXPECT_THAT(complaint(), HasSubstr("gnuplot drew only a part of 'a.svg'"));
  EXPECT_EQ(mc::read_file(path("a.svg")), "old");
}

TEST_F(Plot, GnuplotErrors_AreReportedInOneLine) {
  put_for_gnuplot("printf 'plot b\\n     ^\\n\"a.gp\" line 7: undefined variable: b\\n\\n' >&2; exit 1\n");
  EXPECT_THAT(complaint(), AllOf(HasSubstr("a.gp': \"a.gp\" line 7: undefined variable: b; run gnuplot a.gp"),
                                 testing::Not(HasSubstr("\n"))));
}

TEST_F(Plot, WithoutGnuplot_NothingIsDrawn) {
  setenv("PATH", path("nothing").c_str(), 1);
  EXPECT_FALSE(draw());
}

} // namespace
