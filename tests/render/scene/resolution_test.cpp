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

TEST(Resolution, IsThatOfCoarsestShape) {
  EXPECT_EQ(coarsest_resolution(with({})).ratio, 0);
  const double eps = double(std::numeric_limits<Float>::epsilon());
  const Shape near = Sphere(Vec3d(1, 2, 3), 0.5), far = Sphere(Vec3d(0, -1023.5, 0), 0.25),
              large = TriangleMesh::rectangle(Transform::scale({1e6, 1e6, 1}));
  const FloatResolution c = coarsest_resolution(with({near, far, large}));
  EXPECT_NEAR(c.size, 0.5 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(c.distance, 1023.75, 1e-12);
  EXPECT_NEAR(c.step, 512 * eps, 1e-12);
  EXPECT_NEAR(c.ratio, c.step / c.size, 1e-12);
  EXPECT_LE(coarsest_resolution(with({near, large})).ratio, 4 * eps);
}

TEST(Resolution, SmallFarMesh_HasNoResolution) {
  const double far = 1e4 / double(std::numeric_limits<Float>::epsilon());
  const Transform place = Transform::translate({far, far, far});
  EXPECT_EQ(coarsest_resolution(with({TriangleMesh::box(place)})).ratio, mc::infinity<double>);
}

TEST(Resolution, NamesLengthsWhoseSquaresNoFloatHolds) {
  const auto ball = [](double radius) { return Shape(Sphere(Vec3d(0, 0, 0), radius)); };
  EXPECT_FALSE(length_out_of_range(with({})));
  for (const double radius : {0.1 * min_length, 1.0, 0.25 * max_length})
    EXPECT_FALSE(length_out_of_range(with({ball(radius)}))) << radius;
  EXPECT_NEAR(length_out_of_range(with({ball(2 * max_length)})).value_or(0) / (4 * std::sqrt(3.0) * max_length), 1,
              1e-6);
  SceneBuilder builder;
  const BsdfId gray = builder.add(Lambert());
  builder.add(ball(1), {gray});
  builder.add(ball(0.1 * min_length), {gray, Emission()});
  EXPECT_NEAR(length_out_of_range(builder.build()).value_or(0) / (0.2 * std::sqrt(3.0) * min_length), 1, 1e-6);
}

TEST(Resolution, SufficesForTheGallery) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(MC_SOURCE_DIR "/librender/scenes")) {
    if (entry.path().extension() != ".xml") continue;
    ++scenes;
    const Scene scene = read_mitsuba(entry.path().string()).scene;
    EXPECT_LE(coarsest_resolution(scene).ratio, max_resolution_ratio) << entry.path();
    EXPECT_FALSE(length_out_of_range(scene)) << entry.path();
  }
  EXPECT_GE(scenes, 10);
}

} // namespace
