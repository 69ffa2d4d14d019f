// carlo gallery, run on the command line.

#include <gallery/scenes.h>
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
    const support::ProcessResult run = run_carlo(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments << "\n" << run.output;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
    for (const std::string& word : words) EXPECT_THAT(run.output, HasSubstr(word)) << arguments;
    EXPECT_FALSE(fs::exists(folder / "out")) << arguments;
  }
};

TEST_F(GalleryCommand, RendersNamedScenes) {
  const support::ProcessResult run =
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
  EXPECT_THAT(page, HasSubstr("Compare strategies"));
  EXPECT_THAT(page, Not(HasSubstr("Interrupted")));
}

TEST_F(GalleryCommand, BadInput_IsReportedInOneLineBeforeTheWork) {
  const std::string to = " -o " + path("out");
  expect_refused("gallery book1-metl" + to, {"'book1-metl'", "did you mean 'book1-metal'"});
  expect_refused("gallery book1-metal --scale 0" + to, {"--scale 0"});
  expect_refused("gallery book1-metal --list", {"--list and --table show all scenes; leave out 'book1-metal'"});
  expect_refused("gallery book1-metal --scale nan" + to, {"--scale nan"});
  expect_refused("gallery book1-metal --spp 0" + to, {"--spp 0"});
  expect_refused("gallery book1-metal --time -1" + to, {"> 0"});
  expect_refused("gallery book1-metal --threads -1" + to, {"--threads -1"});
  const std::string taken = write("taken", "mine");
  expect_refused("gallery book1-metal --scale 0.1 --spp 2 -o " + taken, {taken});
  EXPECT_EQ(mc::read_file(taken), "mine");
}

TEST_F(GalleryCommand, ListPrintsEveryScene) {
  const support::ProcessResult run = run_carlo("gallery --list");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, HasSubstr("book1-metal "));
  EXPECT_THAT(run.output, HasSubstr("smallpt"));
}

// An interrupted scene leaves no partial files.
TEST_F(GalleryCommand, CtrlCAndSigterm_LeaveNoPartialPicture) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}}) {
    const support::ProcessResult run =
        support::interrupt_carlo("gallery book1-metal --spp 100000000 --scale 0.1 -o " + path("out"), "\033[K", signal);
    EXPECT_EQ(run.exit_code, code) << run.output;
    EXPECT_THAT(run.output, HasSubstr("interrupted: 0 of 1 scenes were finished"));
    EXPECT_FALSE(fs::exists(folder / "out" / "book1-metal.exr"));
  }
}

// A scene named twice is rendered once; the page would otherwise have two parts with one name.
TEST_F(GalleryCommand, RendersEachSceneOnce) {
  const support::ProcessResult run =
      run_carlo("gallery book1-sky book1-gradient book1-sky --scale 0.05 --spp 1 -o " + path("out"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto times = [](const std::string& text, const std::string& word) {
    int n = 0;
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++n;
    return n;
  };
  EXPECT_EQ(times(run.output, "samples/pixel in"), 2) << run.output;
  EXPECT_EQ(times(run.output, "book1-sky "), 1) << run.output;
  const std::string page = mc::read_file(path("out/index.html"));
  for (const char* scene : {"book1-sky", "book1-gradient"})
    EXPECT_EQ(times(page, fmt::format("id=\"{}\"", scene)), 1) << scene;
}

// All scenes, interrupted after the first one, which finishes immediately. The page states how many are finished.
TEST_F(GalleryCommand, CtrlC_KeepsFinishedPictures) {
  const support::ProcessResult run =
      support::interrupt_carlo("gallery --spp 256 --scale 0.1 -o " + path("out"), "samples/pixel in");
  EXPECT_EQ(run.exit_code, 130) << run.output;
  const auto scenes = carlo::gallery();
  int finished = 0;
  const std::size_t at = run.output.find("interrupted: ");
  ASSERT_NE(at, std::string::npos) << run.output;
  ASSERT_EQ(std::sscanf(run.output.c_str() + at, "interrupted: %d of ", &finished), 1) << run.output;
  ASSERT_GT(finished, 0);
  const std::string of = fmt::format("{} of {} scenes", finished, scenes.size());
  EXPECT_THAT(run.output, HasSubstr("interrupted: " + of));
  EXPECT_THAT(mc::read_file(path("out/index.html")), HasSubstr("Interrupted: " + of));
  EXPECT_EQ(render::read_image(path(fmt::format("out/{}.exr", scenes[0].name))).width, 20);
  EXPECT_FALSE(fs::exists(path(fmt::format("out/{}.exr", scenes.back().name))));
}

// Both commands render the same scene with the same strategy and samples.
TEST_F(GalleryCommand, RenderAcceptsASceneName) {
  const std::string name = "book3-cornell-glass-guided";
  ASSERT_EQ(run_carlo("gallery " + name + " --scale 0.04 --spp 8 --seed 3 -o " + path("out")).exit_code, 0);
  const support::ProcessResult run =
      run_carlo("render " + name + " --size 24x24 --spp 8 --seed 3 -o " + path("one.exr"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const render::Image a = render::read_image(path("one.exr")), b = render::read_image(path("out/" + name + ".exr"));
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i) EXPECT_TRUE((a.pixels[i] == b.pixels[i]).all()) << i;
  const std::string go_on = "render " + name + " --size 24x24 --spp 8 --resume -o " + path("out/" + name + ".exr");
  EXPECT_THAT(run_carlo(go_on).output, HasSubstr("16 samples per pixel of 2 runs"));
  fs::remove_all(folder / "out");
  expect_refused("render cbx -o " + path("c.exr"), {"'cbx'", "did you mean 'cbox'"});
}

} // namespace
