// The page of tools/demo.sh, written from the output of its steps.

#include <support/files.h>
#include <tools/browser.h>
#include <tools/run_carlo.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

namespace {

using testing::AllOf, testing::HasSubstr, testing::Not;

struct DemoPage : support::ScratchTest {
  void SetUp() override {
    ScratchTest::SetUp();
    for (const char* step : {"cbox", "glass", "validate", "converge"}) {
      write(std::string(step) + ".command", "carlo " + std::string(step) + " --spp '1 & 2'\n");
      write(std::string(step) + ".txt",
            "left out\n1\n2\n" + std::string(step) + " error < 3 %\npage: out/index.html\n");
      write(std::string(step) + ".exit", "0\n");
    }
  }
  std::string page() const {
    const auto made = support::run(std::string("'" MC_SOURCE_DIR "/tools/demo_page.sh' '") + folder.string() +
                                   "' 'carlo 1.2.3 (a & b)'");
    EXPECT_EQ(made.exit_code, 0) << made.output;
    return mc::read_file(path("index.html"));
  }
};

TEST_F(DemoPage, ShowsTheOutputOfEachStep) {
  const std::string text = page();
  EXPECT_THAT(text, AllOf(HasSubstr("<h1 class=\"pass\">All four steps passed</h1>"), HasSubstr("carlo 1.2.3 (a & b)"),
                          HasSubstr("<b>$ carlo cbox --spp '1 &amp; 2'</b>\n1\n2\ncbox error &lt; 3 %</p>"),
                          HasSubstr("\nglass error &lt; 3 %</p>"), HasSubstr("</b>\nvalidate error &lt; 3 %</p>"),
                          HasSubstr("\nconverge error &lt; 3 %</p>")));
  EXPECT_THAT(text,
              AllOf(Not(HasSubstr("page: out")), HasSubstr("prefers-color-scheme: dark"), Not(HasSubstr("<pre"))));
  EXPECT_THAT(text, Not(testing::ContainsRegex("@[A-Za-z.]+@"))) << "a mark of the template is left";
  for (const char* loaded : {"http", "<script", "@import", "url("}) EXPECT_THAT(text, Not(HasSubstr(loaded)));
}

TEST_F(DemoPage, FailedStep_IsNamedWithItsExitCode) {
  write("validate.exit", "1\n");
  EXPECT_THAT(page(), AllOf(HasSubstr("<h1 class=\"fail\">1 of four steps failed</h1>"),
                            HasSubstr("<p class=\"status failed\">failed with exit code 1</p>"),
                            HasSubstr("<p class=\"status\">passed</p>")));
}

TEST_F(DemoPage, FitsAPhone) {
  write("cbox.command", std::string(300, 'x'));
  page();
  support::expect_fits_a_phone(path("index.html"));
}

} // namespace
