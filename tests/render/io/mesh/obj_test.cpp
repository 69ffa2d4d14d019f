// The reader of Wavefront OBJ files, see mesh.h.

#include <render/io/mesh/mesh.h>

#include "support/files.h"

namespace {

using namespace render;
using testing::HasSubstr;

struct Obj : support::ScratchTest {
  double area(const std::string& text) const { return to_shape(read_obj(write("area.obj", text)), {}).area(); }
};

TEST_F(Obj, QuadBecomesTwoTriangles) {
  const MeshFile file = read_obj(write("quad.obj", "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nf -4 -3 -2 -1\n"));
  EXPECT_EQ(file.triangles.size(), 2u);
  EXPECT_DOUBLE_EQ(to_shape(file, {}).area(), 6);
}

TEST_F(Obj, LinesGoOnBehindABackslash) {
  const MeshFile file = read_obj(write("c.obj", "v 0 0 0\nv 1 \\\n 0 0\nv 0 \\\r\n1 \\\n0\nf 1 2\\\n 3\n"));
  ASSERT_EQ(file.triangles.size(), 1u);
  EXPECT_EQ(file.positions[1], render::Vec3d(1, 0, 0));
  EXPECT_EQ(file.positions[2], render::Vec3d(0, 1, 0));
  EXPECT_THAT(support::error_of([&] { read_obj(write("d.obj", "v 0 \\\n0 \\\n0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")); }),
              HasSubstr("d.obj: line 6: a face names vertex 9"))
      << "lines keep their numbers";
  const MeshFile comment = read_obj(write("f.obj", "# C:\\models\\\nv 7 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 # \\\n"));
  EXPECT_EQ(comment.positions.front().x(), 7) << "a comment ends with its line";
  EXPECT_EQ(read_obj(write("e.obj", "# C:\\meshes\\e\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n\\")).triangles.size(), 1u);
}

TEST_F(Obj, TextureCoordinatesGoDown) {
  const MeshFile file =
      read_obj(write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 0.75\nf 1/1 2/2 3/3\n"));
  ASSERT_EQ(file.uvs.size(), 3u);
  EXPECT_EQ(file.uvs[0], mc::Vec2<float>(0, 1));
  EXPECT_EQ(file.uvs[2], mc::Vec2<float>(0, 0.25f));
  EXPECT_EQ(file.missing_uv_reason, "");
  // Texture coordinates of only some corners are ignored.
  const MeshFile some =
      read_obj(write("p.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\nf 1/1 2 3\nf 1 2 3\n"));
  EXPECT_TRUE(some.uvs.empty());
  EXPECT_EQ(some.positions.size(), 3u);
  EXPECT_EQ(some.missing_uv_reason, "the face of line 6 has none");
}

TEST_F(Obj, RefusesWithFileAndPlace) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto refusal = [&](const std::string& text) {
    const std::string file = write("bad.obj", text);
    return support::error_of([&] { to_shape(read_obj(file), {}); });
  };
  EXPECT_THAT(support::error_of([&] { read_obj(path("none.obj")); }), HasSubstr("no such file"));
  EXPECT_THAT(refusal(corners + "f 1 2 9\n"),
              HasSubstr("bad.obj: line 4: a face names vertex 9, but there are only 3"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\nf 1 2 3 4\nf 1 2 3 4 5\n"),
              HasSubstr("line 7: a face names vertex 5"));
  EXPECT_THAT(refusal(corners + "vn 0 0 1\nf 1//1 2//1 3//2\n"), HasSubstr("line 5: a face names normal 2"));
  EXPECT_THAT(refusal(corners + "f 1/1 2/1 3/1\n"), HasSubstr("names texture coordinate 1, but there are only 0"));
  EXPECT_THAT(refusal(corners + "f 0 1 2\n"), HasSubstr("line 4: a face names vertex 0"));
  EXPECT_THAT(refusal(corners + "f -4 1 2\n"), HasSubstr("line 4: a face names vertex -4, but only 3 stand above it"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n"),
              HasSubstr("line 3: a face names vertex -3, but only 2 stand above it"));
  EXPECT_THAT(refusal(corners + "f 1 2 x\n"), HasSubstr("line 4: 'x' is not the number of a vertex"));
  EXPECT_THAT(refusal(corners + "f 1 2 99999999999999999999\n"),
              HasSubstr("line 4: a face names vertex 99999999999999999999, but there are only 3"));
  EXPECT_THAT(refusal(corners + "f 1 2 3/1/1/1\n"), HasSubstr("line 4"));
  EXPECT_THAT(refusal(corners + "vt 0 0\nvn 0 0 1\nf 1 2 3/1/1/1\n"),
              HasSubstr("line 6: '3/1/1/1' is no corner of a face; write v, v/vt, v//vn or v/vt/vn"));
  EXPECT_THAT(refusal(corners + "f 1 2 /\n"), HasSubstr("line 4: '' is not the number of a vertex"));
  EXPECT_THAT(refusal(corners + "f 1 2\n"), HasSubstr("line 4: a face of 2 corners"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"),
              HasSubstr("bad.obj: line 2: vertex 2 has y = nan, which is not finite"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 inf\nv 0 1 0\nf 1 2 3\n"), HasSubstr("line 2: vertex 2 has z = inf"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n"),
              HasSubstr("line 2: vertex 2 has no number for y, but 'zero'"));
  EXPECT_THAT(refusal("v 0x1p-1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
              HasSubstr("vertex 1 has no number for x, but '0x1p-1'"));
  EXPECT_THAT(refusal(corners + "vt 0 1e999\nf 1/1 2/1 3/1\n"),
              HasSubstr("texture coordinate 1 has no number for v, but '1e999'"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn\nf 1//1 2//1 3//1\n"),
              HasSubstr("line 4: normal 1 has no number for x"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt nan\nf 1/1 2/1 3/1\n"),
              HasSubstr("line 4: texture coordinate 1 has u = nan, which is not finite"));
  EXPECT_THAT(refusal("v 0 0 0\n"), HasSubstr("no triangle"));
}

// Positions are doubles up to the transform, so positions far from the origin lose no digits.
TEST_F(Obj, PositionsFarAway) {
  const std::string text = "v 4500000.10 0 0\nv 4500000.90 0 0\nv 4500000.90 0.4 0\nv 4500000.10 0.4 0\nf 1 2 3 4\n";
  const MeshFile file = read_obj(write("far.obj", text));
  EXPECT_EQ(file.positions[1].x(), 4500000.90);
  EXPECT_NEAR(to_shape(file, Transform::translate({-4500000.5, 0, 0})).area(), 0.32, 1e-7);
}

// A dart and an L, starting at every corner, in several sizes.
TEST_F(Obj, ConcavePolygons) {
  using Outline = std::vector<std::array<double, 2>>;
  const std::vector<std::pair<Outline, double>> outlines = {{{{0, 0}, {4, 0}, {1, 1}, {0, 4}}, 4},
                                                            {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 3}};
  for (const auto& [outline, area_of_it] : outlines)
    for (const double size : {1e-6, 1.0, 1e6})
      for (std::size_t first = 0; first < outline.size(); ++first) {
        std::string text, face = "f";
        for (std::size_t i = 0; i < outline.size(); ++i) {
          text += fmt::format("v {} 0 {}\n", size * outline[i][0], size * outline[i][1]);
          face += fmt::format(" {}", (first + i) % outline.size() + 1);
        }
        EXPECT_NEAR(area(text + face + "\n") / (size * size), area_of_it, 1e-6) << size << " from " << first;
      }
}

// Trailing slashes, a UTF-8 byte order mark, lines that end in a carriage return, and all kinds of blanks.
TEST_F(Obj, ManyWaysToWriteATriangle) {
  const std::string corners = "v 0 0 0\nv 2 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
  for (const char* face :
       {"f 1// 2// 3//\n", "f 1/ 2/ 3/", "f 1/1/ 2/1/ 3/1/\n", "f 1//1 2//1 3//1 # all", "f\t1 2   3 \n"})
    EXPECT_EQ(area(corners + face), 1) << face;
  EXPECT_EQ(area("\xEF\xBB\xBF" + corners + "f 1 2 3"), 1);
  std::string with_returns = corners + "f 1 \\\n2 3\n";
  std::replace(with_returns.begin(), with_returns.end(), '\n', '\r');
  EXPECT_EQ(area(with_returns), 1);
  EXPECT_EQ(area("f 1 2 3\n" + corners), 1) << "vertices may follow";
}

// The first triangle has tilted normals; the second has no normal at one of its corners.
TEST_F(Obj, FacesWithoutNormalsAreFlat) {
  const MeshFile file =
      read_obj(write("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 1 0 1\nf 1//1 2//1 3//1\nf 2//1 4 3//1\n"));
  EXPECT_EQ(file.positions.size(), 6u);
  const TriangleMesh mesh = to_shape(file, {});
  EXPECT_LE((mesh.point(0, 0.3, 0.3).ns - Vec3(1, 0, 1).normalized()).norm(), 1e-6);
  EXPECT_EQ(mesh.point(1, 0.3, 0.3).ns, Vec3(0, 0, 1));
}

// Two squares with a common edge and without normals are smooth, unless a group or a material begins between them.
TEST_F(Obj, GroupsAreNotSmoothedTogether) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\n";
  for (const std::string word : {"", "o part\n", "g side\n", "usemtl red\n"}) {
    std::string text = corners;
    for (const std::string& line : {std::string("f 1 2 3 4\n"), word, std::string("f 2 5 6 3\n")}) text += line;
    const MeshFile file = read_obj(write("s.obj", text));
    const bool is_split = word[0] == 'g' || word[0] == 'u';
    EXPECT_EQ(file.positions.size(), is_split ? 8u : 6u) << word;
    const Vec3 at_edge = to_shape(file, {}).point(0, 1, 0).ns;
    EXPECT_LE((at_edge - (is_split ? Vec3(0, 0, 1) : Vec3(Vec3(1, 0, 1).normalized()))).norm(), 1e-6) << word;
  }
}

} // namespace
