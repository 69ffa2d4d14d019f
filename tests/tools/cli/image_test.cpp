// carlo image: round trips between formats, exposure, crop, tone, layers, and bad input.

#include <tools/run_carlo.h>

#include <render/io/image/image_io.h>

#include <mc/core/file.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace {

using render::Float;
using support::run_carlo;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

struct ImageCommand : support::ScratchTest {
  render::Image a{8, 6};

  void SetUp() override {
    ScratchTest::SetUp();
    a.variance = a.pixels;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      const auto x = Float(i);
      a.pixels[i] = render::Spectrum(x / 7, x * x / 50, std::sqrt(x));
      a.variance[i] = a.pixels[i] / 100 + Float(1e-3);
      a.layers["Z"].push_back(i == 0 ? HUGE_VALF : 2 + float(i));
      for (const char* name : {"albedo.R", "albedo.G", "albedo.B"}) a.layers[name].push_back(float(i) / 64);
    }
    a.estimates = 4;
    a.noise_area = 2;
    a.metadata = {{"carlo.scene", "a.xml"}, {"carlo.samples_per_pixel", "16"}};
    render::write_image(path("a.exr"), a);
  }

  support::ProcessResult convert(const std::string& in, const std::string& out, const std::string& options = "") const {
    return run_carlo("image " + path(in) + " " + path(out) + " " + options);
  }
  render::Image converted(const std::string& in, const std::string& out, const std::string& options = "") const {
    const support::ProcessResult run = convert(in, out, options);
    EXPECT_EQ(run.exit_code, 0) << run.output;
    return run.exit_code == 0 ? render::read_image(path(out)) : render::Image();
  }
};

// Pixels in which two pictures differ; all of them where the sizes differ.
std::ptrdiff_t differing(const std::vector<render::Spectrum>& x, const std::vector<render::Spectrum>& y) {
  if (x.size() != y.size()) return std::ptrdiff_t(std::max(x.size(), y.size()));
  std::ptrdiff_t count = 0;
  for (std::size_t i = 0; i < x.size(); ++i) count += (x[i] != y[i]).any();
  return count;
}

TEST_F(ImageCommand, ExrToExr_KeepsVarianceLayersAndMetadata) {
  const render::Image b = converted("a.exr", "b.EXR");
  EXPECT_EQ(differing(b.pixels, a.pixels), 0);
  EXPECT_EQ(differing(b.variance, a.variance), 0);
  EXPECT_EQ(b.layers, a.layers);
  EXPECT_EQ(b.estimates, a.estimates);
  EXPECT_EQ(b.noise_area, a.noise_area);
  std::map<std::string, std::string> metadata = b.metadata;
  EXPECT_EQ(metadata["carlo.image_command"], "carlo image " + path("a.exr") + " " + path("b.EXR"));
  metadata.erase("carlo.image_command");
  EXPECT_EQ(metadata, a.metadata);
}

TEST_F(ImageCommand, ExrToPfmToExr_KeepsTheBitsOfRadiance) {
  const support::ProcessResult run = convert("a.exr", "b.pfm");
  EXPECT_EQ(run.output, path("b.pfm") + ": 8x6 pixels; without variance and 4 channels, which only an .exr stores\n");
  const render::Image c = converted("b.pfm", "c.exr");
  EXPECT_EQ(differing(c.pixels, a.pixels), 0);
  EXPECT_TRUE(c.variance.empty() && c.layers.empty());
}

TEST_F(ImageCommand, PngToPng_KeepsItsValues) {
  const render::Image b = converted("a.exr", "b.png"), c = converted("b.png", "c.png"), d = converted("c.png", "d.exr");
  EXPECT_EQ(differing(b.pixels, c.pixels), 0);
  EXPECT_EQ(differing(c.pixels, d.pixels), 0);
  EXPECT_EQ(c.metadata.at("carlo.scene"), "a.xml");
  EXPECT_FALSE(d.metadata.contains("carlo.samples_per_pixel")) << "render --resume must not average 8-bit values";
}

TEST_F(ImageCommand, Crop_AppliesToVarianceAndLayers) {
  const render::Image b = converted("a.exr", "b.exr", "--crop 2,1,3,4");
  ASSERT_EQ(b.width, 3);
  ASSERT_EQ(b.height, 4);
  ASSERT_EQ(b.variance.size(), 12u);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 3; ++x) {
      const std::size_t to = b.index(x, y), from = a.index(x + 2, y + 1);
      EXPECT_TRUE((b.pixels[to] == a.pixels[from]).all());
      EXPECT_TRUE((b.variance[to] == a.variance[from]).all());
      EXPECT_EQ(b.layers.at("Z").at(to), a.layers.at("Z")[from]);
    }
}

