// The page of pictures: its content, and what mouse and keyboard do in a headless browser.

#include <report/view_page.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <tools/browser.h>

namespace {

using testing::HasSubstr, testing::Not;

// Pixel (x, y) is (x, y, .25) with a standard error of .1 in red; the second picture is .5 redder.
render::Image picture(double red) {
  render::Image image(6, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x) image.at(x, y) = render::Spectrum(render::Float(x + red), render::Float(y), 0.25F);
  image.variance.assign(24, render::Spectrum(0.01F, 0, 0));
  image.estimates = 2;
  image.layers["Z"] = std::vector<float>(24, 7.5F);
  for (const char* axis : {"X", "Y", "Z"}) image.layers[std::string("N.") + axis] = std::vector<float>(24, 0.5F);
  image.metadata["carlo.seed"] = "</script><b>3";
  return image;
}

struct ViewPageTest : support::ScratchTest {
  const render::Image a = picture(0), b = picture(0.5);
  carlo::ViewPage page(bool is_pair) const {
    carlo::ViewPage p{.tool = "carlo view", .title = "a & b", .command = "carlo view", .pictures = {{"a", &a}}};
    if (is_pair) p.pictures.emplace_back("b", &b);
    return p;
  }
  // The value that a script leaves in the title, after the page is drawn.
  std::string after(const std::string& html, const std::string& script, const std::string& hash = {}) {
    std::string text = html;
    const std::string wait = "<script>(async () => { while (!document.body.dataset.ready) await new Promise(r => "
                             "setTimeout(r, 20));\n"
                             "const key = (key, more = {}) => stage.dispatchEvent(new KeyboardEvent('keydown', "
                             "{key, bubbles: true, ...more}));\n"
                             "const stage = document.getElementById('stage'), box = stage.getBoundingClientRect();\n"
                             "const mouse = (type, x, y, more = {}) => stage.dispatchEvent(new (type === 'wheel' ? "
                             "WheelEvent : PointerEvent)(type, {clientX: box.left + x, clientY: box.top + y, "
                             "pointerId: 1, bubbles: true, cancelable: true, ...more}));\n"
                             "stage.setPointerCapture = () => {};\n"
                             "const cells = () => [...document.querySelectorAll('#values tbody td')].map(e => "
                             "e.textContent);\n";
    text.insert(text.rfind("</body>"), wait + "document.title = 'result ' + (" + script + "); })();</script>");
    mc::write_file(path("page.html"), text);
    const std::string dom = support::browse(path("page.html"), hash);
    if (dom.empty()) return {};
    EXPECT_EQ(support::logged(dom), "");
    const std::size_t at = dom.find("<title>result ");
    return at == std::string::npos ? "no result" : dom.substr(at + 14, dom.find("</title>", at) - at - 14);
  }
};

TEST_F(ViewPageTest, NeedsNoNetwork_AndEscapesTexts) {
  const std::string html = to_html(page(true));
  EXPECT_THAT(html, AllOf(HasSubstr("<title>a &amp; b</title>"), HasSubstr("\\u003c/script>\\u003cb>3"),
                          Not(HasSubstr("http-equiv")), Not(HasSubstr("</script><b>")), Not(HasSubstr("src="))));
  EXPECT_THAT(html, Not(testing::ContainsRegex("https?://")));
}

TEST_F(ViewPageTest, RunningRender_LoadsAgain) {
  carlo::ViewPage p = page(false);
  carlo::ViewProgress progress{"half", 0.5, {{1, 0.1}, {2, 0.07}}};
  p.progress = &progress;
  EXPECT_THAT(to_html(p), HasSubstr("http-equiv=\"refresh\" content=\"2\""));
  progress.is_running = false;
  EXPECT_THAT(to_html(p), Not(HasSubstr("http-equiv")));
}

TEST_F(ViewPageTest, PicturesOfOtherSizes_AreRefused) {
  const render::Image other(3, 3);
  carlo::ViewPage p = page(false);
  p.pictures.emplace_back("c", &other);
  EXPECT_THROW(to_html(p), mc::Error);
  p.pictures.clear();
  EXPECT_THROW(to_html(p), mc::Error);
  EXPECT_NO_THROW(carlo::require_viewable("c", other, "cut it"));
}

// Values, and the interval of Student's t with 8 degrees of freedom: 3 +- 2.306 * .1.
TEST_F(ViewPageTest, Keyboard_SelectsPixelsAndChannels) {
  const std::string html = to_html(page(false));
  const std::string values = after(html,
                                   "(key('ArrowLeft'), key('ArrowDown'), key('ArrowUp', {shiftKey: true}), "
                                   "document.getElementById('pixel').textContent + '; ' + cells().join(', '))",
                                   "x=4&y=2");
  if (values.empty()) GTEST_SKIP() << support::no_browser;
  EXPECT_EQ(values, "Pixel (3, 0); red, 3, 2.7694 … 3.2306, green, 0, 0 … 0, blue, 0.25, 0.25 … 0.25");
  EXPECT_EQ(after(html, "([1, 2, 3].forEach(() => key('c')), document.getElementById('channel').value)"), "green");
  EXPECT_EQ(after(html, "(key(']'), key(']'), key('['), document.getElementById('stops').textContent)"), "+0.5 stops");
  EXPECT_EQ(after(html, "(key('d'), location.hash.includes('view=a'))"), "true") << "no second picture";
  EXPECT_EQ(after(html, "(cells().slice(-3).join())", "channel=Z"), "Z,7.5,");
  EXPECT_EQ(after(html, "(cells().length)", "channel=N"), "18") << "three colours and three components";
}

TEST_F(ViewPageTest, Mouse_ZoomsMovesAndSelects) {
  const std::string html = to_html(page(false));
  const std::string zoom = "+document.getElementById('scale').textContent.split(' ')[0]";
  const std::string grown = after(html,
                                  "(() => { const before = " + zoom +
                                      "; mouse('wheel', 50, 50, {deltaY: -200}); "
                                      "return Math.round(" +
                                      zoom + " / before * 10); })()",
                                  "zoom=8");
  if (grown.empty()) GTEST_SKIP() << support::no_browser;
  EXPECT_EQ(grown, "20");
  // At 8 pixels each and fitted, then moved by 16 pixels: the pixel under the mouse is two to the left.
  const std::string under = "document.getElementById('pixel').textContent";
  EXPECT_EQ(after(html,
                  "(() => { const x = box.width / 2 + 20, y = box.height / 2 - 4; mouse('pointermove', x, y); const "
                  "first = " +
                      under +
                      "; mouse('pointerdown', x, y); mouse('pointermove', x + 16, y); "
                      "mouse('pointerup', x + 16, y); mouse('pointermove', x, y); return first + ' ' + " +
                      under + "; })()",
                  "zoom=8"),
            "Pixel (5, 1) Pixel (3, 1)");
}

TEST_F(ViewPageTest, Pair_FlipsSplitsAndSubtracts) {
  const std::string html = to_html(page(true));
  const std::string flipped = after(html, "(key(' '), location.hash.match(/view=(\\w+)/)[1])");
  if (flipped.empty()) GTEST_SKIP() << support::no_browser;
  EXPECT_EQ(flipped, "b");
  EXPECT_EQ(after(html, "(key(' '), key(' '), location.hash.match(/view=(\\w+)/)[1])"), "a");
  EXPECT_EQ(after(html, "(key('s'), document.getElementById('wipe').hidden)"), "false");
  EXPECT_EQ(after(html,
                  "(document.getElementById('wipe').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight', "
                  "bubbles: true})), document.getElementById('wipe').getAttribute('aria-valuenow'))",
                  "view=split"),
            "52");
  EXPECT_EQ(after(html, "(key('d'), cells()[5])"), "−0.5") << "the difference of red";
  // The colour of a pixel: blue where the second picture is brighter; nothing where the channels are equal.
  const std::string pixel = "[...document.getElementById('canvas').getContext('2d').getImageData(box.width / 2 + 20, "
                            "box.height / 2 - 4, 1, 1).data]";
  EXPECT_EQ(after(html, pixel + ".slice(0, 3).join()", "view=difference&channel=green&zoom=8&x=0&y=0"), "0,0,0");
  EXPECT_EQ(after(html, "(([r, g, b]) => b > g && g > r)(" + pixel + ")", "view=difference&channel=red&zoom=8&x=0&y=0"),
            "true");
  EXPECT_EQ(after(html, "(([r, g, b]) => b > g && g > r)(" + pixel + ")", "view=excess&zoom=8&x=0&y=0"), "true");
}

TEST_F(ViewPageTest, Progress_ShowsErrorAgainstTime) {
  carlo::ViewPage p = page(false);
  const carlo::ViewProgress progress{"half", 0.5, {{1, 0.1}, {2, 0.07}, {4, 0.05}}, false};
  p.progress = &progress;
  const std::string shown = after(to_html(p), "document.querySelectorAll('#progress polyline').length + ' ' + "
                                              "document.querySelector('#progress progress').value");
  if (shown.empty()) GTEST_SKIP() << support::no_browser;
  EXPECT_EQ(shown, "1 0.5");
}

TEST_F(ViewPageTest, FitsAPhone) {
  mc::write_file(path("page.html"), to_html(page(true)));
  support::expect_fits_a_phone(path("page.html"));
}

} // namespace
