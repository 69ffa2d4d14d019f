#include <render/io/mitsuba/mitsuba.h>

#include <render/io/image/image_io.h>
#include <render/render.h>

#include "render/io/mitsuba/scene_text.h"

namespace {

struct Mitsuba : support::SceneTest {};

std::string gallery(const std::string& name) { return std::string(MC_SOURCE_DIR) + "/librender/scenes/" + name; }

TEST_F(Mitsuba, ReadsTheCornellBoxAsItIs) {
  const auto [scene, defaults, origin, warnings, files, surface_names, light_names] =
      render::read_mitsuba(gallery("cbox.xml"));
  EXPECT_TRUE(origin.isZero());
  EXPECT_EQ(scene.surfaces().size(), 8u);
  ASSERT_EQ(scene.lights().size(), 1u);
  const render::Shape& light = std::get<render::AreaLight>(scene.lights()[0]).shape();
  EXPECT_NEAR(light.area(), 130 * 105, 1);
  EXPECT_EQ(defaults.width, 512);
  EXPECT_EQ(defaults.spp, 4);
  EXPECT_EQ(defaults.max_depth, -1);
  EXPECT_TRUE(std::holds_alternative<render::GaussianFilter>(scene.filter()));
  EXPECT_NEAR(scene.camera().forward().z(), 1, 1e-6);
  EXPECT_NEAR(scene.camera().right().x(), -1, 1e-6);
  // The light emits downward, into the room.
  EXPECT_LT(light.sample(render::Vec3(278, 0, 280), render::Vec2(0.3f, 0.6f))->point.ng.y(), -0.99);
}

TEST_F(Mitsuba, EveryGallerySceneLoadsAndRenders) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(gallery(""))) {
    if (entry.path().extension() != ".xml") continue;
    ++scenes;
    const auto [scene, defaults, origin, warnings, files, surface_names, light_names] =
        render::read_mitsuba(entry.path().string());
    EXPECT_THAT(warnings, testing::IsEmpty()) << "ours say what they mean";
    render::RenderOptions options;
    options.aov = defaults.aov;
    options.width = 24;
    options.height = 18;
    options.spp = 8;
    const auto result = render::render(scene, options);
    EXPECT_EQ(result.invalid, 0u) << entry.path();
    double sum = 0;
    for (const auto& p : result.image.pixels) sum += p.sum();
    EXPECT_GT(sum, 0) << entry.path();
  }
  EXPECT_GE(scenes, 12);
}

