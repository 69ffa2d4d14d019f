#include <render/integrator/interaction.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

TEST(Interaction, MediumFollowsSideOfDirection) {
  SurfacePoint point;
  point.p = point.ng = point.ns = Vec3::UnitZ();
  const Dielectric glass;
  const HomogeneousMedium ink(Spectrum::Ones()), outer(Spectrum::Ones());
  const Vec3 in(0, 0, -1), out(0, 0, 1);
  const auto from = [&](const Vec3& wo, const HomogeneousMedium* interior, const MediumStack& before) {
    return Interaction<Dielectric>{{glass, point, wo}, interior, before};
  };
  const auto entering = from(out, &ink, {.current = &outer});
  EXPECT_EQ(entering.media(in).current, &ink);
  EXPECT_EQ(entering.media(in).outer, &outer);
  EXPECT_EQ(entering.media(out).current, &outer);
  const auto leaving = from(in, &ink, {&ink, &outer});
  EXPECT_EQ(leaving.media(out).current, &outer);
  EXPECT_EQ(leaving.media(out).outer, nullptr);
  EXPECT_EQ(leaving.media(in).current, &ink);
  const auto nowhere = from(in, nullptr, {&ink, &outer});
  EXPECT_EQ(nowhere.media(in).current, &ink);
  EXPECT_EQ(nowhere.media(out).current, &ink);
}

} // namespace
