#include <gallery/contact_sheet.h>
#include <gallery/label.h>

#include <gtest/gtest.h>

namespace {

using render::Image, render::Spectrum, render::Float;

Image ramp(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y) = Spectrum(Float(x + 0.5), Float(y + 0.5), 1);
  return image;
}

// Equal up to the rounding of sums of up to 15 values.
TEST(ContactSheet, ThumbnailPixelIsMeanOfCoveredPixels) {
  const Image small = carlo::thumbnail(ramp(150, 70), 10);
  ASSERT_EQ(small.width, 10);
  ASSERT_EQ(small.height, 5);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      EXPECT_NEAR(small.at(x, y)[0], (x + 0.5) * 15, 2e-4);
      EXPECT_NEAR(small.at(x, y)[1], (y + 0.5) * 14, 2e-4);
      EXPECT_NEAR(small.at(x, y)[2], 1, 1e-6);
    }
  EXPECT_EQ(carlo::thumbnail(ramp(4, 3), 11).width, 4) << "nothing grows";
  EXPECT_EQ(carlo::thumbnail(ramp(1000, 1), 11).height, 1);
}

// If a thumbnail edge cuts a pixel, each part counts in the thumbnail pixel that covers it.
TEST(ContactSheet, ThumbnailPreservesMean) {
  for (const int side : {7, 11, 13, 64}) {
    const Image small = carlo::thumbnail(ramp(150, 70), side);
    Spectrum sum = Spectrum::Zero();
    for (const Spectrum& p : small.pixels) sum += p;
    sum /= Float(small.pixels.size());
    EXPECT_NEAR(sum[0], 75, 1e-3) << side;
    EXPECT_NEAR(sum[1], 35, 1e-3) << side;
  }
}

TEST(ContactSheet, PlacesEachPictureInItsCell) {
  std::vector<Image> pictures;
  for (int i = 0; i < 5; ++i) { // the last is narrow, and the second row is lower
    pictures.emplace_back(i == 4 ? 2 : 6, i < 3 ? 6 : 4);
    for (Spectrum& p : pictures.back().pixels) p.setConstant(Float(i + 1));
  }
  const Image sheet = carlo::contact_sheet(pictures, 3, 6);
  EXPECT_EQ(sheet.width, 4 + 3 * 10);
  EXPECT_EQ(sheet.height, 4 + 10 + 8);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(sheet.at(4 + i % 3 * 10 + 3, 4 + i / 3 * 10 + 2)[0], Float(i + 1)) << i;
  EXPECT_LT(sheet.at(14, 15)[0], Float(0.5)) << "beside the narrow one is the ground";
  double sum = 0;
  for (const Spectrum& p : sheet.pixels)
    if (p[0] >= 1) sum += double(p[0]);
  EXPECT_EQ(sum, 36 * (1 + 2 + 3) + 24 * 4 + 8 * 5);
}

// A line of text below each picture, a line above the columns and a column left of the rows.
TEST(ContactSheet, LabelsHavePlacesOfTheirOwn) {
  constexpr int gap = 4, line = carlo::label_height, side = 40;
  const std::vector<Image> pictures(4, Image(side, 30));
  const Image named = carlo::contact_sheet(pictures, 2, side, {.cells = {"a", "b", "c", "d"}});
  EXPECT_EQ(named.width, gap + 2 * (side + gap));
  EXPECT_EQ(named.height, gap + 2 * (30 + line + gap));
  const Image table = carlo::contact_sheet(pictures, 2, side, {.columns = {"1", "4"}, .rows = {"mis", "nee"}});
  EXPECT_EQ(table.width, gap + 30 + gap + 2 * (side + gap));
  EXPECT_EQ(table.height, gap + line + 2 * (30 + gap));
  for (int y = gap + line; y < gap + line + 30; ++y)
    for (int x = 2 * gap + 30; x < 2 * gap + 30 + side; ++x) EXPECT_EQ(table.at(x, y)[0], 0) << "no text on a picture";
}

} // namespace