TEST_F(Mitsuba, NamesFileLineAndRemedy) {
  EXPECT_THAT(support::error_of([&] { render::read_mitsuba(path("none.xml")); }),
              testing::HasSubstr("none.xml': no such file"));
  EXPECT_THAT(support::error_of([&] { render::read_mitsuba(write("b.xml", "<scene>\n<shape\n</scene>")); }),
              testing::HasSubstr("b.xml:"));
  EXPECT_THAT(refusal(""), testing::HasSubstr("no <sensor>"));
  EXPECT_THAT(refusal(sensor), testing::HasSubstr("neither a shape nor a background"));
  EXPECT_THAT(refusal(std::string(sensor) + "\n<shape type=\"spere\"/>"),
              testing::HasSubstr("s.xml:3: <shape>: unknown type 'spere'; did you mean 'sphere'?"));
  EXPECT_THAT(refusal(std::string(sensor) + "\n<shape type=\"hair\"/>"),
              testing::HasSubstr("s.xml:3: <shape>: type 'hair': curves are not supported; convert them to a mesh"));
  const std::string flattened = "<transform name=\"toWorld\"><scale x=\"0\"/></transform></shape>";
  EXPECT_THAT(refusal(std::string(sensor) + "\n<shape type=\"rectangle\">" + flattened),
              testing::HasSubstr("s.xml:3: <shape>: toWorld makes a line of the square"));
  EXPECT_THAT(refusal(std::string(sensor) + "\n<shape type=\"cube\">" + flattened),
              testing::HasSubstr("s.xml:3: <shape>: toWorld flattens the cube"));
  EXPECT_THAT(refusal(std::string(sensor) + "\n<bsdf type=\"difuse\" id=\"a\"/>"),
              testing::HasSubstr("did you mean 'diffuse'?"));
  EXPECT_THAT(refusal(std::string(sensor) + "\n<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>"),
              testing::HasSubstr("s.xml:4: <bsdf>: a second element with the id 'a'"));
  EXPECT_THAT(
      refusal(std::string(sensor) + "\n<emitter type=\"area\"/>"),
      testing::HasSubstr("s.xml:3: <emitter>: an area shines only as part of a <shape>; put it into one, or give it "
                         "an id for a <ref>"));
  EXPECT_THAT(refusal(std::string(sensor) + "<bsdf type=\"diffuse\" id=\"a\"/>\n<alias id=\"a\" as=\"b\"/>"),
              testing::HasSubstr("s.xml:3: <alias>: unknown element; use default"));
  EXPECT_THAT(refusal(std::string(sensor) + "\n<volume/>"), testing::HasSubstr("s.xml:3: <volume>: unknown element"));
  EXPECT_THAT(refusal(std::string(sensor) + "\n<shape type=\"sphere\"><float name=\"radius\" value=\"one\"/></shape>"),
              testing::HasSubstr("s.xml:3: <float>: 'one' is not a finite number"));
  EXPECT_THAT(refusal(std::string(sensor) + "\n<shape type=\"sphere\"><float name=\"radius\" value=\"-1\"/></shape>"),
              testing::HasSubstr("s.xml:3: <shape>: sphere: radius -1 must be finite and > 0"));
  EXPECT_THAT(
      refusal(std::string(sensor) + "\n<shape type=\"sphere\"><float name=\"radus\" value=\"1\"/></shape>"),
      testing::HasSubstr("s.xml:3: <float>: sphere has no 'radus'; did you mean 'radius'?; its parameters are"));
  EXPECT_THAT(
      refusal(std::string(sensor) + "\n<shape type=\"obj\"><string name=\"filename\" value=\"gone.obj\"/></shape>"),
      testing::AllOf(testing::HasSubstr("s.xml:3"), testing::HasSubstr("gone.obj': no such file")));
  EXPECT_THAT(refusal(std::string(sensor) +
                      "\n<shape type=\"sphere\"><ref id=\"whte\"/></shape>\n<bsdf type=\"diffuse\" id=\"white\"/>"),
              testing::HasSubstr("no <bsdf> or <emitter> or <medium> has the id 'whte'; did you mean 'white'?"));
  EXPECT_THAT(refusal("<integrator type=\"bdpt\"/>" + std::string(sensor)),
              testing::HasSubstr("type 'bdpt': bidirectional path tracing is not supported"));
  EXPECT_THAT(refusal("<sensor type=\"perspective\"><float name=\"fov\" value=\"180\"/></sensor>"),
              testing::HasSubstr("fov 180 must lie in (0, 180) degrees"));
  EXPECT_THAT(refusal("<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/><sampler type=\"sobol\"><integer "
                      "name=\"sampleCount\" value=\"0\"/></sampler></sensor>"),
              testing::HasSubstr("sampleCount 0 must be at least 1"));
  EXPECT_THAT(refusal(std::string(sensor) +
                      "\n<bsdf type=\"diffuse\" id=\"a\"><rgb name=\"reflectance\" value=\"1.5\"/></bsdf>"),
              testing::HasSubstr("s.xml:3: <bsdf>: diffuse: reflectance (1.5, 1.5, 1.5) must lie in [0, 1]"));
  EXPECT_THAT(
      refusal(std::string(sensor) + "\n<emitter type=\"constant\"><rgb name=\"radiance\" value=\"-1\"/></emitter>"),
      testing::HasSubstr("must be finite and >= 0"));
}

