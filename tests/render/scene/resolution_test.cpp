#include <render/scene/resolution.h>

#include <render/io/mitsuba/mitsuba.h>
#include <render/scene/builder.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace {

using namespace render;

Scene with(const std::vector<Shape>& shapes) {
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert());
  builder.add(Light(ConstantBackground(Spectrum::Ones())));
  for (const Shape& s : shapes) builder.add(s, {gray});
  return builder.build();
}

TEST(Resolution, IsThatOfTheCoarsest) {
  EXPECT_EQ(coarsest(with({})).ratio, 0);
  const double eps = double(std::numeric_limits<Float>::epsilon());
  const Shape near = Sphere(Vec3d(1, 2, 3), 0.5), far = Sphere(Vec3d(0, -1023.5, 0), 0.25),
              large = TriangleMesh::rectangle(Transform::scale({1e6, 1e6, 1}));
  const Coarseness c = coarsest(with({near, far, large}));
  EXPECT_NEAR(c.size, 0.5 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(c.distance, 1023.75, 1e-12);
  EXPECT_NEAR(c.step, 512 * eps, 1e-12);
  EXPECT_NEAR(c.ratio, c.step / c.size, 1e-12);
  EXPECT_LE(coarsest(with({near, large})).ratio, 4 * eps);
}

TEST(Resolution, NothingIsLeftOfASmallMeshFarAway) {
  const double far = 1e4 / double(std::numeric_limits<Float>::epsilon());
  const Transform place = Transform::translate({far, far, far});
  EXPECT_EQ(coarsest(with({TriangleMesh::box(place)})).ratio, mc::infinity<double>);
}

TEST(Resolution, SufficesForTheGallery) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(MC_SOURCE_DIR "/librender/scenes")) {
    if (entry.path().extension() != ".xml") continue;
    ++scenes;
    EXPECT_LE(coarsest(read_mitsuba(entry.path().string()).scene).ratio, too_coarse) << entry.path();
  }
  EXPECT_GE(scenes, 10);
}

} // namespace
