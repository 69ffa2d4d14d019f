#include <picture/render_report.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <support/files.h>

#include <gmock/gmock.h>

namespace {

using testing::HasSubstr, testing::Not;

using RenderReportTest = support::ScratchTest;

render::Image grey() {
  render::Image image(3, 2);
  for (auto& p : image.pixels) p.setConstant(render::Float(0.5));
  return image;
}

TEST_F(RenderReportTest, KeepsAPageUntilTheEnd) {
  carlo::RenderReport report(path("page"), "a.xml", "carlo render a.xml", {7, 8, 3, 2});
  int images = 0;
  const auto image = [&images] {
    ++images;
    return grey();
  };
  report.show({0.25, 1000, 5000, 30, {0.02, 0.03}, image});
  const std::string page = mc::read_file(path("page/index.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("25 % in 30.0 s, about 1 min 30 s remain"), HasSubstr("[[30.0,0.02]]"),
                          HasSubstr("http-equiv=\"refresh\""), HasSubstr("\"x\":7")));
  report.show({0.5, 2000, 10000, 60, {0.01, 0.02}, image});
  EXPECT_EQ(images, 1) << "within two seconds";
  render::RenderResult result;
  result.image = grey();
  result.seconds = 120;
  result.spp = 64;
  result.relative_error = 0.005;
  report.finish(result);
  EXPECT_THAT(mc::read_file(path("page/index.html")),
              AllOf(HasSubstr("done in 2 min 00 s: 64 samples per pixel"), HasSubstr("[[30.0,0.02],[120.0,0.005]]"),
                    Not(HasSubstr("http-equiv"))));
}

TEST_F(RenderReportTest, FolderThatIsAFile_IsRefused) {
  write("page", "");
  EXPECT_THROW(carlo::RenderReport(path("page"), "a", "b", {}), mc::Error);
}

} // namespace