TEST_F(Mitsuba, MasksNameWhatIsWrong) {
  const auto said = [&](const std::string& inside, const std::string& beside = "") {
    return refusal(std::string(sensor) + "\n<shape type=\"sphere\">" + beside + "<bsdf type=\"mask\">" + inside +
                   "</bsdf></shape>");
  };
  const std::string diffuse = "<bsdf type=\"diffuse\"/>", opacity = "<rgb name=\"opacity\" value=\"";
  EXPECT_EQ(said(diffuse), "");
  EXPECT_THAT(said(opacity + "1.5\"/>" + diffuse),
              testing::HasSubstr("s.xml:3: <bsdf>: mask: opacity 1.5 must lie in [0, 1]"));
  EXPECT_THAT(said(opacity + "-1\"/>" + diffuse), testing::HasSubstr("mask: opacity -1 must lie in [0, 1]"));
  EXPECT_THAT(said(opacity + "0.5, 0.5, 1\"/>" + diffuse),
              testing::HasSubstr("s.xml:3: <bsdf>: opacity (0.5, 0.5, 1) must be the same for all colours"));
  EXPECT_THAT(said(opacity + "1\"/>"), testing::HasSubstr("parameter '<bsdf>' is missing: what covers the rest"));
  EXPECT_THAT(said("<bsdf type=\"mask\">" + diffuse + "</bsdf>"),
              testing::HasSubstr("s.xml:3: <bsdf>: a mask inside another; make one of both"));
  EXPECT_THAT(said(diffuse, "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter>"),
              testing::HasSubstr("s.xml:3: scene: shape 0 shines through a mask, which is not supported"));
  EXPECT_THAT(refusal(std::string(sensor) +
                      "\n<shape type=\"sphere\"><emitter type=\"area\">"
                      "<rgb name=\"radiance\" value=\"1\"/></emitter><bsdf type=\"null\"/></shape>"),
              testing::HasSubstr("s.xml:3: scene: shape 0 shines and its BSDF is null, which is not supported"));
  EXPECT_THAT(
      said("<texture type=\"checkerboard\" name=\"opacity\"><rgb name=\"color0\" value=\"2\"/></texture>" + diffuse),
      testing::HasSubstr("s.xml:3: <bsdf>: mask: opacity: color0 (2, 2, 2) must lie in [0, 1]"));
}

TEST_F(Mitsuba, MetalsNameWhatIsWrong) {
  const auto said = [&](const std::string& more, const std::string& eta = "0.2", const std::string& k = "3") {
    return refusal(std::string(sensor) + "\n<shape type=\"sphere\"><bsdf type=\"roughconductor\"><rgb name=\"eta\" " +
                   "value=\"" + eta + "\"/><rgb name=\"k\" value=\"" + k + "\"/>" + more + "</bsdf></shape>");
  };
  for (const char* facets : {"beckmann", "ggx", "phong"}) {
    const std::string distribution = "<string name=\"distribution\" value=\"" + std::string(facets) + "\"/>";
    EXPECT_EQ(said(distribution), "");
    for (const char* bad : {"-1", "5e-05", "1.5"}) // phong: a negative exponent, or none
      EXPECT_THAT(
          said(distribution + "<float name=\"alpha\" value=\"" + bad + "\"/>"),
          testing::HasSubstr("s.xml:3: <bsdf>: facets: alpha " + std::string(bad) + " must lie in [0.0001, 1]"));
    EXPECT_THAT(said(distribution, "0", "0"), testing::HasSubstr("and k must not both be 0"));
    EXPECT_THAT(said(distribution, "2e6"),
                testing::HasSubstr("must be at most 1000000; those of metals stay below 100"));
  }
  EXPECT_THAT(said("<string name=\"distribution\" value=\"beckman\"/>"),
              testing::HasSubstr("; use one of beckmann, ggx, phong"));
  EXPECT_THAT(said("<float name=\"extEta\" value=\"0\"/>"),
              testing::HasSubstr("s.xml:3: <bsdf>: index of refraction 0 must be > 0"));
}

