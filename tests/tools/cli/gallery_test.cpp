// carlo gallery, run as a user runs it.

#include <tools/interrupt_carlo.h>

#include <render/io/image/image_io.h>

#include <support/files.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

#include <algorithm>

namespace {

namespace fs = std::filesystem;
using support::run_carlo;
using testing::HasSubstr, testing::Not;

struct GalleryCommand : support::ScratchTest {
  void expect_refused(const std::string& arguments, const std::vector<std::string>& words) const {
    const support::Run run = run_carlo(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.output;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
    for (const std::string& word : words) EXPECT_THAT(run.output, HasSubstr(word)) << arguments;
    EXPECT_FALSE(fs::exists(folder / "out")) << arguments;
  }
};

TEST_F(GalleryCommand, RendersWhatIsNamed) {
  const support::Run run =
      run_carlo("gallery book1-metal book3-cornell-glass-guided --scale 0.05 --spp 8 -o " + path("out"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const render::Image image = render::read_image(path("out/book3-cornell-glass-guided.exr"));
  EXPECT_EQ(image.width, 30);
  EXPECT_EQ(image.metadata.at("carlo.samples_per_pixel"), "8");
  EXPECT_FALSE(image.variance.empty());
  for (const char* file : {"book1-metal.exr", "book1-metal.png", "sheet.png"})
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
  const std::string page = mc::read_file(path("out/index.html"));
  EXPECT_THAT(page, HasSubstr("book3-cornell-glass-guided.png"));
  EXPECT_THAT(page, HasSubstr("Strategies compared"));
  EXPECT_THAT(page, Not(HasSubstr("Interrupted")));
}

TEST_F(GalleryCommand, RefusesBadInputInOneLineBeforeTheWork) {
  const std::string to = " -o " + path("out");
  expect_refused("gallery book1-metl" + to, {"'book1-metl'", "did you mean 'book1-metal'"});
  expect_refused("gallery book1-metal --scale 0" + to, {"--scale 0"});
  expect_refused("gallery book1-metal --list", {"a list is of all scenes; leave out 'book1-metal'"});
  expect_refused("gallery book1-metal --scale nan" + to, {"--scale nan"});
  expect_refused("gallery book1-metal --spp 0" + to, {"--spp 0"});
  expect_refused("gallery book1-metal --time -1" + to, {"> 0"});
  expect_refused("gallery book1-metal --threads -1" + to, {"--threads -1"});
  const std::string taken = write("taken", "mine");
  expect_refused("gallery book1-metal --scale 0.1 --spp 2 -o " + taken, {taken});
  EXPECT_EQ(mc::read_file(taken), "mine");
}

TEST_F(GalleryCommand, ListsItsScenes) {
  const support::Run run = run_carlo("gallery --list");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, HasSubstr("book1-metal "));
  EXPECT_THAT(run.output, HasSubstr("smallpt"));
}

// A scene that never ends leaves nothing half done.
TEST_F(GalleryCommand, CtrlCLeavesNothingHalfDone) {
  const support::Run run =
      support::interrupt_carlo("gallery book1-metal --spp 100000000 --scale 0.1 -o " + path("out"));
  EXPECT_EQ(run.exit_code, 130) << run.output;
  EXPECT_THAT(run.output, HasSubstr("interrupted: 0 of 1 scenes were finished"));
  EXPECT_FALSE(fs::exists(folder / "out" / "book1-metal.exr"));
}

// One quick scene again and again: after the first, some of them are done, and the page says how many.
TEST_F(GalleryCommand, CtrlCKeepsWhatIsFinished) {
  std::string names;
  for (int i = 0; i < 400; ++i) names += " book1-metal";
  const support::Run run =
      support::interrupt_carlo("gallery" + names + " --spp 8 --scale 0.1 -o " + path("out"), "samples/pixel in");
  EXPECT_EQ(run.exit_code, 130) << run.output;
  int finished = 0;
  const std::size_t at = run.output.find("interrupted: ");
  ASSERT_NE(at, std::string::npos) << run.output;
  ASSERT_EQ(std::sscanf(run.output.c_str() + at, "interrupted: %d of 400", &finished), 1) << run.output;
  ASSERT_GT(finished, 0);
  EXPECT_THAT(mc::read_file(path("out/index.html")), HasSubstr(fmt::format("Interrupted: {} of 400", finished)));
  EXPECT_EQ(render::read_image(path("out/book1-metal.exr")).width, 20);
}

// The same scene, strategy and samples by either command.
TEST_F(GalleryCommand, RenderTakesANameToo) {
  const std::string name = "book3-cornell-glass-guided";
  ASSERT_EQ(run_carlo("gallery " + name + " --scale 0.04 --spp 8 --seed 3 -o " + path("out")).exit_code, 0);
  const support::Run run = run_carlo("render " + name + " --size 24x24 --spp 8 --seed 3 -o " + path("one.exr"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const render::Image a = render::read_image(path("one.exr")), b = render::read_image(path("out/" + name + ".exr"));
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i) EXPECT_TRUE((a.pixels[i] == b.pixels[i]).all()) << i;
  const std::string go_on = "render " + name + " --size 24x24 --spp 8 --resume -o " + path("out/" + name + ".exr");
  EXPECT_THAT(run_carlo(go_on).output, HasSubstr("16 samples/pixel of 2 runs"));
  fs::remove_all(folder / "out");
  expect_refused("render cbx -o " + path("c.exr"), {"'cbx'", "did you mean 'cbox'"});
}

} // namespace
