// Conventions of Mitsuba that are not obvious, tested with images of one pixel with a known radiance.

#include <render/io/image/image_io.h>
#include <render/io/mitsuba/mitsuba.h>
#include <render/io/spectrum.h>
#include <render/render.h>

#include "render/io/mitsuba/scene_text.h"

namespace {

using render::Spectrum;

struct Meaning : support::SceneTest {
  /// Radiance of a pixel with a box filter and a tiny field of view, from `eye` towards `target`.
  Spectrum seen(const std::string& eye, const std::string& target, const std::string& body,
                const std::string& sensor_parameters = "", render::Dialect dialect = render::Dialect::mitsuba) const {
    const std::string file =
        write("one.xml",
              fmt::format("<scene version=\"0.6.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"0.01\"/>{}"
                          "<transform name=\"toWorld\"><lookAt origin=\"{}\" target=\"{}\" up=\"0,1,0\"/></transform>"
                          "<film type=\"hdrfilm\"><rfilter type=\"box\"/></film></sensor>{}</scene>",
                          sensor_parameters, eye, target, body));
    const render::SceneFile read = render::read_mitsuba(file, dialect);
    render::RenderOptions options;
    options.width = options.height = 1;
    options.spp = 256;
    return render::render(read.scene, options).image.pixels[0];
  }
};

const std::string sky = "<emitter type=\"constant\"/>";
std::string area(double radiance) {
  return fmt::format("<emitter type=\"area\"><rgb name=\"radiance\" value=\"{}\"/></emitter>", radiance);
}

// Mitsuba gives lamps without a BSDF a black one, and other shapes a diffuse one of 1/2.
TEST_F(Meaning, ALampWithoutABsdfReflectsNothing) {
  for (const std::string shape : {"rectangle", "sphere", "cube"}) {
    const std::string lamp = fmt::format("{}<shape type=\"{}\">{}</shape>", sky, shape, area(3));
    EXPECT_EQ(seen("0,0,4", "0,0,0", lamp)[0], 3) << shape;
    EXPECT_NEAR(seen("0,0,4", "0,0,0", fmt::format("{}<shape type=\"{}\"/>", sky, shape))[0], 0.5, 1e-3) << shape;
  }
}

// If the normals of a file oppose the order of the corners, the normals decide which side emits.
TEST_F(Meaning, AMeshShinesFromTheSideOfItsNormals) {
  for (const int z : {1, -1}) {
    write("square.obj", fmt::format("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0 0 {}\nf 1//1 2//1 3//1 4//1\n", z));
    for (const int mirror : {1, -1}) {
      const std::string body = "<shape type=\"obj\"><string name=\"filename\" value=\"square.obj\"/>" + area(3) +
                               fmt::format("<transform name=\"toWorld\"><scale x=\"{}\"/></transform></shape>", mirror);
      EXPECT_EQ(seen("0.1,0.2,4", "0.1,0.2,0", body)[0], z > 0 ? 3 : 0) << z << mirror;
      EXPECT_EQ(seen("0.1,0.2,-4", "0.1,0.2,0", body)[0], z > 0 ? 0 : 3) << z << mirror;
      // A floor on the emitting side is lit, a floor on the other side is not.
      const std::string floor = fmt::format("<shape type=\"rectangle\"><transform name=\"toWorld\"><rotate y=\"1\" "
                                            "angle=\"{}\"/><translate z=\"{}\"/></transform></shape>",
                                            z > 0 ? 180 : 0, 2 * z);
      EXPECT_GT(seen(fmt::format("3,0,{}", z), fmt::format("0,0,{}", 2 * z), body + floor)[0], 0.1) << z << mirror;
    }
  }
}

// The faces of the cube in Mitsuba: u and v at a point of each.
TEST_F(Meaning, ACubeHasMitsubasTextureCoordinates) {
  render::Image ramp(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) ramp.at(x, y) = Spectrum((x + 0.5f) / 64, (y + 0.5f) / 64, 0);
  render::write_image(path("ramp.pfm"), ramp);
  const std::string body = sky + "<shape type=\"cube\"><bsdf type=\"diffuse\"><texture type=\"bitmap\" "
                                 "name=\"reflectance\"><string name=\"filename\" value=\"ramp.pfm\"/></texture></bsdf>"
                                 "</shape>";
  struct Row {
    const char *eye, *target;
    double u, v;
  };
  for (const Row& row : {Row{"9,.3,-.5", "1,.3,-.5", .65, .75},
                         {"-9,.3,-.5", "-1,.3,-.5", .65, .25},
                         {".3,9,-.4999", ".3,1,-.5", .35, .75},
                         {".3,-9,-.4999", ".3,-1,-.5", .25, .65},
                         {".3,-.5,9", ".3,-.5,1", .25, .65},
                         {".3,-.5,-9", ".3,-.5,-1", .75, .65}}) {
    const Spectrum uv = seen(row.eye, row.target, body);
    EXPECT_NEAR(uv[0], row.u, 2e-3) << row.target;
    EXPECT_NEAR(uv[1], row.v, 2e-3) << row.target;
  }
}

// The ends of a spectrum depend on the renderer and the version of the scene. 450 to 460 nm are blue, but white in
// lajolla, which extends the end values.
TEST_F(Meaning, SpectraEndAsInTheRendererOfTheScene) {
  const std::vector<render::SpectralSample> blue = {{450, 1}, {460, 1}};
  const auto light = [&](const std::string& version, render::Dialect dialect) {
    const std::string file = write("sky.xml", "<scene version=\"" + version + "\">" + sensor +
                                                  "<emitter type=\"constant\"><spectrum name=\"radiance\" "
                                                  "value=\"450:1, 460:1\"/></emitter></scene>");
    render::RenderOptions options;
    options.width = options.height = options.spp = 1;
    return render::render(render::read_mitsuba(file, dialect).scene, options).image.pixels[0];
  };
  const auto expected = [&](render::Extrapolation beyond) {
    return Spectrum(render::spectrum_to_rgb(blue, render::Illuminant::equal_energy, beyond).max(0));
  };
  using render::Extrapolation, render::Dialect;
  EXPECT_TRUE(light("0.6.0", Dialect::mitsuba).isApprox(expected(Extrapolation::ramp), 1e-5f));
  EXPECT_TRUE(light("3.0.0", Dialect::mitsuba).isApprox(expected(Extrapolation::zero), 1e-5f));
  EXPECT_TRUE(light("0.6.0", Dialect::lajolla).isApprox(expected(Extrapolation::constant), 1e-5f));
  EXPECT_EQ(light("0.6.0", Dialect::mitsuba)[1], 0) << "no green";
}

// A medium around the camera also fills the region before nearClip.
TEST_F(Meaning, AMediumBeginsAtTheLens) {
  const std::string box =
      "<shape type=\"cube\"><transform name=\"toWorld\"><scale x=\"3\" y=\"3\" z=\"3\"/></transform>"
      "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/><boolean name=\"twoSided\" "
      "value=\"true\"/></emitter><medium type=\"homogeneous\" name=\"interior\"><rgb "
      "name=\"sigmaA\" value=\".2,.5,1\"/></medium></shape>";
  for (const std::string near : {"", "<float name=\"nearClip\" value=\"1\"/>"}) {
    const Spectrum inside = seen("0,0,0", "0,0,3", box, near);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(inside[c], std::exp(-3 * (c == 0 ? 0.2 : c == 1 ? 0.5 : 1)), 1e-5) << near;
  }
}

// The boundary of a medium without BSDF is invisible in Mitsuba 0.6 and lajolla, and diffuse since Mitsuba 2.
TEST_F(Meaning, ABoundaryWithoutABsdfIsInvisible) {
  const std::string fog = "<medium type=\"homogeneous\" name=\"{}\"><rgb name=\"sigmaA\" value=\"1\"/></medium>";
  const std::string ball = sky + "<shape type=\"sphere\">" + fmt::format(fmt::runtime(fog), "interior");
  for (const render::Dialect dialect : {render::Dialect::mitsuba, render::Dialect::lajolla})
    EXPECT_NEAR(seen("0,0,4", "0,0,0", ball + "</shape>", "", dialect)[0], std::exp(-2), 1e-5);
  EXPECT_NEAR(seen("0,0,4", "0,0,0", ball + "<bsdf type=\"null\"/></shape>")[0], std::exp(-2), 1e-5);
  EXPECT_NEAR(seen("0,0,4", "0,0,0", ball + "<bsdf type=\"diffuse\"/></shape>")[0], 0.5, 1e-3);
}

// The sensor's medium surrounds all shapes, unless one of them has it inside. Glass whose exterior is named and whose
// interior is not holds nothing.
TEST_F(Meaning, TheSensorsMediumIsAmbient) {
  const std::string fog = "<medium type=\"homogeneous\" id=\"fog\"><rgb name=\"sigmaA\" value=\".5\"/></medium>",
                    around = "<ref name=\"exterior\" id=\"fog\"/>", in_fog = "<ref id=\"fog\"/>";
  const std::string lamp = "<shape type=\"rectangle\">" + area(1) + around + "</shape>";
  EXPECT_NEAR(seen("0,0,4", "0,0,0", fog + lamp, in_fog)[0], std::exp(-0.5 * 4), 1e-5);
  const std::string bubble = "<shape type=\"sphere\"><point name=\"center\" z=\"2\"/><bsdf type=\"dielectric\"><float "
                             "name=\"intIOR\" value=\"1\"/><float name=\"extIOR\" value=\"1\"/></bsdf>" +
                             around + "</shape>";
  EXPECT_NEAR(seen("0,0,4", "0,0,0", fog + lamp + bubble, in_fog)[0], std::exp(-0.5 * 2), 1e-5);
  const std::string room = "<shape type=\"sphere\"><float name=\"radius\" value=\"6\"/><ref name=\"interior\" "
                           "id=\"fog\"/></shape>";
  EXPECT_NEAR(seen("0,0,4", "0,0,0", fog + lamp + room, in_fog)[0], std::exp(-0.5 * 4), 1e-5);
  EXPECT_NEAR(seen("0,0,9", "0,0,0", fog + lamp + room, in_fog)[0], std::exp(-0.5 * 6), 1e-5);
}

// sigmaT and albedo, or the parts; the scale multiplies both. A ball that scatters all is as bright as the sky. The
// bounds are four standard errors of 256 samples.
TEST_F(Meaning, MediaAreGivenByPartsOrByAlbedo) {
  const auto ball = [&](const std::string& inside) {
    return sky + "<shape type=\"sphere\"><bsdf type=\"null\"/><medium type=\"homogeneous\" name=\"interior\">" +
           inside + "</medium></shape>";
  };
  const std::string by_sum = "<float name=\"sigma_t\" value=\"1.5\"/><rgb name=\"albedo\" value=\"0, 0, 1\"/><float "
                             "name=\"scale\" value=\"2\"/><phase type=\"hg\"><float name=\"g\" value=\"0.5\"/></phase>";
  const Spectrum clear = seen("0,0,4", "0,0,0", ball(by_sum));
  EXPECT_NEAR(clear[0], std::exp(-2 * 3), 0.02);
  EXPECT_NEAR(clear[2], 1, 0.02);
  const Spectrum parts = seen("0,0,4", "0,0,0",
                              ball("<rgb name=\"sigmaA\" value=\"3, 3, 0\"/><rgb name=\"sigmaS\" "
                                   "value=\"0, 0, 3\"/><phase type=\"isotropic\"/>"));
  EXPECT_NEAR(parts[0], std::exp(-2 * 3), 0.02);
  EXPECT_NEAR(parts[2], 1, 0.02);
}

// Opaque BSDFs reflect on the side of the normal, unless they are inside <twosided>. In lajolla they do on both.
TEST_F(Meaning, OpaqueBsdfsAreOneSided) {
  const std::string half = "<rgb name=\"specularReflectance\" value=\"0.5\"/>",
                    metal = "<rgb name=\"eta\" value=\"0\"/><rgb name=\"k\" value=\"1\"/>" + half;
  const auto plate = [&](const std::string& type, const std::string& parameters, bool twosided = false) {
    const std::string bsdf = fmt::format("<bsdf type=\"{}\">{}</bsdf>", type, parameters);
    return fmt::format("{}<shape type=\"rectangle\">{}</shape>", sky,
                       twosided ? "<bsdf type=\"twosided\">" + bsdf + "</bsdf>" : bsdf);
  };
  for (const auto& [type, parameters] : std::vector<std::pair<std::string, std::string>>{
           {"diffuse", ""},
           {"conductor", "<string name=\"material\" value=\"none\"/>" + half},
           {"roughconductor", metal},
           {"plastic", ""},
           {"roughplastic", ""}}) {
    const double front = double(seen("0,0,4", "0,0,0", plate(type, parameters))[0]);
    EXPECT_GT(front, 0.3) << type;
    EXPECT_EQ(seen("0,0,-4", "0,0,0", plate(type, parameters))[0], 0) << type;
    EXPECT_NEAR(seen("0,0,-4", "0,0,0", plate(type, parameters, true))[0], front, 0.02) << type;
    const Spectrum lajolla = seen("0,0,-4", "0,0,0", plate(type, parameters), "", render::Dialect::lajolla);
    EXPECT_GT(lajolla[0], 0.3) << type;
  }
  EXPECT_GT(seen("0,0,-4", "0,0,0", plate("fuzzymetal", ""))[0], 0.8);
  EXPECT_EQ(seen("0,0,-4", "0,0,0", sky + "<shape type=\"rectangle\"/>")[0], 0);
}

// Without a given focus, a lens is focused at farClip, 1e4 by default: a distant edge is sharp.
TEST_F(Meaning, ALensIsFocusedFarAway) {
  const std::string lens = "<sensor type=\"thinlens\"><float name=\"fov\" value=\"40\"/><float name=\"apertureRadius\" "
                           "value=\"0.1\"/>{}</sensor>";
  const auto distance = [&](const std::string& more) {
    const auto file = render::read_mitsuba(scene(sky + fmt::format(fmt::runtime(lens), more)));
    // Intersection of rays through two points of the lens.
    const render::ThinLens& camera = file.scene.camera();
    const render::Vec2 middle(0.5f, 0.5f);
    const render::Ray a = camera.ray(middle, camera.tan_half(1), {0.9f, 0.1f}),
                      b = camera.ray(middle, camera.tan_half(1), {0.9f, 0.6f});
    return double((b.o - a.o).norm() / (a.d - b.d).norm());
  };
  EXPECT_NEAR(distance("") / 1e4, 1, 0.02);
  EXPECT_NEAR(distance("<float name=\"farClip\" value=\"50\"/>"), 50, 0.1);
  EXPECT_NEAR(distance("<float name=\"focusDistance\" value=\"7\"/><float name=\"farClip\" value=\"50\"/>"), 7, 0.01);
}

} // namespace
