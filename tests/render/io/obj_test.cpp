#include <render/io/obj.h>

#include "support/files.h"

namespace {

struct Obj : support::ScratchTest {
  std::string refusal(const std::string& text) const {
    const std::string file = write("bad.obj", text);
    return support::error_of([&] { render::read_obj(file, render::Transform{}); });
  }
};

TEST_F(Obj, QuadBecomesTwoTriangles) {
  const auto mesh =
      render::read_obj(write("quad.obj", "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nf 1 2 3 4\n"), render::Transform{});
  EXPECT_EQ(mesh.size(), 2u);
  EXPECT_DOUBLE_EQ(mesh.area(), 6);
}

TEST_F(Obj, TransformAndNegativeIndices) {
  // Mirrors: the winding is turned so that the normal stays on its side.
  const render::Transform t = render::Transform::translate({0, 0, 5}) * render::Transform::scale({-2, 1, 1});
  const auto mesh = render::read_obj(write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n"), t);
  EXPECT_DOUBLE_EQ(mesh.area(), 1);
  const auto v = mesh.vertices(0);
  EXPECT_EQ(v[0].z(), 5);
  EXPECT_GT(mc::cross<render::Float>(v[1] - v[0], v[2] - v[0]).z(), 0);
}

TEST_F(Obj, RefusesWithFileAndPlace) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_THAT(support::error_of([&] { render::read_obj(path("none.obj"), render::Transform{}); }),
              testing::HasSubstr("no such file"));
  EXPECT_THAT(refusal(corners + "f 1 2 9\n"),
              testing::HasSubstr("bad.obj: line 4: a face names vertex 9, but there are only 3"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\nf 1 2 3 4\nf 1 2 3 4 5\n"),
              testing::HasSubstr("line 7: a face names vertex 5"));
  EXPECT_THAT(refusal(corners + "vn 0 0 1\nf 1//1 2//1 3//2\n"), testing::HasSubstr("line 5: a face names normal 2"));
  EXPECT_THAT(refusal(corners + "f 1/1 2/1 3/1\n"),
              testing::HasSubstr("names texture coordinate 1, but there are only 0"));
  EXPECT_THAT(refusal(corners + "f 0 1 2\n"), testing::HasSubstr("line 4: a face names vertex 0"));
  EXPECT_THAT(refusal(corners + "f 1 2 x\n"), testing::HasSubstr("line 4: 'x' is not the number of a vertex"));
  EXPECT_THAT(refusal(corners + "f 1 2 3/1/1/1\n"), testing::HasSubstr("line 4"));
  EXPECT_THAT(refusal(corners + "f 1 2\n"), testing::HasSubstr("line 4: a face of 2 corners"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"),
              testing::HasSubstr("bad.obj: line 2: vertex 2 has y = nan, which is not finite"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 inf\nv 0 1 0\nf 1 2 3\n"), testing::HasSubstr("line 2: vertex 2 has z = inf"));
  EXPECT_THAT(refusal("v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n"),
              testing::HasSubstr("line 2: vertex 2 has no number for y"));
  EXPECT_THAT(refusal("v 0 0 0\n"), testing::HasSubstr("no triangle"));
}

} // namespace
