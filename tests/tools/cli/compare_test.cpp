// carlo compare: differences that it must accept and differences that it must reject.

#include <tools/run_carlo.h>

#include <render/io/image/image_io.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using support::run_carlo;
using testing::HasSubstr;

constexpr int size = 48, replicates = 8;

// Uniform noise of standard deviation 0.1 per replicate about `mean`, with its estimated variance.
render::Image noisy(std::uint64_t seed, double mean) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> noise(-0.1 * std::sqrt(3.0), 0.1 * std::sqrt(3.0));
  render::Image image(size, size);
  image.variance.resize(image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      double sum = 0, squares = 0;
      for (int r = 0; r < replicates; ++r) {
        const double x = mean + noise(engine);
        sum += x;
        squares += x * x;
      }
      const double m = sum / replicates;
      image.pixels[i][c] = render::Float(m);
      image.variance[i][c] = render::Float((squares / replicates - m * m) / (replicates - 1));
    }
  image.estimates = static_cast<std::uint32_t>(replicates);
  return image;
}

struct Compare : support::ScratchTest {
  void save(const std::string& name, const render::Image& image) const { render::write_image(path(name), image); }
  support::ProcessResult compare(const std::string& arguments) const {
    return run_carlo("compare " + path("a.exr") + " " + path("b.exr") + " " + arguments);
  }
};

// Ten fixed pairs at alpha = 0.01: two or more rejections have probability 0.004.
TEST_F(Compare, AcceptsNoiseAndRejectsBiasedPixelOrBlock) {
  int rejected = 0;
  for (std::uint64_t k = 0; k < 10; ++k) {
    save("a.exr", noisy(2 * k, 0.5));
    save("b.exr", noisy(2 * k + 1, 0.5));
    rejected += compare("").exit_code;
  }
  EXPECT_LE(rejected, 1);

  const render::Image right = noisy(1, 0.5);
  save("b.exr", right);
  render::Image off = noisy(2, 0.5);
  for (int y = 16; y < 32; ++y) // 0.4 standard errors of a pixel's difference, but 6 of a block's
    for (int x = 16; x < 32; ++x) off.at(x, y)[1] += render::Float(0.02);
  save("a.exr", off);
  EXPECT_EQ(compare("").exit_code, 1);
  EXPECT_EQ(compare("--tolerance 0.05").exit_code, 0) << "0.02 is 4 % of 0.5";

  off = noisy(2, 0.5);
  off.at(3, 40)[0] += 3;
  save("a.exr", off);
  const support::ProcessResult run = compare("");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("(3, 40) red"));
}

// A lamp smaller than a pixel: all point sets sampled nearly the same share of it, so the spread understates the error.
// The rest of the block has little noise.
TEST_F(Compare, NoiselessPixel_DoesNotFailItsBlock) {
  render::Image a(size, size);
  for (auto& p : a.pixels) p.setConstant(render::Float(0.5));
  a.variance.assign(a.pixels.size(), render::Spectrum::Constant(render::Float(1e-8)));
  a.estimates = 4;
  save("b.exr", a);
  a.at(20, 20)[0] += render::Float(0.1);
  a.variance[a.index(20, 20)].setConstant(render::Float(2.5e-5));
  save("a.exr", a);
  EXPECT_EQ(compare("").exit_code, 0) << "18 standard errors of the block, but one pixel has most of its variance";
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) a.at(x, y)[1] += render::Float(1e-4); // 11 standard errors
  save("a.exr", a);
  const support::ProcessResult run = compare("");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("blocks     worst at (0, 0) green"));
}

TEST_F(Compare, MetricsAndDifferenceImage) {
  render::Image a(4, 2), b(4, 2);
  for (auto& p : a.pixels) p.setConstant(render::Float(0.75));
  for (auto& p : b.pixels) p.setConstant(render::Float(0.5));
  save("a.exr", a);
  save("b.exr", b);
  EXPECT_EQ(compare("--metric mse").output, "0.0625\n");
  EXPECT_EQ(compare("--metric rmse").output, "0.25\n");
  EXPECT_EQ(compare("--metric mae").output, "0.25\n");
  EXPECT_EQ(compare("--metric max").output, "0.25\n");
  EXPECT_EQ(compare("--metric mean_ratio").output, "1.5\n");
  EXPECT_EQ(compare("--metric relmse --diff " + path("d.pfm")).output, "0.240385\n"); // 0.0625 / (0.25 + 0.01)
  EXPECT_EQ(render::read_image(path("d.pfm")).at(3, 1)[2], render::Float(0.25));
  EXPECT_THAT(compare("--diff " + path("./a.exr")).output, HasSubstr("a.exr' over A; name another file"));
  save("a.exr", render::Image(4, 2));
  save("b.exr", render::Image(4, 2));
  EXPECT_EQ(compare("--metric mean_ratio").output, "1\n");
}