// Colours outside the gamut of sRGB, as converters write them.
TEST_F(Mitsuba, SignsOfOpticalConstantsDoNotMatter) {
  const auto read = [&](const char* eta) {
    return render::read_mitsuba(scene(std::string(sensor) + "<shape type=\"sphere\"><bsdf type=\"conductor\">" +
                                      "<rgb name=\"eta\" value=\"" + eta +
                                      "\"/><rgb name=\"k\" value=\"3\"/></bsdf></shape>"));
  };
  const auto positive = read("0.2, 1, 2"), negative = read("-0.2, 1, 2");
  EXPECT_THAT(positive.warnings, testing::IsEmpty());
  EXPECT_THAT(negative.warnings, testing::ElementsAre(testing::HasSubstr("its sign is ignored, as in Mitsuba")));
  const auto albedo = [](const render::SceneFile& file) {
    return file.scene.bsdf(file.scene.surfaces()[0]).sample(render::Vec3(0.6f, 0, 0.8f), 0, {0, 0})->f;
  };
  EXPECT_TRUE((albedo(positive) == albedo(negative)).all());
}

// The reason comes first, also for a plugin without the id that a reference would need.
TEST_F(Mitsuba, UnsupportedPluginsWithoutIdAreNamed) {
  EXPECT_THAT(refusal(std::string(sensor) + "\n<bsdf type=\"bumpmap\"><bsdf type=\"diffuse\" id=\"a\"/></bsdf>"),
              testing::HasSubstr("s.xml:3: <bsdf>: type 'bumpmap': "));
  EXPECT_THAT(refusal(std::string(sensor) + "\n<bsdf type=\"diffuse\"/>"),
              testing::HasSubstr("s.xml:3: <bsdf>: attribute 'id' is missing"));
}

TEST_F(Mitsuba, CoatsAndGroundGlassNameWhatIsWrong) {
  for (const char* type : {"roughplastic", "roughdielectric"})
    for (const char* bad : {"-0.5", "5e-05", "1.5"})
      EXPECT_THAT(refusal(std::string(sensor) + "\n<shape type=\"sphere\"><bsdf type=\"" + type +
                          "\"><float name=\"alpha\" value=\"" + bad + "\"/></bsdf></shape>"),
                  testing::HasSubstr("s.xml:3: <bsdf>: facets: alpha " + std::string(bad) + " must lie in [0.0001, 1]"))
          << type;
}

TEST_F(Mitsuba, MediaNameWhatIsWrong) {
  const auto said = [&](const std::string& attributes, const std::string& inside) {
    return refusal(std::string(sensor) + "\n<shape type=\"sphere\"><medium " + attributes + ">" + inside +
                   "</medium></shape>");
  };
  const std::string homogeneous = "type=\"homogeneous\"", interior = homogeneous + " name=\"interior\"";
  const auto sigma = [](const std::string& which, const std::string& value) {
    return "<rgb name=\"sigma" + which + "\" value=\"" + value + "\"/>";
  };
  EXPECT_EQ(said(interior, sigma("A", "0, 1, 2") + sigma("S", "0")), "");
  EXPECT_EQ(said(homogeneous, sigma("A", "1")), "");
  EXPECT_THAT(said(interior, sigma("A", "0, -1, 2")),
              testing::HasSubstr("s.xml:3: <medium>: medium: sigmaA (0, -1, 2) must be finite and >= 0"));
  EXPECT_EQ(said(interior, sigma("A", "1") + sigma("S", "0.5")), "");
  EXPECT_EQ(said(interior, sigma("T", "1")), "");
  EXPECT_THAT(said(interior, ""),
              testing::HasSubstr("s.xml:3: <medium>: give sigmaA and sigmaS, or sigmaT and albedo"));
  EXPECT_THAT(said(interior, sigma("A", "1") + sigma("T", "1")),
              testing::HasSubstr("s.xml:3: <medium>: give sigmaA and sigmaS, or sigmaT and albedo"));
  EXPECT_THAT(said(interior, sigma("T", "1") + "<rgb name=\"albedo\" value=\"0, 2, 0\"/>"),
              testing::HasSubstr("s.xml:3: <medium>: albedo (0, 2, 0) must lie in [0, 1]"));
  EXPECT_THAT(said(interior, sigma("T", "1") + "<float name=\"scale\" value=\"-1\"/>"),
              testing::HasSubstr("s.xml:3: <medium>: scale -1 must be finite and >= 0"));
  EXPECT_THAT(said(interior, sigma("T", "1") + "<phase type=\"hg\"><float name=\"g\" value=\"1\"/></phase>"),
              testing::HasSubstr("s.xml:3: <phase>: HenyeyGreenstein: g = 1 must lie in (-1, 1)"));
  EXPECT_THAT(said(interior, sigma("T", "1") + "<phase type=\"rayleigh\"/>"),
              testing::HasSubstr("s.xml:3: <phase>: type 'rayleigh': this phase function is not supported"));
  EXPECT_THAT(said(homogeneous + " name=\"exterior\"", sigma("A", "1")),
              testing::AllOf(testing::HasSubstr("s.xml:3: <shape>: its exterior is the medium of "),
                             testing::HasSubstr("s.xml:3, which is neither the sensor's nor inside a shape")));
  EXPECT_THAT(said(homogeneous + " name=\"middle\"", sigma("A", "1")), testing::HasSubstr("sphere has no 'middle'"));
  EXPECT_THAT(
      said("type=\"heterogeneous\"", ""),
      testing::HasSubstr("s.xml:3: <medium>: type 'heterogeneous': media of varying density are not supported"));
}

