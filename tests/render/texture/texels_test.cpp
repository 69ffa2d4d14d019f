#include <render/texture/texels.h>

#include "support/files.h"

namespace {

using namespace render;

TEST(Texels, AreAsManyAsThePictureHas) {
  EXPECT_EQ(Texels(2, 1, {Spectrum::Ones(), Spectrum::Zero()}).values.size(), 2u);
  EXPECT_THROW(Texels(2, 2, {Spectrum::Ones()}), mc::Error);
  EXPECT_THROW(Texels(0, 0, {}), mc::Error);
}

TEST(Texels, NameTheFirstThatIsNotGood) {
  const Texels t(2, 2, {Spectrum::Zero(), Spectrum::Zero(), Spectrum::Zero(), Spectrum(1, 2, 3)}, "a.exr");
  const auto said = [&](Float most) {
    return support::error_of([&] { t.require_all("sky", "is too much", [&](const auto& s) { return s[1] <= most; }); });
  };
  EXPECT_EQ(said(2), "");
  EXPECT_EQ(said(1), "sky: texel (1, 1) of 'a.exr' = (1, 2, 3) is too much");
}

} // namespace
