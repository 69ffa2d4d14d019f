#include <render/io/mitsuba/file_resolver.h>

#include "render/io/mitsuba/scene_text.h"

#include <fmt/format.h>

#include <filesystem>

namespace {

using testing::HasSubstr;
struct SceneFileResolver : support::SceneTest {};

TEST_F(SceneFileResolver, SearchesFoldersLastToFirst) {
  std::filesystem::create_directory(path("a"));
  std::filesystem::create_directory(path("b"));
  // The width of a triangle is the number of its file.
  const auto write_mesh = [&](const std::string& name, int width) {
    write(name, fmt::format("v 0 0 0\nv {} 0 0\nv 0 1 0\nf 1 2 3\n", width));
  };
  write_mesh("own.obj", 1);
  write_mesh("a/mesh.obj", 2);
  write_mesh("b/mesh.obj", 3);
  const auto width = [&](const std::string& paths, const std::string& name) {
    const std::string shape = R"(<shape type="obj"><string name="filename" value=")" + name + R"("/></shape>)";
    return render::read_mitsuba(scene(sensor + paths + shape)).scene.bounds().hi.x();
  };
  const std::string a = "<path value=\"a\"/>", b = "<path value=\"b\"/>";
  EXPECT_EQ(width(a, "own.obj"), 1);
  EXPECT_EQ(width(a, "mesh.obj"), 2);
  EXPECT_EQ(width(a + b, "mesh.obj"), 3) << "the last one first";
  EXPECT_EQ(width(b + a, "mesh.obj"), 2);
  EXPECT_THAT(refusal(std::string(sensor) + "\n<path value=\"c\"/>"),
              HasSubstr("s.xml:3: <path>: there is no folder '"));
}

TEST_F(SceneFileResolver, ReadsIncludedScenes) {
  std::filesystem::create_directory(path("parts"));
  write("parts/shapes.xml",
        "<scene><shape type=\"cube\"><ref id=\"$what\"/></shape>\n<include filename=\"more.xml\"/></scene>");
  write("more.xml", R"(<scene><bsdf type="diffuse" id="white"/></scene>)");
  const std::string body = std::string(sensor) + R"(<path value="parts"/><default name="what" value="white"/>)";
  const auto file = render::read_mitsuba(scene(body + R"(<include filename="shapes.xml"/> <shape type="sphere"/>)"));
  EXPECT_EQ(file.scene.surfaces().size(), 2u);
  write("more.xml", "<scene>\n<bsdf type=\"difuse\" id=\"white\"/></scene>");
  EXPECT_THAT(refusal(body + "<include filename=\"shapes.xml\"/>"),
              HasSubstr("more.xml:2: <bsdf>: unknown type 'difuse'"))
      << "the file that is wrong";
  write("more.xml", "<scene><include filename=\"more.xml\"/></scene>");
  EXPECT_THAT(refusal(body + "<include filename=\"shapes.xml\"/>"),
              HasSubstr("more.xml:1: <include>: includes are nested more than 16 deep"));
  write("many0.xml", "<scene/>");
  for (int i = 1; i < 5; ++i) {
    std::string eight;
    for (int k = 0; k < 8; ++k) eight += fmt::format("<include filename=\"many{}.xml\"/>", i - 1);
    write(fmt::format("many{}.xml", i), "<scene>" + eight + "</scene>");
  }
  EXPECT_THAT(refusal(std::string(sensor) + "<include filename=\"many4.xml\"/>"),
              HasSubstr("<include>: more than 1000 files are included"));
  EXPECT_THAT(refusal(std::string(sensor) + "\n<include filename=\"none.xml\"/>"), HasSubstr("s.xml:3: cannot read '"));
  EXPECT_THAT(refusal("<include filename=\"more.xml\" if=\"1\"/>"),
              HasSubstr("s.xml:2: <include>: attribute if=\"1\" is not"));
  write("more.xml", "<scene author=\"me\"/>");
  EXPECT_THAT(refusal("<include filename=\"more.xml\"/>"), HasSubstr("more.xml:1: <scene>: attribute author=\"me\""));
  write("more.xml", "<scene version=\"0.5.0\"/>");
  EXPECT_THAT(refusal("<include filename=\"more.xml\"/>"), HasSubstr("no <sensor>")) << "means the same";
  write("more.xml", "<scene version=\"3.0.0\"/>");
  EXPECT_THAT(refusal("<include filename=\"more.xml\"/>"),
              HasSubstr("more.xml:1: <scene>: version \"3.0.0\" beside \"0.6.0\" of '"));
  write("more.xml", "<shape type=\"cube\"/>");
  EXPECT_THAT(refusal("<include filename=\"more.xml\"/>"),
              HasSubstr("more.xml:1: <shape>: the document must be a <scene>"));
}

} // namespace
