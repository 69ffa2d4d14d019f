#include <render/texture/bitmap.h>

#include <mc/random/pcg.h>

#include "support/files.h"

namespace {

using render::Bitmap, render::Float, render::Spectrum, render::Texels;

std::shared_ptr<const Texels> texels(int width, int height, std::vector<Spectrum> values) {
  return std::make_shared<const Texels>(width, height, std::move(values));
}
Spectrum grey(double x) { return Spectrum::Constant(Float(x)); }

TEST(BitmapTexture, CentresAreTheTexelsAndTheRestIsBilinear) {
  const Bitmap b(texels(2, 2, {grey(1), grey(2), grey(3), grey(5)}));
  EXPECT_EQ(b.eval({0.25, 0.25})[0], 1);
  EXPECT_EQ(b.eval({0.75, 0.25})[0], 2);
  EXPECT_EQ(b.eval({0.25, 0.75})[0], 3);
  EXPECT_EQ(b.eval({0.75, 0.75})[0], 5);
  EXPECT_EQ(b.eval({0.5, 0.25})[1], Float(1.5));
  EXPECT_EQ(b.eval({0.5, 0.5})[2], Float(2.75));
  // The texture wraps: half way between the last column and the first.
  EXPECT_EQ(b.eval({0, 0.25})[0], Float(1.5));
  EXPECT_EQ(b.eval({1, 0.25})[0], Float(1.5));
  EXPECT_EQ(b.eval({0.25, 0})[0], 2);
}

// The texture is continuous everywhere, also across the seam. It stays within the range of the texels and has their
// mean.
TEST(BitmapTexture, ContinuousBoundedAndOfTheTexelsMean) {
  mc::Pcg random(2);
  for (const auto& [width, height] : {std::pair(1, 1), {1, 3}, {3, 1}, {7, 5}}) {
    std::vector<Spectrum> values;
    double mean = 0;
    Float least = 1, largest = 0;
    for (int i = 0; i < width * height; ++i) {
      values.push_back(grey(random.uniform<double>()));
      mean += double(values.back()[0]) / (width * height);
      least = std::min(least, values.back()[0]);
      largest = std::max(largest, values.back()[0]);
    }
    const Bitmap b(texels(width, height, values));
    double sum = 0;
    constexpr int n = 210;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const render::Vec2d p((i + 0.5) / n, (j + 0.5) / n);
        const Spectrum s = b.eval(p);
        sum += double(s[0]) / (n * n);
        EXPECT_TRUE(s[0] >= least - Float(1e-6) && s[0] <= largest + Float(1e-6));
        EXPECT_LE(std::abs(s[0] - b.eval({p[0] + 1e-6, p[1] - 1e-6})[0]), 2e-5);
      }
    EXPECT_NEAR(sum, mean, 1e-4);
    EXPECT_NEAR(b.eval({1 - 1e-9, 0.3})[0], b.eval({1e-9, 0.3})[0], 1e-6);
  }
}

// Coordinates of the texels of the row 1, 2, 5, far on both sides of the image.
TEST(BitmapTexture, ContinuesBeyondItsEdges) {
  using render::Wrap, render::TexelFilter;
  const auto row = [](Wrap wrap, TexelFilter filter, const render::UvMap& map = render::UvMap()) {
    return Bitmap(texels(3, 1, {grey(1), grey(2), grey(5)}), map, wrap, filter);
  };
  const auto value = [](const Bitmap& b, double texel) { return double(b.eval({(texel + 0.5) / 3, 0.5})[0]); };
  for (const TexelFilter filter : {TexelFilter::bilinear, TexelFilter::nearest}) {
    const Bitmap repeat = row(Wrap::repeat, filter), clamp = row(Wrap::clamp, filter),
                 mirror = row(Wrap::mirror, filter);
    const double repeated[] = {1, 2, 5}, mirrored[] = {1, 2, 5, 5, 2, 1};
    for (int i = -12; i < 12; ++i) {
      EXPECT_NEAR(value(repeat, i), repeated[(i + 12) % 3], 1e-5) << i;
      EXPECT_NEAR(value(clamp, i), i <= 0 ? 1 : i == 1 ? 2 : 5, 1e-5) << i;
      EXPECT_NEAR(value(mirror, i), mirrored[(i + 12) % 6], 1e-5) << i;
    }
  }
  EXPECT_NEAR(value(row(Wrap::repeat, TexelFilter::bilinear), -0.25), 2, 1e-6) << "a quarter of 5, the rest 1";
  EXPECT_EQ(value(row(Wrap::clamp, TexelFilter::bilinear), -0.25), 1);
  EXPECT_EQ(value(row(Wrap::mirror, TexelFilter::bilinear), -0.25), 1);
  EXPECT_EQ(value(row(Wrap::mirror, TexelFilter::bilinear), 2.5), 5);
  EXPECT_NEAR(value(row(Wrap::mirror, TexelFilter::bilinear), 3.75), 2.75, 1e-6);
  EXPECT_EQ(value(row(Wrap::clamp, TexelFilter::nearest), 0.49), 1);
  EXPECT_EQ(value(row(Wrap::clamp, TexelFilter::nearest), 0.51), 2);
  // A product that overflows has some value of the image.
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
    for (const TexelFilter filter : {TexelFilter::bilinear, TexelFilter::nearest})
      for (const double far : {-1e300, -1e18, -3.0, 0.0, 1.0, 2.0, 3.0, 1e18, 1e300}) {
        const double got = double(row(wrap, filter, render::UvMap({1e300, 1}, {0, 0})).eval({far, far})[0]),
                     near = double(row(wrap, filter).eval({far, far})[0]);
        EXPECT_TRUE(got >= 1 && got <= 5) << far << ": " << got;
        EXPECT_TRUE(near >= 1 && near <= 5) << far << ": " << near;
      }
}

