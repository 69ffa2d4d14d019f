#include <render/io/mitsuba/plugins.h>

#include "render/io/mitsuba/scene_text.h"

namespace {

using render::Dialect, render::Vec3d;
struct ShapePlugins : support::SceneTest {
  render::SceneFile shape(const std::string& type, const std::string& parameters, const std::string& version = "0.6.0",
                          Dialect dialect = Dialect::mitsuba) const {
    const std::string text = fmt::format("<scene version=\"{}\">{}\n<shape type=\"{}\">{}</shape></scene>", version,
                                         sensor, type, parameters);
    return render::read_mitsuba(write("shape.xml", text), dialect);
  }
};

// In Mitsuba 0.6 the scale of toWorld applies to the radius only, in Mitsuba 3 also to the centre. lajolla reads no
// toWorld.
TEST_F(ShapePlugins, ToWorldScalesTheCentreOfASphereSinceMitsuba2) {
  const std::string parameters = R"(<point name="center" x="1" y="2" z="3"/><float name="radius" value="0.5"/>
    <transform name="toWorld"><scale value="4"/><rotate z="1" angle="90"/><translate x="10"/></transform>)";
  const auto sphere = [&](const std::string& version) {
    return std::get<render::Sphere>(*shape("sphere", parameters, version).scene.surfaces()[0].shape);
  };
  for (const char* version : {"0.5.0", "0.6.0"})
    EXPECT_LE((sphere(version).center() - Vec3d(8, 1, 3)).norm(), 1e-12) << version;
  for (const char* version : {"2.0.0", "3.0.0"})
    EXPECT_LE((sphere(version).center() - Vec3d(2, 4, 12)).norm(), 1e-12) << version;
  EXPECT_EQ(sphere("0.6.0").radius(), 2);
  EXPECT_THAT(shape("sphere", parameters).warnings, testing::IsEmpty());
  EXPECT_THAT(shape("sphere", parameters, "0.4.0", Dialect::lajolla).warnings,
              testing::ElementsAre(testing::HasSubstr(
                  "shape.xml:3: <transform>: lajolla leaves a sphere where it is, here toWorld counts")));
}

TEST_F(ShapePlugins, ASphereIsNotFlattened) {
  for (const char* scale : {"value=\"0\"", "x=\"0\"", "y=\"0\"", "z=\"0\""})
    EXPECT_THAT(support::error_of([&] {
                  shape("sphere", "<transform name=\"toWorld\"><scale " + std::string(scale) + "/></transform>");
                }),
                testing::HasSubstr("shape.xml:2: <shape>: toWorld flattens the sphere, or makes a point of it"))
        << scale;
  // A singular matrix without a zero axis.
  const std::string matrix =
      "<transform name=\"toWorld\"><matrix value=\"1 1 0 0 1 1 0 0 0 0 1 0 0 0 0 1\"/></transform>";
  EXPECT_THAT(support::error_of([&] { shape("sphere", matrix); }),
              testing::HasSubstr("shape.xml:2: <shape>: toWorld of a sphere must scale all axes alike"));
  EXPECT_NO_THROW(shape("sphere", "<transform name=\"toWorld\"><scale value=\"1e-15\"/></transform>"));
}

TEST_F(ShapePlugins, ACylinderStaysRound) {
  const std::string ends = R"(<point name="p0" x="1" y="0" z="0"/><point name="p1" x="1" y="2" z="0"/>)";
  const auto cylinder = [&](const std::string& parameters) {
    return std::get<render::Cylinder>(*shape("cylinder", parameters).scene.surfaces()[0].shape);
  };
  const std::string stretched = R"(<float name="radius" value="0.5"/>
<transform name="toWorld"><scale x="3" y="4" z="3"/><rotate x="1" angle="90"/><translate x="1"/></transform>)";
  EXPECT_NEAR(cylinder(ends + stretched).radius(), 1.5, 1e-12);
  EXPECT_NEAR(cylinder(ends + stretched).height(), 8, 1e-12);
  EXPECT_LE((cylinder(ends + stretched).base() - render::Vec3d(4, 0, 0)).norm(), 1e-12);
  EXPECT_LE((cylinder("").frame().z - render::Vec3d::UnitZ()).norm(), 1e-12) << "the unit cylinder of Mitsuba";
  const auto refusal = [&](const std::string& parameters) {
    return support::error_of([&] { shape("cylinder", parameters); });
  };
  EXPECT_THAT(refusal(R"(<transform name="toWorld"><scale x="2"/></transform>)"),
              testing::HasSubstr("shape.xml:2: <shape>: toWorld of a cylinder must keep it round and straight"));
  EXPECT_THAT(refusal(R"(<transform name="toWorld"><matrix value="1 0 1 0 0 1 0 0 0 0 1 0 0 0 0 1"/></transform>)"),
              testing::HasSubstr("toWorld of a cylinder must keep it round and straight"));
  EXPECT_THAT(refusal(R"(<transform name="toWorld"><scale value="0"/></transform>)"),
              testing::HasSubstr("toWorld flattens the cylinder"));
  EXPECT_THAT(refusal(R"(<point name="p1" x="0" y="0" z="0"/>)"), testing::HasSubstr("p0 and p1 must differ"));
  EXPECT_THAT(refusal(R"(<float name="radius" value="0"/>)"), testing::HasSubstr("cylinder: radius 0 must be > 0"));
}