// Factors of 2 are exact.
TEST_F(ImageCommand, Exposure_ScalesRadianceAndVariance) {
  const render::Image b = converted("a.exr", "b.exr", "--exposure 1"), c = converted("b.exr", "c.exr", "--exposure -1");
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    EXPECT_TRUE((b.pixels[i] == 2 * a.pixels[i]).all());
    EXPECT_TRUE((b.variance[i] == 4 * a.variance[i]).all());
  }
  EXPECT_EQ(differing(c.pixels, a.pixels), 0);
  EXPECT_EQ(differing(c.variance, a.variance), 0);
  EXPECT_EQ(b.layers, a.layers);
  EXPECT_EQ(b.estimates, a.estimates);
  EXPECT_FALSE(b.metadata.contains("carlo.samples_per_pixel")) << "render --resume must not average other units";
  EXPECT_NEAR(auto_exposure(converted("a.exr", "d.pfm", "--exposure auto")), 0, 1e-5);
}

TEST_F(ImageCommand, Exposure_RefusesToLeaveTheRangeOfFloats) {
  for (const auto& [options, words] : std::vector<std::pair<std::string, std::string>>{
           {"--exposure 100", "--exposure 100: the variance of '" + path("a.exr") + "' of pixel (0, 0) would be"},
           {"--exposure -80", "--exposure -80: the variance of '" + path("a.exr") + "' would be at most"}}) {
    const support::ProcessResult run = convert("a.exr", "b.exr", options);
    EXPECT_EQ(run.exit_code, 2) << run.output;
    EXPECT_THAT(run.output, AllOf(HasSubstr(words), EndsWith("stops\n")));
    EXPECT_FALSE(std::filesystem::exists(path("b.exr")));
  }
}

// The same bytes but for the texts: the same pixels, and the same tone for the same words.
TEST_F(ImageCommand, Png_EqualsThatOfRender) {
  const std::string render = "render cbox --size 16x12 --spp 4 -o ";
  ASSERT_EQ(run_carlo(render + path("r.exr") + " --layers").exit_code, 0);
  for (const std::string tone : {"--tone clamp --exposure 0", "--tone reinhard --exposure 1.5",
                                 "--tone filmic --exposure auto", "--exposure auto --tone clamp"}) {
    ASSERT_EQ(run_carlo(render + path("r.png") + " " + tone).exit_code, 0);
    const render::Image expected = render::read_image(path("r.png"));
    EXPECT_EQ(differing(converted("r.exr", "b.png", tone).pixels, expected.pixels), 0) << tone;
  }
}

TEST_F(ImageCommand, CropOfARender_IsTheRenderOfTheCrop) {
  const std::string render = "render cbox --size 16x12 --spp 4 --layers -o ";
  ASSERT_EQ(run_carlo(render + path("r.exr")).exit_code, 0);
  ASSERT_EQ(run_carlo(render + path("part.exr") + " --crop 4,3,8,6").exit_code, 0);
  const render::Image half = converted("r.exr", "b.exr", "--crop 2,3,12,6"),
                      part = converted("b.exr", "c.exr", "--crop 2,0,8,6"),
                      expected = render::read_image(path("part.exr"));
  EXPECT_EQ(differing(part.pixels, expected.pixels), 0);
  EXPECT_EQ(differing(part.variance, expected.variance), 0);
  EXPECT_EQ(part.layers, expected.layers);
  EXPECT_EQ(part.metadata.at("carlo.crop"), "4,3,8,6");
  const std::string resume = "render cbox --size 16x12 --spp 4 --crop 4,3,8,6 --resume -o ";
  EXPECT_THAT(run_carlo(resume + path("c.exr")).output, HasSubstr("8 samples per pixel of 2 runs"));
  converted("c.exr", "d.exr", "--exposure 1");
  EXPECT_THAT(run_carlo(resume + path("d.exr")).output, HasSubstr("does not state its samples per pixel"));
}

TEST_F(ImageCommand, Layer_IsStoredAsItIs) {
  const render::Image z = converted("a.exr", "z.exr", "--layer Z"),
                      albedo = converted("a.exr", "n.pfm", "--layer albedo"),
                      bright = converted("a.exr", "m.pfm", "--layer albedo --exposure 1 --crop 1,0,1,1"),
                      variance = converted("a.exr", "v.pfm", "--layer variance");
  EXPECT_EQ(z.pixels[0][0], HUGE_VALF);
  EXPECT_EQ(z.pixels[9][2], Float(11));
  EXPECT_TRUE(z.variance.empty() && z.layers.empty());
  EXPECT_EQ(z.metadata.at("carlo.layer"), "Z");
  EXPECT_EQ(albedo.pixels[32][1], Float(0.5));
  EXPECT_EQ(bright.pixels[0][0], Float(1) / 32);
  EXPECT_EQ(differing(variance.pixels, a.variance), 0);
}

