// The page of carlo gallery: its content, and the result in a headless browser.

#include <gallery/page.h>

#include <support/files.h>
#include <tools/browser.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>

namespace {

using testing::HasSubstr, testing::Not;

constexpr carlo::GalleryScene strange{"a-long-name-of-a-scene-with-a-picture", "A < B & \"C\"", "somebody's book"};

std::vector<carlo::RenderedScene> two_scenes() {
  carlo::RenderedScene r;
  r.scene = &carlo::gallery_scene("smallpt");
  r.width = 1024;
  r.height = 768;
  r.spp = 64;
  r.seconds = 12;
  r.samples_per_second = 3e6;
  r.relative_error = 0.0123;
  r.outlier_dominated = 0.02;
  r.strategy = "mis";
  r.sampler = "sobol";
  r.features = carlo::features_of(*r.scene);
  r.strategies = {{"bsdf", 1e6, 64, 0.2, 0.4, 0.3, {1.01, 0.02, 99, 100}},
                  {"mis", 1e6, 64, 0.1, 0.1, 0, {1, 0.01, 99, 100}}};
  carlo::RenderedScene bare = r;
  bare.scene = &strange;
  bare.strategies.clear();
  bare.relative_error = HUGE_VAL;
  return {r, bare};
}

struct GalleryPage : support::ScratchTest {};

TEST_F(GalleryPage, ShowsResultsAndLoadsNothing) {
  const std::string page = carlo::gallery_page(two_scenes(), 3, "carlo gallery '<x>'");
  EXPECT_THAT(page,
              HasSubstr("1024&times;768, 64 samples/pixel, <b>3 Msamples/s</b>, 12.0 s, mean relative standard error "
                        "<b>1.2 %</b>, one sample dominates 2 % of the pixels"));
  EXPECT_THAT(page, HasSubstr("<b>mis</b></td><td data-label=\"work\">1&times;</td>"));
  EXPECT_THAT(page, HasSubstr("\"work\">4&times;</td>"));
  EXPECT_THAT(page, HasSubstr("101.0&thinsp;&plusmn;&thinsp;2.0</td>"));
  EXPECT_THAT(page, HasSubstr("<li>bsdf dielectric</li>"));
  EXPECT_THAT(page, HasSubstr("A &lt; B &amp; &quot;C&quot;"));
  EXPECT_THAT(page, HasSubstr("Interrupted: 2 of 3 scenes"));
  EXPECT_THAT(page, HasSubstr("error <b>unknown</b>"));
  for (const char* loaded : {"http", "<script", "@import", "url("}) EXPECT_THAT(page, Not(HasSubstr(loaded)));
  EXPECT_THAT(carlo::gallery_page(two_scenes(), 2, ""), Not(HasSubstr("Interrupted")));
}

TEST_F(GalleryPage, FitsAPhone) {
  std::string text = carlo::gallery_page(two_scenes(), 2, std::string(200, 'x'));
  for (std::size_t at = 0; (at = text.find("<details>", at)) != std::string::npos; ++at)
    text.replace(at, 9, "<details open>");
  support::expect_fits_a_phone(write("index.html", text));
}

} // namespace