TEST_F(Mitsuba, LightsAndLensesNameWhatIsWrong) {
  const auto said = [&](const std::string& element) { return refusal(std::string(sensor) + "\n" + element); };
  EXPECT_THAT(
      said("<emitter type=\"directional\"><vector name=\"direction\" value=\"0\"/></emitter>"),
      testing::HasSubstr("s.xml:3: <emitter>: directional light: direction (0, 0, 0) must be finite and not 0"));
  EXPECT_THAT(said("<emitter type=\"point\"><rgb name=\"intensity\" value=\"-1\"/></emitter>"),
              testing::HasSubstr("s.xml:3: <emitter>: point light: intensity (-1, -1, -1) must be finite and >= 0"));
  const auto spot = [&](const std::string& parameters) {
    return said(fmt::format(R"(<emitter type="spot">{}</emitter>)", parameters));
  };
  EXPECT_THAT(spot(R"(<float name="cutoffAngle" value="10"/><float name="beamWidth" value="12"/>)"),
              testing::HasSubstr("s.xml:3: <emitter>: spot light: beam width 12 must lie in [0, 10] degrees"));
  EXPECT_THAT(spot(R"(<texture type="bitmap" name="texture"/>)"),
              testing::HasSubstr("s.xml:3: <texture>: spot has no 'texture'"));
  EXPECT_THAT(said("<integrator type=\"ao\"><float name=\"rayLength\" value=\"-1\"/></integrator>"),
              testing::HasSubstr("s.xml:3: <integrator>: rayLength -1 must be > 0"));
  const auto lens = [&](const std::string& parameters) {
    return fmt::format(R"(<sensor type="thinlens"><float name="fov" value="40"/>{}</sensor>)", parameters);
  };
  const std::string radius = R"(<float name="apertureRadius" value="1"/>)",
                    stop = R"(<float name="fNumber" value="32"/>)", length = R"(<float name="focalLength" value="1"/>)",
                    stop_and_length = stop + length;
  for (const std::string& wrong : {std::string(), fmt::format("{}{}", radius, stop_and_length), stop, length})
    EXPECT_THAT(refusal(lens(wrong)), testing::HasSubstr("give apertureRadius, or fNumber and focalLength together"));
  EXPECT_THAT(refusal(lens(R"(<float name="fNumber" value="0"/>)" + length)),
              testing::HasSubstr("fNumber 0 must be > 0"));
  const std::string file = scene(lens(stop_and_length) + "<shape type=\"cube\"/>");
  EXPECT_EQ(render::read_mitsuba(file).scene.camera().radius(), render::Float(1.0 / 64));
}

