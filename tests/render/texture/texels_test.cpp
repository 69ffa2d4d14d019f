#include <render/texture/texels.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(Texels, AreAsManyAsThePictureHas) {
  EXPECT_EQ(Texels(2, 1, {Spectrum::Ones(), Spectrum::Zero()}).values.size(), 2u);
  EXPECT_THROW(Texels(2, 2, {Spectrum::Ones()}), mc::Error);
  EXPECT_THROW(Texels(0, 0, {}), mc::Error);
}

} // namespace
