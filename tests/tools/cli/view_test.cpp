#include <tools/run_carlo.h>

#include <render/io/image/image_io.h>

#include <mc/core/file.h>

#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using support::run_carlo;
using testing::HasSubstr, testing::Not;

struct ViewCommand : support::ScratchTest {
  void SetUp() override {
    ScratchTest::SetUp();
    render::Image image(8, 6);
    for (int i = 0; i < 48; ++i) image.pixels[static_cast<std::size_t>(i)].setConstant(render::Float(i));
    for (const char* name : {"a.exr", "b.pfm"}) render::write_image(path(name), image);
  }
  support::ProcessResult view(const std::string& arguments) { return run_carlo("view " + arguments); }
};

TEST_F(ViewCommand, WritesOnePageOfOneOrTwoPictures) {
  const std::string page = path("page.html"), a = path("a.exr"), b = path("b.pfm");
  EXPECT_THAT(view(a + " -o " + page).output, HasSubstr(page + ": open it in a browser"));
  EXPECT_THAT(mc::read_file(page), AllOf(HasSubstr("\"width\":8"), HasSubstr("\"half_width\":null")));
  ASSERT_EQ(view(a + " " + b + " --exposure -2 --crop 2,1,3,4 -o " + page).exit_code, 0);
  EXPECT_THAT(mc::read_file(page), AllOf(HasSubstr("\"width\":3"), HasSubstr("\"height\":4"), HasSubstr("\"x\":2"),
                                         HasSubstr("\"exposure\":-2.0"), HasSubstr("\"name\":\"b.pfm\"")));
}

TEST_F(ViewCommand, ResultsOfValidate_AreTheirPage) {
  ASSERT_EQ(run_carlo("validate Linear --samples 1000 --json " + path("r.json")).exit_code, 0);
  ASSERT_EQ(view(path("r.json") + " -o " + path("r.html")).exit_code, 0);
  EXPECT_THAT(mc::read_file(path("r.html")), HasSubstr("\"name\":\"Linear\""));
}

TEST_F(ViewCommand, BadInput_IsOneLine) {
  write("list.json", "[1]");
  write("bad.json", "{");
  render::write_image(path("small.pfm"), render::Image(2, 2));
  const std::string a = path("a.exr");
  for (const auto& [arguments, text] : std::vector<std::pair<std::string, std::string>>{
           {path("none.exr"), "none.exr"},
           {a + " " + path("small.pfm"), "two pictures of a page have the same size"},
           {a + " --crop 6,0,3,3", "must lie within the 8x6 pixels"},
           {a + " --exposure 20", "--exposure 20 must lie in [-10, 10] stops"},
           {path("list.json"), "has no results of carlo validate --json"},
           {path("bad.json"), "is no JSON"},
           {path("list.json") + " --crop 0,0,1,1", "have no --crop"},
           {a + " -o " + a, "name another file"}}) {
    const support::ProcessResult r =
        view(arguments + (arguments.find(" -o ") == std::string::npos ? " -o " + path("p.html") : ""));
    EXPECT_EQ(r.exit_code, 2) << arguments;
    EXPECT_THAT(r.output, HasSubstr(text)) << arguments;
    EXPECT_EQ(std::count(r.output.begin(), r.output.end(), '\n'), 1) << r.output;
  }
  EXPECT_FALSE(std::filesystem::exists(path("p.html")));
}

// The page is written while the render runs, and once more at its end.
TEST_F(ViewCommand, ReportOfARender_IsItsPage) {
  ASSERT_EQ(run_carlo("render cbox --size 16x12 --spp 8 --report " + path("page") + " -o " + path("c.exr")).exit_code,
            0);
  EXPECT_THAT(mc::read_file(path("page/index.html")),
              AllOf(HasSubstr("8 samples per pixel"), HasSubstr("\"height\":12"), Not(HasSubstr("http-equiv"))));
}

} // namespace