// v is 0 at +z in Mitsuba and at +y in lajolla. u is 0 at +x in both, and increases towards y or z.
TEST_F(Mitsuba, TheTextureOfASphereIsTheDialects) {
  const std::string file = scene(std::string(sensor) + "<shape type=\"sphere\"/>");
  for (const bool lajolla : {false, true}) {
    const auto read = render::read_mitsuba(file, lajolla ? render::Dialect::lajolla : render::Dialect::mitsuba);
    const render::Shape& ball = *read.scene.surfaces()[0].shape;
    const auto uv = [&](double x, double y, double z) {
      render::SurfacePoint p;
      p.p = render::Vec3d(x, y, z).cast<render::Float>();
      return ball.uv({}, p);
    };
    EXPECT_EQ(uv(0, 0, 1)[1], lajolla ? 0.5 : 0);
    EXPECT_EQ(uv(0, 1, 0)[1], lajolla ? 0 : 0.5);
    EXPECT_EQ(uv(1, 0, 0)[0], 0);
    EXPECT_NEAR((lajolla ? uv(0.6, 0, 0.8) : uv(0.6, 0.8, 0))[0], std::acos(0.6) / (2 * mc::pi<double>), 1e-6);
  }
}

TEST_F(Mitsuba, MeshProblemsNameSceneAndMesh) {
  write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(
      refusal(std::string(sensor) + "\n<shape type=\"obj\"><string name=\"filename\" value=\"nan.obj\"/></shape>"),
      testing::AllOf(testing::HasSubstr("s.xml:3"), testing::HasSubstr("nan.obj: line 2")));
  write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  for (const char* emitter : {"", "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/></emitter>"})
    EXPECT_THAT(refusal(fmt::format("{}\n<shape type=\"obj\"><string name=\"filename\" value=\"flat.obj\"/>{}</shape>",
                                    sensor, emitter)),
                testing::AllOf(testing::HasSubstr("s.xml:3"), testing::HasSubstr("flat.obj: none of its 1 triangles")));
}

TEST_F(Mitsuba, ThePaintIsTheDialects) {
  const auto base_of = [&](const std::string& parameters, const char* dialect) {
    const auto read =
        render::read_mitsuba(scene("<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor>"
                                   "<shape type=\"cube\"><bsdf type=\"roughplastic\">" +
                                   parameters + "</bsdf></shape>"),
                             render::dialect_from(dialect));
    const render::Bsdf& paint = read.scene.bsdf(read.scene.surfaces()[0]);
    if (std::holds_alternative<render::RoughPlastic<render::LayeredBase>>(paint)) return "layered, ggx";
    if (std::holds_alternative<render::RoughPlastic<render::LayeredBase, render::BeckmannFacets>>(paint))
      return "layered";
    return std::holds_alternative<render::RoughPlastic<render::LajollaBase>>(paint) ? "lajolla" : "none";
  };
  EXPECT_STREQ(base_of("", "mitsuba"), "layered");
  EXPECT_STREQ(base_of("", "lajolla"), "lajolla");
  EXPECT_STREQ(base_of("<string name=\"base\" value=\"lajolla\"/>", "mitsuba"), "lajolla");
  EXPECT_STREQ(base_of("<string name=\"distribution\" value=\"ggx\"/>", "mitsuba"), "layered, ggx");
  EXPECT_THAT(support::error_of([&] {
                base_of(R"(<string name="base" value="lajolla"/><string name="distribution" value="beckmann"/>)",
                        "mitsuba");
              }),
              testing::HasSubstr("beckmann needs the base layered"));
}

