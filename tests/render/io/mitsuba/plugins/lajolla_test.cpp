// Parameters that the loader of lajolla reads and Mitsuba does not.

#include <render/io/mitsuba/plugins.h>

#include "render/io/mitsuba/scene_text.h"

namespace {

using namespace render::mitsuba;
using render::Dialect;
using testing::AllOf, testing::HasSubstr;

struct Lajolla : support::SceneTest {
  render::SceneFile filtered(const std::string& rfilter, Dialect dialect = Dialect::lajolla) const {
    return render::read_mitsuba(scene(with_filter(rfilter)), dialect);
  }
  render::Bsdf bsdf(const std::string& type, const std::string& parameters, Dialect dialect = Dialect::lajolla) const {
    const auto root = render::read_xml(write("b.xml", "<bsdf type=\"" + type + "\">" + parameters + "</bsdf>"));
    Context context(root, dialect, render::Vec3d::Zero());
    return read_plugin(bsdf_plugins(), root, context).bsdf;
  }
  static std::string with_filter(const std::string& rfilter) {
    return "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/><film type=\"hdrfilm\">\n" + rfilter +
           "</film></sensor><shape type=\"sphere\"/>";
  }
};

std::string rfilter_of(const std::string& type, const std::string& name = "", const std::string& value = "") {
  const std::string parameter = name.empty() ? "" : "<float name=\"" + name + "\" value=\"" + value + "\"/>";
  return "<rfilter type=\"" + type + "\">" + parameter + "</rfilter>";
}

TEST_F(Lajolla, TheWidthOfAFilterIsTwiceItsRadius) {
  const auto radius = [&](const std::string& rfilter) { return filtered(rfilter).scene.filter().radius(); };
  EXPECT_EQ(radius(rfilter_of("box", "width", "3")), 1.5);
  EXPECT_EQ(radius(rfilter_of("tent", "width", "3")), 1.5);
  EXPECT_EQ(radius(rfilter_of("box")), 0.5);
  EXPECT_EQ(radius(rfilter_of("tent")), 1);
  EXPECT_THAT(filtered(rfilter_of("tent", "width", "3")).warnings, testing::IsEmpty());

  // lajolla ignores radius: it has an effect here, and a warning names it.
  const render::SceneFile by_radius = filtered(rfilter_of("tent", "radius", "2"));
  EXPECT_EQ(by_radius.scene.filter().radius(), 2);
  EXPECT_THAT(by_radius.warnings,
              testing::ElementsAre(AllOf(HasSubstr("s.xml:3: <float>: lajolla leaves radius out, here it counts"),
                                         HasSubstr("say width"))));
  EXPECT_THAT(filtered(rfilter_of("tent", "radius", "2"), Dialect::mitsuba).warnings, testing::IsEmpty());

  EXPECT_THAT(refusal(with_filter(rfilter_of("box", "width", "1"))),
              HasSubstr("s.xml:3: <float>: 'width' is lajolla's; say radius, its half, or --dialect lajolla"));
  const std::string both = "<rfilter type=\"box\"><float name=\"width\" value=\"1\"/><float name=\"radius\" "
                           "value=\"1\"/></rfilter>";
  EXPECT_THAT(refusal(with_filter(both), Dialect::lajolla),
              HasSubstr("s.xml:3: <rfilter>: give width or radius, its half, not both"));
  EXPECT_NE(refusal(with_filter(rfilter_of("box", "width", "0")), Dialect::lajolla), "");
}

TEST_F(Lajolla, RoughnessIsTheRootOfAlpha) {
  const render::Spectrum half = render::Spectrum::Constant(0.5f), one = render::Spectrum::Ones();
  const auto close = [](const render::Bsdf& a, const render::Bsdf& b) {
    const render::Vec3 wo = render::Vec3(0.5f, 0, 1).normalized(), wi = render::Vec3(-0.45f, 0.05f, 1).normalized();
    const render::Spectrum f = a.eval(wo, wi), g = b.eval(wo, wi);
    return a.index() == b.index() && (f - g).abs().maxCoeff() <= 1e-5f * g.maxCoeff();
  };
  const float eta = float(1.49 / 1.000277), glass = float(1.5046 / 1.000277);
  for (const double roughness : {1.0, 0.5, 0.1, 0.01, 0.002}) {
    const auto alpha = render::Float(std::max(roughness * roughness, 1e-4)); // the smallest alpha of lajolla
    const std::string given = fmt::format("<float name=\"roughness\" value=\"{}\"/>", roughness);
    EXPECT_TRUE(close(bsdf("roughplastic", given), render::RoughPlastic<render::LajollaBase>(eta, alpha, half, one)))
        << roughness;
    EXPECT_TRUE(close(bsdf("roughdielectric", given), render::RoughDielectric(glass, alpha))) << roughness;
    EXPECT_TRUE(close(bsdf("dielectric", given), render::RoughDielectric(glass, alpha))) << roughness;
  }
  const std::string smooth = "<float name=\"roughness\" value=\"0\"/>";
  EXPECT_TRUE(std::holds_alternative<render::SmoothPlastic<render::LajollaBase>>(bsdf("roughplastic", smooth)));
  for (const std::string& said : {std::string(), smooth})
    EXPECT_TRUE(std::holds_alternative<render::SmoothPlastic<render::LajollaBase>>(bsdf("plastic", said)));
  EXPECT_TRUE(std::holds_alternative<render::Dielectric>(bsdf("roughdielectric", smooth)));
  EXPECT_TRUE(std::holds_alternative<render::Dielectric>(bsdf("dielectric", "")));
}

TEST_F(Lajolla, RoughnessAndAlphaExcludeEachOther) {
  const auto said = [&](const std::string& type, const std::string& parameters, Dialect dialect = Dialect::lajolla) {
    return refusal(std::string(sensor) + "<bsdf id=\"b\" type=\"" + type + "\">\n" + parameters + "</bsdf>", dialect);
  };
  const std::string roughness = "<float name=\"roughness\" value=\"0.1\"/>",
                    alpha = "<float name=\"alpha\" value=\"0.1\"/>", much = "<float name=\"roughness\" value=\"1.5\"/>";
  EXPECT_THAT(said("roughplastic", roughness + alpha),
              HasSubstr("s.xml:2: <bsdf>: give alpha or roughness, its square root, not both"));
  EXPECT_THAT(said("roughdielectric", much), HasSubstr("s.xml:2: <bsdf>: roughness 1.5 must lie in [0, 1]"));
  EXPECT_THAT(said("roughplastic", roughness, Dialect::mitsuba),
              HasSubstr("s.xml:3: <float>: 'roughness' is lajolla's; say alpha, its square, or --dialect lajolla"));
  EXPECT_THAT(said("dielectric", alpha, Dialect::mitsuba),
              HasSubstr("s.xml:3: <float>: 'alpha' is lajolla's; say roughdielectric, or --dialect lajolla"));
}

// In both dialects: the delta lobe that is the limit of the rough lobes.
TEST_F(Lajolla, WithoutRoughnessMaterialsAreSmooth) {
  const std::string alpha = "<float name=\"alpha\" value=\"0\"/>", metal = alpha + "<float name=\"eta\" value=\"0.2\"/>"
                                                                                   "<float name=\"k\" value=\"3\"/>";
  for (const Dialect dialect : {Dialect::lajolla, Dialect::mitsuba}) {
    EXPECT_TRUE(bsdf("roughplastic", alpha, dialect).lobes().has_delta);
    EXPECT_TRUE(bsdf("roughdielectric", alpha, dialect).lobes().is_delta());
    EXPECT_TRUE(bsdf("roughconductor", metal, dialect).lobes().is_delta());
  }
  const std::string phong = "<string name=\"distribution\" value=\"phong\"/>";
  EXPECT_TRUE(std::holds_alternative<render::SmoothConductor>(bsdf("roughconductor", metal + phong)));
}

// Film parameters that change the image of Mitsuba and that lajolla ignores.
TEST_F(Lajolla, WhatItsFilmLeavesOutIsNamed) {
  const auto film = [](const std::string& parameter) {
    return "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/><film type=\"ldrfilm\">\n" + parameter +
           "</film></sensor><shape type=\"sphere\"/>";
  };
  struct Row {
    const char *tag, *name, *done, *not_done, *remedy;
  };
  for (const Row& row :
       {Row{"float", "gamma", "-1", "2.2", "say -1"}, Row{"float", "exposure", "0", "1.5", "--exposure"},

        Row{"string", "pixelFormat", "rgba", "luminance", "rgb"}}) {
    const auto with = [&](const char* value) {
      return film(fmt::format("<{} name=\"{}\" value=\"{}\"/>", row.tag, row.name, value));
    };
    for (const Dialect dialect : {Dialect::mitsuba, Dialect::lajolla})
      EXPECT_THAT(render::read_mitsuba(scene(with(row.done)), dialect).warnings, testing::IsEmpty()) << row.name;
    const auto place_and_remedy =
        AllOf(HasSubstr("s.xml:3: <" + std::string(row.tag) + ">: "), HasSubstr(row.not_done), HasSubstr(row.remedy));
    if (std::string_view(row.name) == "gamma")
      EXPECT_THAT(render::read_mitsuba(scene(with(row.not_done))).warnings, testing::ElementsAre(place_and_remedy));
    else EXPECT_THAT(refusal(with(row.not_done)), place_and_remedy);
    EXPECT_THAT(render::read_mitsuba(scene(with(row.not_done)), Dialect::lajolla).warnings,
                testing::ElementsAre(AllOf(HasSubstr("s.xml:3: <" + std::string(row.tag) + ">: "), HasSubstr(row.name),
                                           HasSubstr(row.not_done), HasSubstr("nor does lajolla look at it"))));
  }
}

TEST_F(Lajolla, OneScaleIsForUAndV) {
  const auto at = [&](const std::string& parameters, double u, double v, Dialect dialect = Dialect::lajolla) {
    const auto root = render::read_xml(write("t.xml", "<texture type=\"checkerboard\">" + parameters + "</texture>"));
    Context context(root, dialect, render::Vec3d::Zero());
    return double(read_plugin(texture_plugins(), root, context).eval({u, v})[0]);
  };
  const std::string both = "<float name=\"uvscale\" value=\"3\"/>", u = "<float name=\"uscale\" value=\"3\"/>",
                    v = "<float name=\"vscale\" value=\"3\"/>";
  int dark = 0;
  for (double x = 0.01; x < 1; x += 0.03)
    for (double y = 0.013; y < 1; y += 0.03) {
      EXPECT_EQ(at(both, x, y), at(u + v, x, y)) << x << " " << y;
      dark += at(both, x, y) < 0.3;
    }
  EXPECT_GT(dark, 200);
  EXPECT_THAT(support::error_of([&] { at(both, 0, 0, Dialect::mitsuba); }),
              HasSubstr("t.xml:1: <float>: 'uvscale' is lajolla's; say uscale and vscale, or --dialect lajolla"));
  EXPECT_THAT(support::error_of([&] { at(u + both, 0, 0); }),
              HasSubstr("t.xml:1: <texture>: give uvscale, or uscale and vscale, not both"));
}

} // namespace
