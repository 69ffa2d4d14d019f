#include <render/io/mesh/mesh_scene.h>

#include <render/io/image/image_io.h>
#include <render/render.h>

#include <support/files.h>

#include <mc/random/pcg.h>

#include <gmock/gmock.h>

namespace {

using namespace render;
using testing::HasSubstr;

struct MeshScene : support::ScratchTest {
  // Triangles between random corners in a box with random sides, of given size, near or far from the origin.
  std::string random_obj(mc::Pcg& random, double size, double distance) const {
    const Vec3d sides(random.uniform<double>(), random.uniform<double>(), random.uniform<double>());
    std::string text;
    const int corners = 3 + static_cast<int>(20 * random.uniform<double>());
    for (int i = 0; i < corners; ++i) {
      text += "v";
      for (int k = 0; k < 3; ++k)
        text += fmt::format(" {:.17g}", size * (sides[k] * random.uniform<double>() + distance * (k == 1 ? -1 : 1)));
      text += "\n";
    }
    for (int i = 3; i <= corners; ++i) text += fmt::format("f 1 {} {}\n", i - 1, i);
    return write("random.obj", text + "v 1e30 1e30 1e30\n"); // no triangle uses this vertex
  }
};

TEST_F(MeshScene, ExtensionsInLargeLetters) {
  EXPECT_TRUE(is_mesh_file("a/CUBE.OBJ") && is_mesh_file("a.Ply") && !is_mesh_file("obj"));
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_EQ(read_mesh_scene(write("CUBE.OBJ", triangle)).scene.surfaces().size(), 2u);
}

// Random shapes of size 1e-12 to 1e12, up to 1000 times their size from the origin. All corners are in the image at any
// aspect ratio and above the ground, and one lies close to an edge of a square image.
TEST_F(MeshScene, TheCameraSeesAllOfIt) {
  mc::Pcg random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const double size = std::pow(10, 24 * random.uniform<double>() - 12), distance = trial % 2 ? 1000 : 0;
    const SceneFile file = read_mesh_scene(random_obj(random, size, distance));
    const ThinLens& camera = file.scene.camera();
    const auto& mesh = std::get<TriangleMesh>(*file.scene.surfaces()[0].shape);
    const Bounds ground = std::get<TriangleMesh>(*file.scene.surfaces()[1].shape).bounds();
    Float widest = 0;
    for (std::size_t i = 0; i < mesh.size(); ++i)
      for (const Vec3& corner : mesh.vertices(i)) {
        const Vec3 d = corner - camera.origin();
        const Float depth = d.dot(camera.forward()), x = std::abs(d.dot(camera.right())) / depth,
                    y = std::abs(d.dot(camera.up())) / depth;
        ASSERT_GT(depth, 0) << trial;
        for (const Float aspect : {Float(0.1), Float(1), Float(4) / 3, Float(8)}) {
          const Vec2 tan_half = camera.tan_half(aspect);
          ASSERT_LT(x, tan_half[0]) << trial;
          ASSERT_LT(y, tan_half[1]) << trial;
        }
        widest = std::max({widest, x / camera.tan_half(1)[0], y / camera.tan_half(1)[1]});
        ASSERT_GT(corner.y(), ground.hi.y()) << trial;
      }
    EXPECT_GT(widest, 0.6) << trial;
  }
}

TEST_F(MeshScene, IsLitAndOfEveryFormat) {
  for (const std::string name : {"cbox_smallbox.obj", "torus.ply", "knot.serialized"}) {
    EXPECT_TRUE(is_mesh_file(name));
    const SceneFile file = read_mesh_scene(MC_SOURCE_DIR "/librender/scenes/meshes/" + name);
    RenderOptions options;
    options.width = options.height = 24;
    options.spp = 16;
    const RenderResult result = render::render(file.scene, options);
    EXPECT_EQ(result.invalid, 0u);
    // The middle shows the mesh, or the scene through it, with at most six tenths of the light of the sky.
    const Spectrum middle = result.image.at(12, 12);
    EXPECT_TRUE((middle > Float(0.05)).all() && (middle < Float(0.62)).all()) << name;
    EXPECT_GT(result.image.at(12, 0)[2], Float(0.62)) << name << ": above it is the sky";
  }
  EXPECT_FALSE(is_mesh_file("cbox.xml"));
}