TEST_F(Mitsuba, DefaultsAreTheDialects) {
  const std::string file =
      scene("<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor><shape type=\"cube\"/>");
  const auto mitsuba = render::read_mitsuba(file),
             lajolla = render::read_mitsuba(file, render::dialect_from("lajolla"));
  EXPECT_EQ(mitsuba.defaults.width, 768);
  EXPECT_EQ(lajolla.defaults.width, 256);
  EXPECT_TRUE(std::holds_alternative<render::GaussianFilter>(mitsuba.scene.filter()));
  EXPECT_TRUE(std::holds_alternative<render::BoxFilter>(lajolla.scene.filter()));
  const auto tan_half = [&](const char* dialect, const std::string& body) {
    const std::string text = scene("<sensor type=\"perspective\">" + body + "</sensor><shape type=\"cube\"/>");
    return render::read_mitsuba(text, render::dialect_from(dialect)).scene.camera().tan_half(render::Float(1.5));
  };
  // Film of 36 mm by 24 mm behind 50 mm is .72 by .48 wide; half of it is .36 by .24.
  EXPECT_LE((tan_half("mitsuba", "") - render::Vec2(0.36, 0.24)).norm(), 1e-6);
  EXPECT_LE((tan_half("mitsuba", "<string name=\"focalLength\" value=\"100mm\"/>") - render::Vec2(0.18, 0.12)).norm(),
            1e-6);
  EXPECT_LE(std::abs(tan_half("lajolla", "").x() - std::tan(mc::pi<double> / 8)), 1e-6);
  EXPECT_THAT(refusal("<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>"
                      "<string name=\"focalLength\" value=\"50mm\"/></sensor>"),
              testing::HasSubstr("s.xml:2: <sensor>: perspective: give fov or focalLength, not both"));
  EXPECT_THAT(refusal("<sensor type=\"perspective\"><string name=\"focalLength\" value=\"-1mm\"/></sensor>"),
              testing::HasSubstr("focalLength -1 must be > 0"));
  EXPECT_THAT(support::error_of([] { render::dialect_from("mitsba"); }),
              testing::HasSubstr("unknown dialect 'mitsba'; did you mean 'mitsuba'?; use one of mitsuba, lajolla"));
}

// toWorld turns +z to the axis of the light. Halfway between the default beam width of 15 degrees and the cutoff at 20
// degrees, the intensity is half.
TEST_F(Mitsuba, SpotLightsShineAlongTheirAxis) {
  const std::string file = scene(std::string(sensor) + R"(<shape type="sphere"/><emitter type="spot">
    <transform name="to_world"><rotate y="1" angle="90"/><translate x="1" y="2" z="3"/></transform>
    <rgb name="intensity" value="4, 8, 12"/></emitter>)");
  const render::Scene read = render::read_mitsuba(file).scene;
  ASSERT_EQ(read.lights().size(), 1u);
  const auto irradiance = [&](double degrees) {
    const double angle = degrees * mc::pi<double> / 180;
    const render::Vec3 ref(render::Float(1 + 2 * std::cos(angle)), render::Float(2 + 2 * std::sin(angle)), 3);
    const auto s = read.lights()[0].sample(ref, {});
    return s ? double(s->radiance[1]) : 0.0;
  };
  EXPECT_NEAR(irradiance(0), 2, 1e-5);
  EXPECT_NEAR(irradiance(14.9), 2, 1e-5);
  EXPECT_NEAR(irradiance(17.5), 1, 1e-4);
  EXPECT_EQ(irradiance(20.1), 0);
}

// A truncated scene is read, or rejected with a one-line error.
TEST_F(Mitsuba, TruncatedAtAnyByte) {
  const std::string whole = R"(<scene version="0.6.0"><default name="r" value="2"/>
    <sensor type="perspective"><float name="fov" value="40"/><film type="hdrfilm"/></sensor>
    <shape type="sphere"><float name="radius" value="$r"/><ref id="a"/></shape><bsdf type="diffuse" id="a"/></scene>)";
  EXPECT_NO_THROW(render::read_mitsuba(write("s.xml", whole)));
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const std::string said = support::error_of([&] { render::read_mitsuba(write("s.xml", whole.substr(0, n))); });
    EXPECT_THAT(said, testing::HasSubstr("s.xml")) << n;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST_F(Mitsuba, FaceNormalsLeaveOutTheNormalsOfTheFile) {
  write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 1\nvn 0 0 1\nf 1//1 2//2 3//2\n");
  for (const bool faces : {false, true}) {
    const auto file =
        render::read_mitsuba(scene(fmt::format("{}<shape type=\"obj\"><string name=\"filename\" "
                                               "value=\"m.obj\"/><boolean name=\"faceNormals\" value=\"{}\"/></shape>",
                                               sensor, faces)));
    const auto point = std::get<render::TriangleMesh>(*file.scene.surfaces()[0].shape).point(0, 0, 0);
    EXPECT_EQ(point.ns == point.ng, faces);
  }
}