TEST_F(ImageCommand, Layer_IsShownInAPng) {
  const render::Image z = converted("a.exr", "z.png", "--layer Z");
  EXPECT_EQ(z.pixels[0][0], Float(1)) << "infinite";
  EXPECT_EQ(z.pixels[1][0], Float(0)) << "the nearest";
  EXPECT_EQ(z.pixels[47][0], Float(1)) << "the farthest";
  EXPECT_NEAR(z.pixels[24][0], 0.5, 0.01);
  const render::Image dark = converted("a.exr", "z.png", "--layer Z --exposure -1");
  EXPECT_NEAR(dark.pixels[47][0], 0.5, 0.01);
  EXPECT_NEAR(converted("a.exr", "b.png", "--layer albedo").pixels[16][0], 0.25, 0.01);
}

TEST_F(ImageCommand, Png_WarnsOfPixelsThatAreNotFinite) {
  a.at(3, 2)[1] = std::numeric_limits<Float>::quiet_NaN();
  a.at(5, 5)[0] = std::numeric_limits<Float>::infinity();
  render::write_image(path("a.exr"), a);
  EXPECT_THAT(convert("a.exr", "b.png").output,
              HasSubstr("warning: '" + path("a.exr") + "': 2 of 48 pixels are not finite, the first at pixel (3, 2)"));
  EXPECT_THAT(convert("a.exr", "b.exr").output, Not(HasSubstr("warning")));
  const render::Image b = render::read_image(path("b.exr"));
  EXPECT_TRUE(std::isnan(b.at(3, 2)[1]) && std::isinf(b.at(5, 5)[0])) << "an EXR stores them";
}

TEST_F(ImageCommand, PictureBeyondTheMemory_IsRefused) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve more memory than any limit allows";
#endif
  render::write_image(path("big.png"), render::Image(2000, 2000));
  const support::ProcessResult run = convert("big.png", "b.exr", "--memory 0.01");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, HasSubstr("--memory sets another limit"));
  EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
  EXPECT_FALSE(std::filesystem::exists(path("b.exr")));
}

TEST_F(ImageCommand, BadInput_IsOneLineAndWritesNothing) {
  render::write_image(path("plain.exr"), render::Image(2, 2));
  render::write_image(path("p.pfm"), render::Image(2, 2));
  write("broken.exr", "no EXR");
  const std::string before = mc::read_file(path("a.exr"));
  for (const auto& [in, out, options, words] : std::vector<std::array<std::string, 4>>{
           {"none.exr", "b.png", "", "none.exr': no such file"},
           {"broken.exr", "b.png", "", "broken.exr: cannot read EXR"},
           {"a.xml", "b.png", "", "unknown image format '.xml'; use .exr, .pfm, .hdr, .png, .jpg, .jpeg, .bmp"},
           {"a.exr", "b.jpg", "", "unknown image format '.jpg'; use .exr, .pfm or .png"},
           {"a.exr", "none/b.png", "", "none"},
           {"a.exr", "a.exr", "--exposure 1", "OUT would write '" + path("a.exr") + "' over IN; name another file"},
           {"a.exr", "./a.exr", "", "over IN; name another file"},
           {"a.exr", "b.png", "--crop 6,0,3,3", "must lie within the 8x6 pixels of '" + path("a.exr")},
           {"a.exr", "b.png", "--crop 6,0", "must be X,Y,WIDTH,HEIGHT in pixels"},
           {"a.exr", "b.png", "--tone filmc", "did you mean 'filmic'?"},
           {"a.exr", "b.png", "--exposure bright", "must be a number of stops in [-100, 100], or auto"},
           {"a.exr", "b.pfm", "--tone filmic",
            "--tone: '" + path("b.pfm") + "' stores radiance as it is; write a .png"},
           {"a.exr", "b.exr", "--layer Z --exposure 1", "the layer Z is no light, and"},
           {"a.exr", "b.exr", "--layer variance --exposure auto", "the layer variance is no light, and"},
           {"a.exr", "b.png", "--layer albdo", "did you mean 'albedo'?; use one of variance, Z, albedo"},
           {"plain.exr", "b.png", "--layer Z", "has no layers; carlo render --layers writes them"},
           {"p.pfm", "b.png", "--layer Z", "p.pfm' has no layers; only an .exr has them"}}) {
    const support::ProcessResult run = convert(in, out, options);
    EXPECT_EQ(run.exit_code, 2) << options << run.output;
    EXPECT_THAT(run.output, HasSubstr(words)) << options;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
    EXPECT_FALSE(std::filesystem::exists(path("b.png")) || std::filesystem::exists(path("b.exr"))) << options;
  }
  EXPECT_EQ(mc::read_file(path("a.exr")), before);
}

} // namespace
