#include <render/io/metals.h>

#include <render/bsdf/rough_conductor.h>

#include "support/files.h"

#include <map>

namespace {

using render::Float, render::Spectrum;
using testing::HasSubstr;

// Reflectance at normal incidence.
Spectrum reflectance(std::string_view name) {
  const auto [eta, k] = render::metal_constants(name);
  return render::fresnel_conductor(1, eta, k);
}

TEST(Metals, AllAreInTheRangeOfConductors) {
  EXPECT_EQ(render::metal_names().size(), 20u);
  for (const auto name : render::metal_names()) {
    const auto [eta, k] = render::metal_constants(name);
    EXPECT_GT(eta.minCoeff(), 0.01f) << name;
    EXPECT_LT(eta.maxCoeff(), 6) << name;
    EXPECT_GT(k.minCoeff(), 0.5f) << name;
    EXPECT_LT(k.maxCoeff(), 12) << name;
    EXPECT_NO_THROW(render::checked_conductor(name, eta, k));
  }
}

// Silver and aluminium are white, gold and copper are warm, chromium and nickel reflect about half. Tables for artists
// give these values, here rounded.
TEST(Metals, ReflectAsTheirNamesSay) {
  const std::map<std::string_view, Spectrum> expected = {
      {"Ag", {0.97f, 0.96f, 0.92f}}, {"Al", {0.91f, 0.92f, 0.92f}}, {"Au", {1.0f, 0.77f, 0.34f}},
      {"Cu", {0.95f, 0.64f, 0.54f}}, {"Cr", {0.55f, 0.56f, 0.55f}}, {"Ni", {0.66f, 0.61f, 0.53f}},
  };
  for (const auto& [name, rgb] : expected)
    EXPECT_LE((reflectance(name) - rgb).abs().maxCoeff(), 0.1f) << name << ": " << reflectance(name).transpose();
}

// Sums over 400..700 nm with equal energy, by a separate program in Python.
TEST(Metals, ConstantsOfGold) {
  const auto [eta, k] = render::metal_constants("Au");
  EXPECT_LE((eta - Spectrum(0.1300f, 0.4650f, 1.3356f)).abs().maxCoeff(), 5e-4f) << eta.transpose();
  EXPECT_LE((k - Spectrum(4.2065f, 2.2218f, 1.6342f)).abs().maxCoeff(), 5e-4f) << k.transpose();
}

TEST(Metals, UnknownNames) {
  EXPECT_THAT(support::error_of([] { render::metal_constants("Ag2"); }),
              HasSubstr("material 'Ag2' is not known; did you mean 'Ag'?; give eta and k, none, or one of Ag, Al, Au"));
  EXPECT_EQ(support::error_of([] { render::metal_constants("TiO2"); }),
            "material 'TiO2' is not in the table of metals; give its eta and k instead");
  EXPECT_EQ(reflectance("Ni").matrix(), reflectance("Ni_palik").matrix());
}

} // namespace