TEST_F(Mitsuba, ASceneWithoutLightIsBlackNotAnError) {
  const render::Scene scene = render::read_mitsuba(this->scene(std::string(sensor) + "<shape type=\"sphere\"/>")).scene;
  EXPECT_TRUE(scene.lights().empty());
  render::RenderOptions options;
  options.width = options.height = 4;
  options.spp = 4;
  for (const auto& p : render::render(scene, options).image.pixels) EXPECT_TRUE((p == 0).all());
}

// A picture by another program, as means over 4x4 pixels. Its scene is in the gallery or beside the picture; `noise` is
// its variance over the square of the radiance + .01, in each of the 16 pixels.
struct ReferenceImage {
  const char *scene, *file;
  double noise;

  friend void PrintTo(const ReferenceImage& image, std::ostream* out) { *out << image.file; }
};
struct Reference : testing::TestWithParam<ReferenceImage> {};

// Every block of 16x16 pixels agrees within 4 combined standard errors plus .5 % of the reference. Its error follows
// from those of its pixels, which are independent without splats and tiles.
TEST_P(Reference, BlocksAgree) {
  const auto [name, file, noise] = GetParam();
  const std::string folder = MC_SOURCE_DIR "/tests/references/";
  const render::Image reference = render::read_image(folder + file);
  const render::SceneFile read =
      render::read_mitsuba(std::filesystem::exists(folder + name) ? folder + name : gallery(name));
  constexpr int side = 4; // of what one pixel of the reference covers
  render::RenderOptions options;
  options.width = side * reference.width;
  options.height = side * reference.height;
  options.spp = 16;
  options.max_depth = read.defaults.max_depth;
  options.seed = 3;
  options.adaptive = options.splat = false;
  options.tiles = false;
  const auto result = render::render(read.scene, options);
  ASSERT_EQ(result.invalid, 0u);
  int blocks = 0;
  double worst = 0;
  const int size = 4 * side;
  for (int y0 = 0; y0 < result.image.height; y0 += size)
    for (int x0 = 0; x0 < result.image.width; x0 += size)
      for (int c = 0; c < 3; ++c, ++blocks) {
        double difference = 0, sum = 0, variance = 0;
        for (int y = y0; y < std::min(y0 + size, result.image.height); ++y)
          for (int x = x0; x < std::min(x0 + size, result.image.width); ++x) {
            const auto expected = double(reference.at(x / side, y / side)[c]);
            difference += double(result.image.at(x, y)[c]) - expected;
            sum += expected;
            variance += double(result.image.variance[result.image.index(x, y)][c]) + noise * (mc::sqr(expected) + 0.01);
          }
        const double excess = std::abs(difference) - 0.005 * std::abs(sum);
        if (excess > 0) worst = std::max(worst, excess / std::sqrt(variance));
        EXPECT_LE(excess, 4 * std::sqrt(variance)) << name << " block (" << x0 << ", " << y0 << ") channel " << c;
      }
  std::printf("%s: %d blocks, the worst %.2f standard errors beyond 0.5 %%\n", name, blocks, worst);
}

INSTANTIATE_TEST_SUITE_P(Mitsuba, Reference,
                         testing::Values(ReferenceImage{"cbox.xml", "cbox.pfm", 4.9e-5},
                                         ReferenceImage{"two-spheres.xml", "two-spheres.pfm", 3e-6},
                                         ReferenceImage{"checkered-floor.xml", "checkered-floor.pfm", 1e-4},
                                         ReferenceImage{"book3-cornell-white.xml", "book3-cornell-white.pfm", 3.7e-4},
                                         ReferenceImage{"smallpt.xml", "smallpt.pfm", 4.4e-4}));

} // namespace