TEST_F(ShapePlugins, ARectangleShinesFromTheOtherSideWhenItsNormalIsFlipped) {
  const std::string mirrored = R"(<transform name="toWorld"><scale x="-1" y="2"/></transform>)";
  for (const std::string& to_world : {std::string(), mirrored})
    for (const bool flipped : {false, true}) {
      const std::string flip = fmt::format("<boolean name=\"flipNormals\" value=\"{}\"/>", flipped);
      const auto file = shape("rectangle", to_world + flip);
      const auto& square = std::get<render::TriangleMesh>(*file.scene.surfaces()[0].shape);
      EXPECT_EQ(square.point(0, 0.2, 0.3).ng, render::Vec3(0, 0, flipped ? -1 : 1)) << to_world;
    }
}

TEST_F(ShapePlugins, ADiskIsTheUnitDiskUnderToWorld) {
  for (const bool flipped : {false, true}) {
    const std::string flip = fmt::format("<boolean name=\"flipNormals\" value=\"{}\"/>", flipped);
    const auto file = shape("disk", R"(<transform name="toWorld"><scale x="3" y="2"/></transform>)" + flip);
    const render::Shape& disk = *file.scene.surfaces()[0].shape;
    EXPECT_NEAR(disk.area(), 6 * 3.14159265358979, 1e-12);
    EXPECT_EQ(disk.sample_area({0.2f, 0.3f})->ng, render::Vec3(0, 0, flipped ? -1 : 1));
  }
}

// The seam is at +x in Mitsuba and at -x in lajolla. The difference is visible for a fractional number of repetitions.
TEST_F(ShapePlugins, TexturesOfSpheresBeginWhereTheDialectsDo) {
  for (const bool is_lajolla : {false, true}) {
    const auto file = shape("sphere", "", "0.6.0", is_lajolla ? Dialect::lajolla : Dialect::mitsuba);
    const render::Shape& ball = *file.scene.surfaces()[0].shape;
    for (double angle = -175; angle < 180; angle += 10) {
      const double x = std::cos(angle * mc::pi<double> / 180), y = std::sin(angle * mc::pi<double> / 180);
      render::SurfacePoint p;
      p.p = (is_lajolla ? Vec3d(x, 0, y) : Vec3d(x, y, 0)).cast<render::Float>();
      EXPECT_NEAR(ball.uv({}, p)[0], (angle < 0 && !is_lajolla ? angle + 360 : angle) / 360, 1e-6) << angle;
    }
  }
}

// Has no effect in the dialect lajolla.
TEST_F(ShapePlugins, MeshesKeepTheirEdgesFromMaxSmoothAngleOn) {
  const std::string box = "v -1 0 0\nv 0 0 0\nv 0 1 0\nv 0 0 -1\nf 1 2 3\nf 2 4 3\n", // two faces at 90 degrees
      name = R"(<string name="filename" value="edge.obj"/>)", angle = R"(<float name="maxSmoothAngle" value="{}"/>)";
  write("edge.obj", box);
  const auto is_flat = [&](const std::string& more, Dialect dialect = Dialect::mitsuba) {
    const auto file = shape("obj", name + more, "0.6.0", dialect);
    const auto point = std::get<render::TriangleMesh>(*file.scene.surfaces()[0].shape).point(0, 1, 0);
    return point.ns == point.ng;
  };
  EXPECT_FALSE(is_flat(""));
  EXPECT_TRUE(is_flat(fmt::format(fmt::runtime(angle), 89)));
  EXPECT_FALSE(is_flat(fmt::format(fmt::runtime(angle), 91)));
  EXPECT_FALSE(is_flat(fmt::format(fmt::runtime(angle), 89), Dialect::lajolla));
  EXPECT_THAT(support::error_of([&] {
                is_flat(fmt::format(fmt::runtime(angle), 89) + R"(<boolean name="faceNormals" value="true"/>)");
              }),
              testing::AllOf(testing::HasSubstr("shape.xml:2: <shape>: "),
                             testing::HasSubstr("edge.obj: faceNormals and maxSmoothAngle contradict each other")));
}

// The corner of the file at v = 1/4 has the v of the parameter.
TEST_F(ShapePlugins, TextureCoordinatesAreFlippedAsTheFileNeedsIt) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.25\nf 1/1 2/1 3/1\n");
  write("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                 "property float u\nproperty float v\nelement face 1\nproperty list uchar int vertex_index\n"
                 "end_header\n0 0 0 0 0.25\n1 0 0 0 0.25\n0 1 0 0 0.25\n3 0 1 2\n");
  const std::string textured = R"(<bsdf type="diffuse"><texture type="checkerboard" name="reflectance"/></bsdf>)";
  const auto v = [&](const std::string& type, const std::string& parameter) {
    const auto file =
        shape(type, "<string name=\"filename\" value=\"a." + type + "\"/>" + parameter + textured, "3.0.0");
    return std::get<render::TriangleMesh>(*file.scene.surfaces()[0].shape).uv({}, render::SurfacePoint())[1];
  };
  const std::string flip = R"(<boolean name="flip_tex_coords" value="true"/>)",
                    keep = R"(<boolean name="flipTexCoords" value="false"/>)";
  EXPECT_NEAR(v("obj", ""), 0.75, 1e-6);
  EXPECT_NEAR(v("obj", flip), 0.75, 1e-6);
  EXPECT_NEAR(v("obj", keep), 0.25, 1e-6);
  EXPECT_NEAR(v("ply", ""), 0.25, 1e-6);
  EXPECT_NEAR(v("ply", keep), 0.25, 1e-6);
  EXPECT_NEAR(v("ply", flip), 0.75, 1e-6);
}

} // namespace
