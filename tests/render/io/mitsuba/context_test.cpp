#include <render/io/mitsuba/context.h>

#include "render/io/mitsuba/scene_text.h"

namespace {

using testing::HasSubstr;
struct SceneContext : support::SceneTest {};

TEST_F(SceneContext, ReferencesMayStandBeforeWhatTheyName) {
  const auto file = render::read_mitsuba(scene(std::string(sensor) + R"(
    <shape type="sphere"><ref id="b"/></shape> <shape type="sphere"><ref name="bsdf" id="b"/></shape>
    <bsdf type="twosided" id="b"><ref id="c"/></bsdf> <bsdf type="diffuse" id="c"/>
    <shape type="cube"/> <shape type="cube"/>)"));
  const auto surfaces = file.scene.surfaces();
  ASSERT_EQ(surfaces.size(), 4u);
  EXPECT_EQ(surfaces[0].bsdf, surfaces[1].bsdf) << "read once, used twice";
  EXPECT_EQ(surfaces[2].bsdf, surfaces[3].bsdf) << "the default too";
}

TEST_F(SceneContext, BadReferences) {
  const std::string start = std::string(sensor) + "\n";
  EXPECT_THAT(
      refusal(start + "<shape type=\"sphere\"><ref id=\"whte\"/></shape>\n<bsdf type=\"diffuse\" id=\"white\"/>"),
      HasSubstr("s.xml:3: <ref>: no <bsdf> has the id 'whte'; did you mean 'white'?"));
  EXPECT_THAT(refusal(start + "<shape type=\"sphere\" id=\"s\"><ref id=\"s\"/></shape>"),
              HasSubstr("no <bsdf> has the id 's'"));
  EXPECT_THAT(refusal(start + "<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>"),
              HasSubstr("s.xml:4: <bsdf>: a second element with the id 'a', after line 3; ids must differ"));
  EXPECT_THAT(refusal(start + "<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf>\n<bsdf type=\"twosided\" "
                              "id=\"b\"><ref id=\"a\"/></bsdf>"),
              HasSubstr("s.xml:4: <ref>: it leads back to the <bsdf> of line 3"));
  EXPECT_THAT(refusal(start + "<bsdf type=\"diffuse\"/>"), HasSubstr("s.xml:3: <bsdf>: attribute 'id' is missing"));
}

} // namespace
