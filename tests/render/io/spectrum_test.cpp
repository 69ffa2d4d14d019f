#include <render/io/spectrum.h>

#include "support/files.h"

namespace {

// The constant 1 under the fit of the matching functions: XYZ (0.99769, 1.00025, 0.99520), RGB (1.1993, 0.9508, 0.9037)
// to four digits.
TEST(Spectrum, ConstantOne) {
  const render::Spectrum rgb = render::spectrum_to_rgb({{400, 1}, {700, 1}});
  EXPECT_NEAR(rgb[0], 1.1993, 5e-5);
  EXPECT_NEAR(rgb[1], 0.9508, 5e-5);
  EXPECT_NEAR(rgb[2], 0.9037, 5e-5);
}

TEST(Spectrum, IsLinearAndInterpolates) {
  const render::Spectrum one = render::spectrum_to_rgb({{400, 1}, {700, 1}});
  const render::Spectrum ramp = render::spectrum_to_rgb({{400, 0}, {700, 3}});
  const render::Spectrum fine = render::spectrum_to_rgb({{400, 0}, {450, 0.5}, {600, 2}, {700, 3}});
  const render::Spectrum flipped = render::spectrum_to_rgb({{400, 3}, {700, 0}});
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(ramp[c], fine[c], 1e-5);
    EXPECT_NEAR(ramp[c] + flipped[c], 3 * one[c], 1e-5);
  }
}

TEST(Spectrum, RefusesNonsense) {
  EXPECT_THAT(support::error_of([] { render::spectrum_to_rgb({}); }), testing::HasSubstr("no samples"));
  EXPECT_THAT(support::error_of([] {
                render::spectrum_to_rgb({{500, 1}, {400, 1}});
              }),
              testing::HasSubstr("sample 1 (400:1)"));
  EXPECT_THAT(support::error_of([] { render::spectrum_to_rgb({{400, NAN}}); }), testing::HasSubstr("must be finite"));
}

TEST(Spectrum, WhiteIsWhiteInDaylight) {
  using enum render::Illuminant;
  EXPECT_LE((render::spectrum_to_rgb({{400, 1}, {700, 1}}, d65) - 1).abs().maxCoeff(), 1e-6);
  EXPECT_LE((render::spectrum_to_rgb({{500, 0.3}}, d65) - render::Float(0.3)).abs().maxCoeff(), 1e-6);
  // Daylight has more short wavelengths than equal-energy light.
  const std::vector<render::SpectralSample> cyan{{400, 1}, {560, 1}, {580, 0}};
  const render::Spectrum in_daylight = render::spectrum_to_rgb(cyan, d65), with_default = render::spectrum_to_rgb(cyan);
  EXPECT_GT(in_daylight[2] / in_daylight[1], 1.02 * with_default[2] / with_default[1]);
}

// Extrapolation follows the renderer that reads the spectrum. Checks sums of three parts.
TEST(Spectrum, BeyondItsSamples) {
  using render::Extrapolation, render::Illuminant, render::SpectralSample;
  const std::vector<SpectralSample> part = {{500, 1}, {520, 1}};
  const std::vector<SpectralSample> ramp = {{480, 0}, {500, 1}, {520, 1}, {540, 0}};
  const std::vector<SpectralSample> box = {{500 - 1e-9, 0}, {500, 1}, {520, 1}, {520 + 1e-9, 0}};
  const auto rgb = [](const std::vector<SpectralSample>& s, Extrapolation beyond) {
    return render::spectrum_to_rgb(s, Illuminant::equal_energy, beyond);
  };
  EXPECT_LE((rgb(part, Extrapolation::ramp) - rgb(ramp, Extrapolation::constant)).abs().maxCoeff(), 1e-6);
  EXPECT_LE((rgb(part, Extrapolation::zero) - rgb(box, Extrapolation::constant)).abs().maxCoeff(), 1e-6);
  EXPECT_LE((rgb(part, Extrapolation::constant) - rgb({{400, 1}, {700, 1}}, Extrapolation::zero)).abs().maxCoeff(),
            1e-6);
  for (const Extrapolation beyond : {Extrapolation::constant, Extrapolation::ramp, Extrapolation::zero})
    EXPECT_LE((rgb({{500, 1}}, beyond) - rgb(part, Extrapolation::constant)).abs().maxCoeff(), 1e-6)
        << "one sample is constant";
}

} // namespace