TEST_F(MeshScene, RefusesWhatCannotBeSeen) {
  EXPECT_THAT(support::error_of([&] { read_mesh_scene(path("none.obj")); }), HasSubstr("none.obj"));
  const std::string line = write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  EXPECT_THAT(support::error_of([&] { read_mesh_scene(line); }),
              testing::AllOf(HasSubstr("line.obj"), HasSubstr("none of its 1 triangles has an area")));
  const std::string huge = write("huge.obj", "v 0 0 0\nv 1e38 0 0\nv 0 1e38 0\nf 1 2 3\n");
  EXPECT_THAT(support::error_of([&] { read_mesh_scene(huge); }),
              HasSubstr("huge.obj: the mesh reaches 7.07e+37 from its middle, more than 1e+30; scale it down"));
  const std::string empty = write("empty.obj", "v 0 0 0\n");
  EXPECT_THAT(support::error_of([&] { read_mesh_scene(empty); }), HasSubstr("empty.obj: no triangle; at least one"));
}

// Five triangles of five materials, and one without.
TEST_F(MeshScene, ObjHasItsMaterials) {
  write("my colours.mtl",
        "newmtl red\nKd 0.8 0.1 0.1\nnewmtl coat\nKd 0.2 0.2 0.2\nKs 1 1 1\nNs 98\n"
        "newmtl glass\nillum 7\nNi 1.3\nnewmtl lamp\nKd 0 0 0\nKe 3 2 1\nnewmtl veil\nillum 4\nNi 1\nd 0.25\n");
  std::string text = "mtllib my colours.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n";
  for (const char* name : {"red", "coat", "glass", "lamp", "veil", "red"})
    text += fmt::format("usemtl {}\nf 1 2 4\n", name);
  const SceneFile file = read_mesh_scene(write("a.obj", text));
  EXPECT_THAT(file.warnings, testing::IsEmpty());
  EXPECT_EQ(file.files.size(), 2u);
  ASSERT_EQ(file.scene.surfaces().size(), 7u); // with the ground
  const auto bsdf = [&](std::size_t i) { return file.scene.bsdf(file.scene.surfaces()[i]); };
  EXPECT_NEAR(bsdf(0).albedo(Vec3::UnitZ()), 0.6, 1e-6);
  EXPECT_EQ(std::get<TriangleMesh>(*file.scene.surfaces()[1].shape).size(), 2u);
  EXPECT_NEAR(std::get<Lambert>(bsdf(1)).albedo()[0], 0.8, 1e-6);
  EXPECT_TRUE(std::holds_alternative<RoughPlastic<LayeredBase>>(bsdf(2)));
  const Vec3 up = Vec3::UnitZ();
  EXPECT_NEAR(bsdf(2).eval(up, up)[0],
              RoughPlastic(Float(1.5), std::sqrt(Float(0.02)), Spectrum::Constant(Float(0.2)), Spectrum::Ones())
                  .eval(up, up)[0],
              1e-3);
  EXPECT_EQ(std::get<Dielectric>(bsdf(3)).eta(up, -up), Dielectric(Float(1.3)).eta(up, -up));
  ASSERT_EQ(file.scene.lights().size(), 2u); // with the sky
  EXPECT_EQ(*file.scene.surfaces()[4].light, 0u);
  EXPECT_TRUE(file.scene.has_masks());
}

TEST_F(MeshScene, MaterialsMayHavePictures) {
  Image picture(1, 1);
  picture.at(0, 0) = Spectrum(Float(0.25), Float(0.5), 1);
  write_image(path("p.pfm"), picture);
  write("m.mtl", "newmtl a\nmap_Kd -s 1 1 1 p.pfm\nnewmtl b\nmap_Kd q.png\n");
  const std::string vertices = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
  const SceneFile file = read_mesh_scene(write("a.obj", vertices + "usemtl a\nf 1/1 2/1 3/1\n"));
  const Ray ray{Vec3(0, 0, 1), Vec3(0, 0, -1)};
  const auto hit = file.scene.intersect(ray);
  ASSERT_TRUE(hit);
  std::optional<Bsdf> storage;
  const auto& bsdf = file.scene.bsdf(file.scene.surface(*hit), *hit, file.scene.surface_point(ray, *hit), storage);
  EXPECT_EQ(std::get<Lambert>(bsdf).albedo()[1], Float(0.5));
  EXPECT_THAT(
      read_mesh_scene(write("b.obj", vertices + "usemtl a\nf 1 2 3\n")).warnings,
      testing::ElementsAre(HasSubstr("map_Kd p.pfm needs texture coordinates, but the face of line 7 has none")));
  EXPECT_THAT(read_mesh_scene(write("c.obj", vertices + "usemtl b\nf 1/1 2/1 3/1\n")).warnings,
              testing::ElementsAre(HasSubstr("c.obj: map_Kd q.png: no such file")));
  EXPECT_THAT(read_mesh_scene(write("d.obj", "mtllib x.mtl\n" + vertices + "usemtl z\nf 1 2 3\n")).warnings,
              testing::ElementsAre(HasSubstr("d.obj: mtllib x.mtl: no such file")));
}

} // namespace
