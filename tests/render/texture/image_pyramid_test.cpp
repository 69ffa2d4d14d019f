#include <render/texture/image_pyramid.h>

#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

double mean_of(const Texels& image) {
  double sum = 0;
  for (const Spectrum& s : image.values) sum += double(s[1]);
  return sum / double(image.values.size());
}

TEST(ImagePyramid, LevelsHalveTheSizeAndKeepTheMean) {
  mc::Pcg random(3);
  for (const auto& [width, height] : {std::pair(1, 1), {64, 64}, {7, 5}, {1, 9}, {100, 3}, {33, 17}}) {
    std::vector<Spectrum> values;
    for (int i = 0; i < width * height; ++i) values.push_back(Spectrum::Constant(random.uniform<Float>()));
    const ImagePyramid pyramid(std::make_shared<const Texels>(width, height, values));
    for (std::size_t i = 0; i < pyramid.size(); ++i) {
      EXPECT_EQ(pyramid.level(i).width, std::max(width >> i, 1));
      EXPECT_EQ(pyramid.level(i).height, std::max(height >> i, 1));
      EXPECT_NEAR(mean_of(pyramid.level(i)), mean_of(pyramid.level(0)), 1e-5) << width << "x" << height << ", " << i;
    }
    EXPECT_EQ(pyramid.level(pyramid.size() - 1).values.size(), 1u);
  }
}

// A texel of a third of a row is the mean over its third.
TEST(ImagePyramid, TexelsOfOddSizesCoverTheirArea) {
  std::vector<Spectrum> row;
  for (const double x : {1, 2, 4, 8, 16, 32, 64}) row.push_back(Spectrum::Constant(Float(x)));
  const ImagePyramid pyramid(std::make_shared<const Texels>(7, 1, row));
  EXPECT_NEAR(pyramid.level(1).at(0, 0)[0], (1 + 2 + 4.0 / 3) * 3 / 7, 1e-5);
  EXPECT_NEAR(pyramid.level(1).at(1, 0)[0], (4 * 2.0 / 3 + 8 + 16 * 2.0 / 3) * 3 / 7, 1e-5);
  EXPECT_NEAR(pyramid.level(1).at(2, 0)[0], (16.0 / 3 + 32 + 64) * 3 / 7, 1e-4);
}

} // namespace
