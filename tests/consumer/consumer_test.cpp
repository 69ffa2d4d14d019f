// Test suite of a user against the installed package, with the examples of libmc/README.md in the same program.

#include <readme_examples.h>

#include "my_test.cpp" // the example of the README, in one translation unit with the others

#include <mc/gtest/matchers.h>
#include <mc/warp/hemisphere.h>

#include <gtest/gtest.h>

#include <string_view>

namespace {

// A user's sampling function, checked against its claimed density.
mc::Vec3<double> my_sample(mc::Pcg& random) { return mc::CosineHemisphere<double>().sample(random.point<double, 2>()); }
double my_pdf(const mc::Vec3<double>& w) { return std::max(w.z(), 0.0) / mc::pi<double>; }
double wrong_pdf(const mc::Vec3<double>& w) { return w.z() >= 0 ? 1 / (2 * mc::pi<double>) : 0; }

TEST(Consumer, LibraryWarpObeysItsLaws) {
  EXPECT_WARP_LAWS(mc::CosineHemisphere<float>(), {.statistics = {.samples = 100'000}});
}

TEST(Consumer, OwnSamplerMatchesItsPdf) { EXPECT_SAMPLES_MATCH_PDF(my_sample, my_pdf, mc::Hemisphere<double>()); }

TEST(Consumer, WrongPdfIsRejected) {
  const testing::AssertionResult result =
      mc::samples_match_pdf("my_sample", my_sample, wrong_pdf, mc::Hemisphere<double>());
  EXPECT_FALSE(result);
  EXPECT_NE(std::string(result.message()).find("my_sample: fail"), std::string::npos)
      << result.message(); // not inconclusive
}

TEST(Consumer, MeanHeightIsTwoThirds) {
  mc::Pcg random(1);
  std::vector<double> heights;
  for (int i = 0; i < 10'000; ++i) heights.push_back(my_sample(random).z());
  EXPECT_MEAN(heights, 2.0 / 3);
  EXPECT_FALSE(mc::has_mean("heights", heights, 0.65));
}

} // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--readme") {
    readme::print_examples();
    return 0;
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