// An image without variances is a reference, such as the mean of many renders.
TEST_F(Compare, ImageWithoutVariance_CountsAsExact) {
  render::Image exact(size, size);
  for (auto& p : exact.pixels) p.setConstant(render::Float(0.5));
  save("a.exr", noisy(1, 0.5));
  save("b.exr", exact);
  const support::ProcessResult run = compare("");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, AllOf(HasSubstr("verdict    agree: family-wise"),
                                HasSubstr("; '" + path("b.exr") + "' has no variance and counts as exact")));
  for (auto& p : exact.pixels) p *= render::Float(1.02);
  save("b.exr", exact);
  EXPECT_EQ(compare("").exit_code, 1);
  EXPECT_EQ(compare("--tolerance 0.03").exit_code, 0);
}

TEST_F(Compare, WithoutVariances_TheToleranceDecides) {
  render::Image a(4, 2), b(4, 2);
  for (auto& p : b.pixels) p.setConstant(render::Float(0.5));
  b.at(3, 1) = render::Spectrum::Constant(render::Float(1e-3)); // counts as the mean, .438
  a.pixels = b.pixels;
  a.at(1, 0)[1] = render::Float(0.504);
  for (const std::string ending : {"exr", "pfm"}) {
    const auto run = [&](const std::string& options) {
      return run_carlo("compare " + path("a." + ending) + " " + path("b." + ending) + " " + options);
    };
    save("a." + ending, a);
    save("b." + ending, b);
    EXPECT_EQ(run("").exit_code, 0);
    EXPECT_THAT(run("").output, HasSubstr("verdict    none: the images carry no variance; give --tolerance"));
    EXPECT_EQ(run("--tolerance 0.009").exit_code, 0);
    EXPECT_EQ(run("--tolerance 0.007").exit_code, 1);
    EXPECT_THAT(
        run("--tolerance 0.007").output,
        HasSubstr("verdict    DIFFER: the largest difference is 0.008 of B (dark pixels: of its mean), at (1, 0) "
                  "green; tolerance 0.007"));
    EXPECT_EQ(run("--alpha 0.05").exit_code, 2);
    EXPECT_THAT(run("--alpha 0.05").output, HasSubstr("--alpha: the images carry no variance"));
    for (const std::string of_verdicts : {"--tolerance 0.1", "--alpha 0.1"})
      EXPECT_EQ(run("--metric mse " + of_verdicts).exit_code, 2) << of_verdicts;
  }
  render::Image dark = b;
  dark.at(3, 1) = render::Spectrum::Constant(render::Float(2e-3)); // twice as bright, but .0023 of the mean
  save("a.exr", dark);
  save("b.exr", b);
  EXPECT_EQ(compare("--tolerance 0.003").exit_code, 0);
}

TEST_F(Compare, Report_ShowsBothImagesAndTheVerdict) {
  save("a.exr", noisy(1, 0.5));
  save("b.exr", noisy(2, 0.5));
  ASSERT_EQ(compare("--report " + path("page")).exit_code, 0);
  const std::string page = mc::read_file(path("page/index.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("\"verdict\":\"agree: family-wise"), HasSubstr("\"name\":\"" + path("b.exr"))));
  EXPECT_EQ(compare("--report " + path("a.exr")).exit_code, 2);
}

TEST_F(Compare, InvalidVariance_IsReportedInOneLine) {
  for (const auto& [bad, said] : {std::pair(-1e-6, "-1e-06"), {double(INFINITY), "inf"}, {double(NAN), "nan"}})
    for (const char* name : {"a.exr", "b.exr"}) {
      render::Image broken = noisy(1, 0.5);
      save("a.exr", broken);
      save("b.exr", broken);
      broken.variance[broken.index(7, 9)][1] = render::Float(bad);
      save(name, broken);
      const support::ProcessResult run = compare("");
      EXPECT_EQ(run.exit_code, 2) << run.output;
      EXPECT_THAT(run.output, HasSubstr(path(name) + "': the variance of pixel (7, 9) in green is " + said));
      EXPECT_EQ(compare("--metric mse").output, "0\n") << "needs no variance";
    }
  render::Image dim = noisy(1, 0.5);
  for (auto& p : dim.pixels) p *= render::Float(1e-25);
  for (auto& v : dim.variance) v.setZero();
  save("a.exr", dim);
  save("b.exr", dim);
  EXPECT_THAT(compare("").output, HasSubstr("a.exr': the largest value is"));
}

TEST_F(Compare, BadInput_IsReportedInOneLine) {
  save("a.exr", noisy(1, 0.5));
  save("b.exr", render::Image(4, 4));
  EXPECT_EQ(compare("").exit_code, 2);
  EXPECT_THAT(compare("").output, HasSubstr("sizes must agree"));
  render::Image broken = noisy(2, 0.5);
  broken.at(7, 9)[2] = std::numeric_limits<render::Float>::quiet_NaN();
  save("b.exr", broken);
  EXPECT_EQ(compare("").exit_code, 2) << "NaN agrees with nothing";
  EXPECT_THAT(compare("").output, HasSubstr("(7, 9)"));
  EXPECT_THAT(compare("--metric mes").output, HasSubstr("(7, 9)"));
  save("b.exr", noisy(2, 0.5));
  EXPECT_THAT(compare("--metric mes").output, HasSubstr("did you mean 'mse'"));
  EXPECT_EQ(compare("--alpha 2").exit_code, 2);
  EXPECT_EQ(run_carlo("compare " + path("a.exr") + " " + path("none.exr")).exit_code, 2);
}

} // namespace