TEST(BitmapTexture, RefusesWhatIsNoPicture) {
  EXPECT_EQ(support::error_of([] {
              Bitmap(texels(2, 2, {grey(0), grey(0), grey(0), grey(NAN)}));
            }),
            "bitmap: texel (1, 1) = (nan, nan, nan) is not finite; repair the picture");
  EXPECT_EQ(support::error_of([] { Bitmap(std::make_shared<const Texels>(1, 1, std::vector{grey(NAN)}, "a.exr")); }),
            "bitmap: texel (0, 0) of 'a.exr' = (nan, nan, nan) is not finite; repair the picture");
}

TEST(BitmapTexture, NamesTheFirstTexelThatIsNoReflectance) {
  const auto said = [](std::vector<Spectrum> values) {
    const Bitmap b(std::make_shared<const Texels>(2, 2, std::move(values), "paint.exr"));
    return support::error_of([&] { b.require_reflectance("diffuse"); });
  };
  EXPECT_EQ(said({grey(0), grey(1), grey(0.5), grey(-0.0)}), "");
  EXPECT_EQ(said({grey(0), grey(1), Spectrum(1, Float(1.75), 0), grey(7)}),
            "diffuse: texel (0, 1) of 'paint.exr' = (1, 1.75, 0) must lie in [0, 1]; clip or scale the picture, whose "
            "values reach from 0 to 7");
  EXPECT_EQ(said({grey(0.5), Spectrum(0.5, 0.5, Float(-0.25)), grey(0.5), grey(0.5)}),
            "diffuse: texel (1, 0) of 'paint.exr' = (0.5, 0.5, -0.25) must lie in [0, 1]; clip or scale the picture, "
            "whose values reach from -0.25 to 0.5");
}

// A footprint of at most a texel is a point; one of the whole image gives its mean. The mean over the image is the same
// for all footprints, and a footprint of 2^i texels averages over as many.
TEST(BitmapTexture, TrilinearAveragesOverTheFootprint) {
  mc::Pcg random(4);
  constexpr int n = 16;
  std::vector<Spectrum> values;
  double mean = 0;
  for (int i = 0; i < n * n; ++i) {
    values.push_back(grey(random.uniform<double>()));
    mean += double(values.back()[0]) / (n * n);
  }
  const auto image = texels(n, n, values);
  const Bitmap sharp(image), filtered(image, render::UvMap(), render::Wrap::repeat, render::TexelFilter::trilinear),
      small(image, render::UvMap({4, 4}), render::Wrap::repeat, render::TexelFilter::trilinear);
  EXPECT_TRUE(filtered.is_filtered() && !sharp.is_filtered());
  EXPECT_EQ(sharp.eval({0.3, 0.7}, Float(0.5))[0], sharp.eval({0.3, 0.7})[0]);
  EXPECT_EQ(filtered.eval({0.3, 0.7}, Float(1) / n)[0], sharp.eval({0.3, 0.7})[0]);
  EXPECT_NEAR(filtered.eval({0.3, 0.7}, 1)[0], mean, 1e-5);
  EXPECT_NEAR(filtered.eval({0.3, 0.7}, 1e9f)[0], mean, 1e-5);
  // Four texels are one of level 2, whose centre lies at (2 + 4 i) / n.
  double four = 0;
  for (int y = 4; y < 8; ++y)
    for (int x = 8; x < 12; ++x) four += double(image->at(x, y)[0]) / 16;
  EXPECT_NEAR(filtered.eval({10.0 / n, 6.0 / n}, Float(4) / n)[0], four, 1e-5);
  EXPECT_NEAR(small.eval({10.0 / n / 4, 6.0 / n / 4}, Float(1) / n)[0], four, 1e-5);
  for (const double footprint : {0.0, 0.1, 0.3, 0.9}) {
    double sum = 0;
    constexpr int points = 160;
    for (int i = 0; i < points; ++i)
      for (int j = 0; j < points; ++j)
        sum += double(filtered.eval({(i + 0.5) / points, (j + 0.5) / points}, Float(footprint))[0]);
    EXPECT_NEAR(sum / (points * points), mean, 1e-3) << footprint;
  }
}

} // namespace
