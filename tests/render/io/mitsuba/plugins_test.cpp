#include <render/bsdf/rough_conductor.h>
#include <render/io/image/image_io.h>
#include <render/io/metals.h>
#include <render/io/mitsuba/plugins.h>

#include "render/io/mitsuba/scene_text.h"

#include <map>

namespace {

using namespace render::mitsuba;

// Scene text around an element of each kind.
struct Placement {
  std::string before, after;
};
const std::string camera = "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>";
const std::map<std::string, Placement> places = {
    {"integrator", {"", ""}},
    {"sensor", {"", ""}},
    {"film", {camera, "</sensor>"}},
    {"rfilter", {camera + "<film type=\"hdrfilm\">", "</film></sensor>"}},
    {"sampler", {camera, "</sensor>"}},
    {"bsdf", {"<shape type=\"sphere\">", "</shape>"}},
    {"texture", {"", ""}},
    {"shape", {"", ""}},
    {"medium", {"<shape type=\"sphere\">", "</shape>"}},
    {"phase", {"<shape type=\"sphere\"><medium type=\"homogeneous\">", "</medium></shape>"}},
    {"emitter in a shape", {"<shape type=\"sphere\">", "</shape>"}},
    {"emitter", {"", ""}},
};

// The parameter as an element. Only reading it detects that the attribute or child `value` is invalid.
std::string element_of(const Declaration& d, const std::string& value) {
  if (d.nested()) return "<" + d.tags[0] + " type=\"" + value + "\"/>";
  if (d.type == "transform") return "<transform name=\"" + d.name + "\"><" + value + "/></transform>";
  if (d.type == "file") return "<string name=\"" + d.name + "\"/>"; // any value is a valid name, so it is omitted
  return "<" + d.tags[0] + " name=\"" + d.name + "\" value=\"" + value + "\"/>";
}

// The required parameters of a row except one, in one line.
std::string needed_but(const std::string& name, const PluginText& row) {
  std::string text;
  for (const Declaration& d : row.parameters) {
    if (d.fallback != "-" || d.nested() || d.name == name) continue;
    const std::string words = "one of ", value = d.type.starts_with(words) ? d.type.substr(words.size()) : "1";
    text += "<" + d.tags[0] + " name=\"" + d.name + "\" value=\"" + value.substr(0, value.find(',')) + "\"/>";
  }
  return text;
}

struct PluginsTest : support::SceneTest {
  std::string said(const Kind& kind, const PluginText& row, const std::string& children) const {
    const std::string tag = kind.tag.substr(0, kind.tag.find(' '));
    const Placement& place = places.at(kind.tag);
    return refusal(place.before + "<" + tag + " id=\"its\" type=\"" + row.name + "\">\n" + children + "</" + tag + ">" +
                   place.after);
  }
};

// A texture on a mesh without texture coordinates: the error names the file of the mesh and the place.
TEST_F(PluginsTest, MeshesWithoutTextureCoordinates) {
  const auto said = [&](const std::string& type, const std::string& file, const std::string& text) {
    write(file, text);
    return refusal(camera + "</sensor><shape type=\"" + type + "\"><string name=\"filename\" value=\"" + file +
                   "\"/><bsdf type=\"diffuse\"><texture type=\"checkerboard\" name=\"reflectance\"/></bsdf></shape>");
  };
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
  EXPECT_EQ(said("obj", "a.obj", triangle), "");
  EXPECT_THAT(said("obj", "a.obj", triangle + "f 1/1 2/1 3\n"),
              testing::HasSubstr("a.obj: the face of line 6 has none"));
  EXPECT_THAT(said("ply", "a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                   "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
              testing::HasSubstr("a.ply: its vertices have no u and v"));
}

// The reference and the reader agree. Every declared parameter is read, because an invalid value causes an error with
// its line. Undeclared parameters are rejected.
TEST_F(PluginsTest, EveryDeclaredParameterIsRead) {
  int parameters = 0;
  for (const Kind& kind : all_plugins())
    for (const PluginText& row : kind.rows) {
      for (const Declaration& d : row.parameters) {
        if (!d.has_effect) continue;
        ++parameters;
        EXPECT_THAT(said(kind, row, needed_but(d.name, row) + "\n" + element_of(d, "broken")),
                    testing::HasSubstr("s.xml:4: <"))
            << kind.tag << " " << row.name << ": " << d.name;
      }
      EXPECT_THAT(said(kind, row, needed_but("", row) + "\n<float name=\"nonsense\" value=\"1\"/>"),
                  testing::HasSubstr("s.xml:4: <float>: " + row.name + " has no 'nonsense'"));
    }
  EXPECT_GE(parameters, 86);
}

TEST_F(PluginsTest, NamesAndParametersDiffer) {
  for (const Kind& kind : all_plugins()) {
    std::map<std::string, int> names;
    for (const PluginText& row : kind.rows) {
      EXPECT_EQ(++names[row.name], 1) << kind.tag << " " << row.name;
      std::map<std::string, int> parameters;
      for (const Declaration& d : row.parameters) {
        EXPECT_EQ(++parameters[d.name], 1) << row.name << " " << d.name;
        EXPECT_NE(d.meaning, "") << row.name << " " << d.name;
      }
    }
  }
}

TEST_F(PluginsTest, AFilmHasPixels) {
  for (const auto& [width, height] : {std::pair(0, 0), {0, 5}, {5, 0}, {-1, 5}})
    EXPECT_THAT(refusal(fmt::format("{}\n<film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/><integer "
                                    "name=\"height\" value=\"{}\"/></film></sensor><shape type=\"sphere\"/>",
                                    camera, width, height)),
                testing::HasSubstr(fmt::format("s.xml:3: <film>: size {}x{} needs at least one pixel", width, height)));
}

TEST_F(PluginsTest, IndicesOfRefractionHaveNames) {
  const auto refracted = [&](const std::string& inside) {
    const auto file =
        render::read_mitsuba(scene(std::string(sensor) + "<shape type=\"cube\"><bsdf type=\"dielectric\">" + inside +
                                   R"(<string name="extIOR" value="vacuum"/></bsdf></shape>)"));
    return file.scene.bsdf(file.scene.surfaces()[0]).sample({0, 0, 1}, render::Float(0.999), {0, 0})->eta;
  };
  EXPECT_EQ(refracted(R"(<string name="intIOR" value="water"/>)"), render::Float(1.333));
  EXPECT_EQ(refracted(R"(<float name="intIOR" value="1.333"/>)"), render::Float(1.333));
  EXPECT_EQ(refracted(R"(<string name="int_ior" value="BK7"/>)"), render::Float(1.5046));
  EXPECT_THAT(refusal(std::string(sensor) +
                      "\n<bsdf id=\"b\" type=\"dielectric\"><string name=\"intIOR\" value=\"bk8\"/></bsdf>"),
              testing::HasSubstr("s.xml:3: <string>: no index of refraction is known of 'bk8'; did you mean 'bk7'?"));
}

TEST_F(PluginsTest, TexturesAreMovedByTransformsToo) {
  const auto at = [&](const std::string& parameters, const render::Vec2d& uv) {
    const auto root = render::read_xml(write("t.xml", "<texture type=\"checkerboard\">" + parameters + "</texture>"));
    // The origin of the scene does not affect the texture.
    Context context(root, render::Dialect::mitsuba, render::Vec3d(5, 6, 7));
    return read_plugin(texture_plugins(), root, context).eval(uv)[0];
  };
  const std::string moved = R"(<transform name="to_uv"><scale x="2" y="3"/><translate x="0.25" y="0.5"/></transform>)";
  const std::string factors = R"(<float name="uscale" value="2"/><float name="vscale" value="3"/>
                                 <float name="uoffset" value="0.25"/><float name="voffset" value="0.5"/>)";
  int dark = 0;
  for (double u = 0.01; u < 1; u += 0.03)
    for (double v = 0.013; v < 1; v += 0.03) {
      EXPECT_EQ(at(moved, {u, v}), at(factors, {u, v})) << u << " " << v;
      dark += at(moved, {u, v}) < render::Float(0.3);
    }
  EXPECT_GT(dark, 200);
  EXPECT_THAT(refusal(std::string(sensor) + "\n<texture type=\"checkerboard\" id=\"t\"><transform name=\"to_uv\">"
                                            "<rotate z=\"1\" angle=\"30\"/></transform></texture>"),
              testing::HasSubstr("s.xml:3: <transform>: only what scales and translates u and v is supported"));
}

// Reflectances lie in [0, 1]; emission may have any value.
TEST_F(PluginsTest, PicturesOfPaintLieInZeroToOne) {
  const auto bitmap = [](const std::string& name) {
    return "<texture type=\"bitmap\" name=\"" + name + "\"><string name=\"filename\" value=\"p.pfm\"/></texture>";
  };
  const std::string diffuse = "<bsdf type=\"diffuse\">" + bitmap("reflectance") + "</bsdf>",
                    paint = "<bsdf type=\"roughplastic\">" + bitmap("diffuseReflectance") + "</bsdf>",
                    lacquer = "<bsdf type=\"plastic\">" + bitmap("specularReflectance") + "</bsdf>",
                    mask = "<bsdf type=\"mask\">" + bitmap("opacity") + "<bsdf type=\"diffuse\"/></bsdf>";
  const auto said = [&](const std::string& body, double texel) {
    render::Image picture(3, 2);
    picture.at(2, 1) = render::Spectrum(0, render::Float(texel), 1);
    render::write_image(path("p.pfm"), picture);
    return refusal(std::string(sensor) + "\n" + body);
  };
  for (const auto& [bsdf, what] : {std::pair(diffuse, "diffuse reflectance"),
                                   {paint, "diffuse reflectance"},
                                   {lacquer, "specular reflectance"},
                                   {mask, "mask: opacity"}}) {
    const std::string shape = "<shape type=\"cube\">" + bsdf + "</shape>";
    EXPECT_EQ(said(shape, 1), "");
    for (const double wrong : {1.75, -0.25})
      EXPECT_THAT(
          said(shape, wrong),
          testing::AllOf(testing::HasSubstr(fmt::format("s.xml:3: <bsdf>: {}: texel (2, 1) of '", what)),
                         testing::HasSubstr(fmt::format("p.pfm' = (0, {}, 1) must lie in [0, 1]; clip", wrong))));
    EXPECT_THAT(said(shape, NAN), testing::HasSubstr("p.pfm' = (0, nan, 1) is not finite; repair the picture"));
  }
  EXPECT_EQ(said("<emitter type=\"envmap\"><string name=\"filename\" value=\"p.pfm\"/></emitter>", 1000), "");
  const auto lamp = [&](double texel) {
    return said("<shape type=\"rectangle\"><emitter type=\"area\">" + bitmap("radiance") + "</emitter></shape>", texel);
  };
  EXPECT_EQ(lamp(1000), "");
  EXPECT_THAT(lamp(-1), testing::HasSubstr("the texture has the value -1; radiance must be >= 0"));
}

TEST_F(PluginsTest, WhatIsNotDoneIsRefused) {
  for (const char* name : {"hideEmitters"}) {
    const std::string start =
        std::string(sensor) + "\n<integrator type=\"path\"><boolean name=\"" + name + "\" value=\"";
    EXPECT_THAT(refusal(start + "true\"/></integrator>"),
                testing::HasSubstr("s.xml:3: <boolean>: " + std::string(name) + " = true is not supported"));
    EXPECT_NO_THROW(render::read_mitsuba(scene(start + "false\"/></integrator><shape type=\"cube\"/>")));
  }
}

// A mirror's reflectance at normal incidence, as the weight of its only direction.
TEST_F(PluginsTest, ConductorsAreMetals) {
  const auto reflected = [&](const std::string& type, const std::string& parameters) -> render::Spectrum {
    const auto file =
        render::read_mitsuba(scene(std::string(sensor) + "<shape type=\"cube\"><bsdf type=\"" + type +
                                   "\"><string name=\"extEta\" value=\"vacuum\"/>" + parameters + "</bsdf></shape>"));
    return file.scene.bsdf(file.scene.surfaces()[0]).sample({0, 0, 1}, 0, {0, 0})->f;
  };
  const std::string smooth = "<float name=\"alpha\" value=\"0\"/><string name=\"distribution\" value=\"ggx\"/>";
  for (const auto name : render::metal_names()) {
    const auto [eta, k] = render::metal_constants(name);
    const std::string material = fmt::format("<string name=\"material\" value=\"{}\"/>", name);
    EXPECT_TRUE(reflected("conductor", material).isApprox(render::fresnel_conductor(1, eta, k))) << name;
    EXPECT_TRUE(reflected("roughconductor", material + smooth).isApprox(render::fresnel_conductor(1, eta, k))) << name;
  }
  const auto [eta, k] = render::metal_constants("Cu");
  EXPECT_TRUE(reflected("conductor", "").isApprox(render::fresnel_conductor(1, eta, k))) << "Mitsuba's default";
  const std::string none = "<string name=\"material\" value=\"none\"/>",
                    rgb = R"(<rgb name="eta" value="0.2, 1, 1.3"/><rgb name="k" value="3, 2, 1"/>)";
  EXPECT_TRUE(reflected("conductor", none).isApproxToConstant(1));
  EXPECT_TRUE(reflected("roughconductor", none + smooth).isApproxToConstant(1));
  const render::Spectrum expected = render::fresnel_conductor(1, {0.2f, 1, 1.3f}, {3, 2, 1});
  EXPECT_TRUE(reflected("conductor", rgb).isApprox(expected));
  EXPECT_TRUE(reflected("roughconductor", rgb + smooth).isApprox(expected));
  EXPECT_TRUE(reflected("conductor", "<spectrum name=\"eta\" value=\"2\"/><float name=\"k\" value=\"3\"/>")
                  .isApproxToConstant(render::Float(10.0 / 18)));

  const auto said = [&](const std::string& type, const std::string& parameters) {
    return refusal(std::string(sensor) + "\n<bsdf id=\"b\" type=\"" + type + "\">" + parameters + "</bsdf>");
  };
  for (const char* type : {"conductor", "roughconductor"}) {
    EXPECT_THAT(said(type, none + rgb), testing::HasSubstr("s.xml:3: <bsdf>: material and eta contradict each other"));
    EXPECT_THAT(said(type, "<float name=\"eta\" value=\"1\"/>"),
                testing::HasSubstr("s.xml:3: <bsdf>: eta and k belong together; give both, or a material"));
    EXPECT_THAT(said(type, "<string name=\"material\" value=\"Agg\"/>"),
                testing::HasSubstr("s.xml:3: <string>: material 'Agg' is not known; did you mean 'Ag'?"));
    EXPECT_THAT(said(type, "<string name=\"material\" value=\"TiO2\"/>"),
                testing::HasSubstr("s.xml:3: <string>: material 'TiO2' is not in the table of metals; give its eta"));
  }
}

// The facets of a file without a distribution are those of its dialect.
TEST_F(PluginsTest, FacetsAreBeckmannsOrGgx) {
  const render::Vec3 wo = render::Vec3(render::Float(0.6), 0, render::Float(0.8)), wi(0, 0, 1);
  const auto value = [&](const char* type, const std::string& more, const char* dialect) {
    const auto file = render::read_mitsuba(scene(std::string(sensor) + "<shape type=\"sphere\"><bsdf type=\"" + type +
                                                 "\"><float name=\"alpha\" value=\"0.3\"/>" + more + "</bsdf></shape>"),
                                           render::dialect_from(dialect));
    return double(file.scene.bsdf(file.scene.surfaces()[0]).eval(wo, wi)[0]);
  };
  const std::string beckmann = R"(<string name="distribution" value="beckmann"/>)",
                    ggx = R"(<string name="distribution" value="ggx"/>)";
  for (const char* type : {"roughconductor", "roughdielectric", "roughplastic"}) {
    const double b = value(type, beckmann, "mitsuba"), g = value(type, ggx, "mitsuba");
    EXPECT_EQ(value(type, "", "mitsuba"), b) << type;
    EXPECT_EQ(value(type, ggx, "lajolla"), value(type, "", "lajolla")) << type;
    EXPECT_NE(b, g) << type;
  }
  const auto metal = render::metal_constants("Cu");
  const double index = 1.000277;
  const render::RoughConductor<render::BeckmannFacets> expected(
      metal.eta / render::Float(index), metal.k / render::Float(index), render::BeckmannFacets(render::Float(0.3)));
  EXPECT_NEAR(value("roughconductor", "", "mitsuba"), double(expected.eval(wo, wi)[0]), 1e-6);
}

TEST_F(PluginsTest, ThinGlassPassesStraight) {
  const auto file = render::read_mitsuba(
      scene(std::string(sensor) + R"(<shape type="rectangle"><bsdf type="thindielectric"/></shape>)"));
  const render::Vec3 wo(render::Float(0.6), 0, render::Float(0.8));
  const auto through = file.scene.bsdf(file.scene.surfaces()[0]).sample(wo, render::Float(0.5), {0, 0});
  ASSERT_TRUE(through);
  EXPECT_EQ(through->wi, -wo);
}

// The film spans the length of the x axis on both sides, and wrappers of integrators render what they contain.
TEST_F(PluginsTest, OrthographicSensorsAndWrappers) {
  const auto file = render::read_mitsuba(scene(R"(<sensor type="orthographic"><transform name="toWorld">
<scale x="2.5" y="2.5"/><translate z="-3"/></transform></sensor><shape type="cube"/>
<integrator type="moment"><integrator type="aov"><string name="aovs" value="z:depth"/>
<integrator type="path"><integer name="maxDepth" value="7"/></integrator></integrator></integrator>)"));
  EXPECT_TRUE(file.scene.camera().is_parallel());
  EXPECT_LE((file.scene.camera().tan_half(2) - render::Vec2(2.5f, 1.25f)).norm(), 1e-6);
  EXPECT_EQ(file.defaults.max_depth, 7);
  EXPECT_THAT(refusal(std::string(sensor) + "<shape type=\"cube\"/>\n<integrator type=\"moment\"/>"),
              testing::HasSubstr("s.xml:3: <integrator>: parameter '<integrator>' is missing"));
}

TEST_F(PluginsTest, AnisotropicFacetsAreRefused) {
  const auto said = [&](const std::string& type, const std::string& u, const std::string& v, const std::string& more) {
    const auto along = [](const char* name, const std::string& value) {
      return value.empty() ? "" : fmt::format("<float name=\"{}\" value=\"{}\"/>", name, value);
    };
    return refusal(std::string(sensor) + "<shape type=\"cube\"/>\n<bsdf id=\"b\" type=\"" + type + "\">" +
                   along("alpha_u", u) + along("alphaV", v) + more + "</bsdf>");
  };
  for (const char* type : {"roughconductor", "roughdielectric"}) {
    EXPECT_EQ(said(type, "0.2", "0.2", ""), "");
    EXPECT_THAT(said(type, "0.2", "0.3", ""),
                testing::HasSubstr("s.xml:3: <bsdf>: anisotropic facets are not supported: alphaU 0.2 and alphaV 0.3 "
                                   "must be equal; give alpha instead"));
    EXPECT_THAT(said(type, "0.2", "", ""), testing::HasSubstr("alphaU 0.2 and alphaV (missing) must be equal"));
    EXPECT_THAT(said(type, "0.2", "0.2", "<float name=\"alpha\" value=\"0.2\"/>"),
                testing::HasSubstr("give alpha, or alphaU and alphaV, not both"));
  }
}

// The left half of the rectangle is rougher than the right half.
TEST_F(PluginsTest, RoughnessMayBeATexture) {
  const auto at = [&](const std::string& type, const std::string& name, double color, const char* dialect, double x) {
    const std::string text = fmt::format(
        R"({}<shape type="rectangle"><bsdf type="{}"><texture type="checkerboard" name="{}">
           <float name="vscale" value="0"/><rgb name="color0" value="{}"/><rgb name="color1" value="0.1"/></texture>
           </bsdf></shape>)",
        sensor, type, name, color);
    const render::Scene read = render::read_mitsuba(scene(text), render::dialect_from(dialect)).scene;
    const render::Ray ray{render::Vec3(render::Float(x), 0, 1), render::Vec3(0, 0, -1)};
    const auto hit = read.intersect(ray);
    std::optional<render::Bsdf> storage;
    return read.bsdf(read.surface(*hit), *hit, read.surface_point(ray, *hit), storage);
  };
  for (const char* type : {"roughdielectric", "roughconductor"}) {
    EXPECT_EQ(at(type, "alpha", 0.4, "mitsuba", -0.5).lobes().roughness, render::Float(0.4)) << type;
    EXPECT_EQ(at(type, "alpha", 0.4, "mitsuba", 0.5).lobes().roughness, render::Float(0.1)) << type;
  }
  EXPECT_NEAR(at("dielectric", "roughness", 0.4, "lajolla", -0.5).lobes().roughness, 0.16, 1e-6);
  EXPECT_NEAR(at("roughdielectric", "roughness", 0.4, "lajolla", 0.5).lobes().roughness, 0.01, 1e-6);
  const render::Vec3 up = render::Vec3::UnitZ();
  for (const auto& [name, dialect] : {std::pair("alpha", "mitsuba"), {"roughness", "lajolla"}})
    EXPECT_LT(2 * at("roughplastic", name, 0.9, dialect, -0.5).pdf(up, up),
              at("roughplastic", name, 0.9, dialect, 0.5).pdf(up, up));
  EXPECT_THAT(support::error_of([&] { at("roughplastic", "alpha", 1.5, "mitsuba", 0); }),
              testing::HasSubstr("<bsdf>: alpha: color0 (1.5, 1.5, 1.5) must lie in [0, 1]"));
}

TEST_F(PluginsTest, PlasticMayBeNonlinear) {
  const auto value = [&](const std::string& type, const std::string& more) {
    const auto file = render::read_mitsuba(scene(std::string(sensor) + "<shape type=\"sphere\"><bsdf type=\"" + type +
                                                 "\"><rgb name=\"diffuseReflectance\" value=\"0.1, 0.5, 1\"/>" + more +
                                                 "</bsdf></shape>"));
    return file.scene.bsdf(file.scene.surfaces()[0])
        .eval(render::Vec3(0.6f, 0, 0.8f), render::Vec3(0.7f, 0, 0.5f).normalized());
  };
  for (const char* type : {"plastic", "roughplastic"}) {
    const std::string alpha = std::string(type) == "plastic" ? "" : R"(<float name="alpha" value="0.001"/>)";
    const render::Spectrum linear = value(type, alpha + R"(<boolean name="nonlinear" value="false"/>)"),
                           nonlinear = value(type, alpha + R"(<boolean name="nonlinear" value="true"/>)");
    EXPECT_LT(nonlinear[0], 0.5f * linear[0]) << type;
    EXPECT_LT(nonlinear[1], 0.7f * linear[1]) << type;
    EXPECT_NEAR(nonlinear[2], linear[2], 1e-4) << type << ": white stays white";
    EXPECT_THAT(refusal(std::string(sensor) + "\n<bsdf id=\"b\" type=\"" + type +
                        R"("><boolean name="nonlinear" value="true"/><string name="base" value="lajolla"/></bsdf>)"),
                testing::HasSubstr("s.xml:3: <bsdf>: nonlinear needs the base layered"));
  }
}

// A row of the codes 0, 128 and 255.
TEST_F(PluginsTest, BitmapsAreWrappedFilteredAndDecodedAsTheySay) {
  write("row.pgm", std::string("P5 3 1 255 \0\x80\xff", 14));
  write("row.pfm", "Pf 1 1 -1 " + std::string("\0\0\x80\x3f", 4));
  const auto read = [&](const std::string& parameters, const std::string& file) {
    const auto root = render::read_xml(write("t.xml", "<texture type=\"bitmap\">\n<string name=\"filename\" value=\"" +
                                                          file + "\"/>" + parameters + "</texture>"));
    Context context(root, render::Dialect::mitsuba, render::Vec3d::Zero());
    return read_plugin(texture_plugins(), root, context);
  };
  const auto at = [&](double texel, const std::string& parameters) {
    return double(read(parameters, "row.pgm").eval({(texel + 0.5) / 3, 0.5})[0]);
  };
  const std::string nearest = R"(<string name="filter_type" value="nearest"/>)",
                    clamp = R"(<string name="wrapMode" value="clamp"/>)",
                    mirror = R"(<string name="wrap_mode" value="mirror"/>)",
                    raw = R"(<boolean name="raw" value="true"/>)";
  EXPECT_NEAR(at(1, ""), 0.2158605, 1e-6) << "sRGB";
  EXPECT_NEAR(at(1, R"(<float name="gamma" value="-1"/>)"), 0.2158605, 1e-6);
  EXPECT_NEAR(at(1, raw), 128 / 255.0, 1e-6);
  EXPECT_NEAR(at(1, R"(<float name="gamma" value="2"/>)"), 128.0 * 128 / 65025, 1e-6);
  EXPECT_NEAR(at(3, ""), 0, 1e-6) << "repeated";
  EXPECT_NEAR(at(3, clamp), 1, 1e-6);
  EXPECT_NEAR(at(4, mirror + raw), 128 / 255.0, 1e-5);
  EXPECT_NEAR(at(1.4, nearest + raw), 128 / 255.0, 1e-6);
  EXPECT_NEAR(at(1.4, raw), (0.6 * 128 + 0.4 * 255) / 255, 1e-5);
  const auto said = [&](const std::string& parameters, const std::string& file) {
    return support::error_of([&] { read(parameters, file); });
  };
  EXPECT_THAT(said(R"(<float name="gamma" value="0"/>)", "row.pgm"),
              testing::HasSubstr("t.xml:1: <texture>: gamma 0 must be > 0, or -1 for the sRGB curve"));
  EXPECT_THAT(said(R"(<float name="gamma" value="2"/>)" + raw, "row.pgm"),
              testing::HasSubstr("raw means a gamma of 1, not 2"));
  EXPECT_EQ(said(raw, "row.pfm"), "");
  EXPECT_THAT(said(R"(<float name="gamma" value="2.2"/>)", "row.pfm"),
              testing::HasSubstr("row.pfm: the values of this format are linear; leave out gamma"));
  EXPECT_THAT(said(R"(<string name="wrapMode" value="zero"/>)", "row.pgm"),
              testing::HasSubstr("t.xml:2: <string>: 'zero' is not known; use one of repeat, clamp, mirror"));
}

} // namespace
