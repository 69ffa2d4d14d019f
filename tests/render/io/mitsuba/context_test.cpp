#include <render/io/mitsuba/context.h>

#include "render/io/mitsuba/scene_text.h"

#include <fmt/format.h>

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

TEST_F(SceneContext, SpectraOfWhatReflectsAreSeenInTheLightOfTheVersion) {
  const auto said = [&](const std::string& version, render::Dialect dialect) {
    const std::string file = write("v.xml", "<scene version=\"" + version + "\">" + sensor + R"(<shape type="cube"><bsdf
      type="diffuse"><spectrum name="reflectance" value="400:1, 700:1"/></bsdf></shape></scene>)");
    return support::error_of([&] { render::read_mitsuba(file, dialect); });
  };
  using enum render::Dialect;
  EXPECT_THAT(said("0.6.0", mitsuba), HasSubstr("(1.1992")) << "warm, and more than there is";
  EXPECT_THAT(said("3.0.0", lajolla), HasSubstr("(1.1992"));
  for (const char* version : {"2.0.0", "2.1", "3"}) EXPECT_EQ(said(version, mitsuba), "") << version;
}

TEST_F(SceneContext, VersionsAreThoseOfMitsuba) {
  const auto is_late = [&](const std::string& attribute) {
    return render::mitsuba::is_mitsuba_2_scene(render::read_xml(write("v.xml", "<scene" + attribute + "/>")));
  };
  EXPECT_FALSE(is_late(""));
  for (const char* old : {"0.4", "0.4.0", "0.5.0", "0.6.0", "0.6.10"})
    EXPECT_FALSE(is_late(fmt::format(" version=\"{}\"", old))) << old;
  for (const char* late : {"2", "2.2.1", "3.0", "3.7.1"})
    EXPECT_TRUE(is_late(fmt::format(" version=\"{}\"", late))) << late;
  for (const char* odd :
       {"", "banana", "-1", "99.9.9", "0", "0.3.0", "0.61", "1.0.0", "3.", "3.0.", "3.0.0 ", "30", "3x"})
    EXPECT_THAT(
        support::error_of([&] { render::read_mitsuba(write("v.xml", fmt::format("\n<scene version=\"{}\"/>", odd))); }),
        HasSubstr(fmt::format("v.xml:2: <scene>: version \"{}\" is not known; say 0.6.0", odd)));
}

TEST_F(SceneContext, ReferencesStandForPluginsOfEveryKind) {
  const std::string
      lamp = R"(<emitter type="area" id="lamp"><rgb name="radiance" value="3, 2, 1"/></emitter>)",
      fog = R"(<medium type="homogeneous" id="fog"><rgb name="sigmaA" value="1"/></medium>)",
      film = R"(<film type="hdrfilm" id="film"><integer name="width" value="7"/><ref id="filter"/></film>)",
      filter = R"(<rfilter type="box" id="filter"/>)",
      sampler = R"(<sampler type="independent" id="many"><integer name="sampleCount" value="9"/></sampler>)",
      use = R"(<sensor type="perspective"><float name="fov" value="40"/><ref id="many"/><ref id="film"/></sensor>
      <shape type="sphere"><ref id="lamp"/><ref name="interior" id="fog"/></shape>)";
  const auto check = [&](const std::string& body) {
    const auto file = render::read_mitsuba(scene(body));
    ASSERT_EQ(file.scene.lights().size(), 1u) << body;
    EXPECT_EQ(file.light_names.size(), 1u);
    const auto& light = std::get<render::AreaLight>(file.scene.lights()[0]);
    EXPECT_TRUE(light.radiance().isApprox(render::Spectrum(3, 2, 1))) << body;
    EXPECT_EQ(file.defaults.width, 7) << body;
    EXPECT_EQ(file.defaults.spp, 9) << body;
    EXPECT_TRUE(std::holds_alternative<render::BoxFilter>(file.scene.filter())) << body;
    EXPECT_TRUE(file.scene.surfaces()[0].interior) << body;
    EXPECT_THAT(file.warnings, testing::IsEmpty()) << body;
  };
  check(lamp + fog + filter + film + sampler + use);
  check(use + sampler + film + filter + fog + lamp);
  EXPECT_THAT(render::read_mitsuba(scene(std::string(sensor) + "<shape type=\"cube\"/>" + lamp)).warnings,
              testing::ElementsAre(HasSubstr("s.xml:2: <emitter>: no <ref> in a <shape> names its id")));
}

TEST_F(SceneContext, BadReferences) {
  const std::string start = std::string(sensor) + "\n";
  EXPECT_THAT(
      refusal(start + "<shape type=\"sphere\"><ref id=\"whte\"/></shape>\n<bsdf type=\"diffuse\" id=\"white\"/>"),
      HasSubstr("s.xml:3: <ref>: no <bsdf> or <emitter> or <medium> has the id 'whte'; did you mean 'white'?"));
  EXPECT_THAT(
      refusal(start + "<shape type=\"sphere\" id=\"s\"><ref id=\"s\"/></shape>"),
      HasSubstr("s.xml:3: <ref>: 's' is the <shape> of line 3; a <ref> stands here for a <bsdf> or <emitter> or "
                "<medium> alone"));
  EXPECT_THAT(
      refusal(start + R"(<emitter type="constant" id="lamp"/> <bsdf type="twosided" id="b"><ref id="lamp"/></bsdf>)"),
      HasSubstr("s.xml:3: <ref>: 'lamp' is the <emitter> of line 3; a <ref> stands here for a <bsdf> alone"));
  EXPECT_THAT(refusal(start + R"(<emitter type="constant" id="lamp"/> <shape type="cube"><ref id="lamp"/></shape>)"),
              HasSubstr("s.xml:3: <emitter>: unknown type 'constant'; use one of area"));
  EXPECT_THAT(refusal(start + R"(<shape type="cube"><ref id="lamp"/>
      <emitter type="area" id="lamp"><rgb name="radiance" value="1"/></emitter></shape>)"),
              HasSubstr("s.xml:4: <emitter>: a second <emitter>, after line 3; only one is allowed here"));
  EXPECT_THAT(refusal(start + "<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>"),
              HasSubstr("s.xml:4: <bsdf>: a second element with the id 'a', after line 3; ids must differ"));
  EXPECT_THAT(refusal(start + "<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf>\n<bsdf type=\"twosided\" "
                              "id=\"b\"><ref id=\"a\"/></bsdf>"),
              HasSubstr("s.xml:4: <ref>: 'a' leads back to the <bsdf> of line 3"));
  std::string chain;
  for (int i = 0; i < 10000; ++i)
    chain += fmt::format("<bsdf type=\"twosided\" id=\"b{}\"><ref id=\"b{}\"/></bsdf>", i, i + 1);
  EXPECT_THAT(refusal(start + chain + "<bsdf type=\"diffuse\" id=\"b10000\"/>"),
              HasSubstr("s.xml:3: <ref>: references to <bsdf>s stand in one another more than 256 deep"));
  EXPECT_THAT(refusal(start + "<bsdf type=\"diffuse\"/>"), HasSubstr("s.xml:3: <bsdf>: attribute 'id' is missing"));
}

} // namespace
