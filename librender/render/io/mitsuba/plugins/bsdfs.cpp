#include <render/io/mitsuba/plugins/plugins.h>

namespace render::mitsuba {

namespace {

const std::string share = "share of light";

MaterialText make_diffuse(const Reflectance& reflectance) {
  if (const auto* texture = std::get_if<Texture>(&reflectance)) return TexturedLambert(*texture);
  return Lambert(std::get<Spectrum>(reflectance));
}

Metal make_conductor(std::size_t, const Spectrum& reflectance) { return Metal(reflectance, 0); }

Metal make_fuzzymetal(const Spectrum& albedo, double fuzz) { return Metal(albedo, Float(fuzz)); }

Dielectric make_dielectric(double inside, double outside, const Spectrum& reflectance, const Spectrum& transmittance) {
  mc::require(inside > 0 && outside > 0, "indices of refraction {} and {} must be > 0", inside, outside);
  return Dielectric(Float(inside / outside), reflectance, transmittance);
}

Bsdf make_roughplastic(double inside, double outside, double alpha, std::size_t, const Spectrum& diffuse,
                       const Spectrum& specular) {
  mc::require(inside > 0 && outside > 0, "indices of refraction {} and {} must be > 0", inside, outside);
  return RoughPlastic(Float(inside / outside), Float(alpha), diffuse, specular);
}

Bsdf make_roughdielectric(double inside, double outside, double alpha, std::size_t, const Spectrum& reflectance,
                          const Spectrum& transmittance) {
  mc::require(inside > 0 && outside > 0, "indices of refraction {} and {} must be > 0", inside, outside);
  const Float eta = Float(inside / outside);
  if (alpha == 0) return Dielectric(eta, reflectance, transmittance);
  return RoughDielectric(eta, Float(alpha), reflectance, transmittance);
}

MaterialText make_twosided(const MaterialText& inner) { return inner; }

Parameter<MaterialText> inner_bsdf() {
  return {{"<bsdf>", "bsdf", "", {"bsdf", "ref"}, "what covers both sides"},
          [](const XmlElement& e, Context& context) { return context.read_bsdf(e); },
          {},
          {}};
}

Parameter<double> alpha(const std::string& range) {
  return number("alpha", "", 0.1, "root mean square slope of the facets, " + range).in_lajolla(0.01, "0.01");
}

Parameter<std::size_t> distribution() {
  return choice("distribution", {"ggx"}, "of the facets; Mitsuba's default, beckmann, is not supported", 0);
}

} // namespace

const Plugins<MaterialText>& bsdf_plugins() {
  static const Spectrum half = Spectrum::Constant(Float(0.5)), one = Spectrum::Ones();
  static const Plugins<MaterialText> rows = {
      plugin<MaterialText>("diffuse", "perfectly diffuse reflection, alike on both sides", make_diffuse,
                           color_or_texture("reflectance", share, "what is reflected, in [0, 1]", half)),
      plugin<MaterialText>("conductor", "a perfect mirror", make_conductor,
                           choice("material", {"none"}, "all is reflected; metals by name are not supported"),
                           color("specularReflectance", share, "factor of what is reflected, in [0, 1]", one)),
      plugin<MaterialText>(
          "fuzzymetal", "the metal of [Shirley16]: mirrored directions moved by a point in a ball (ours)",
          make_fuzzymetal, color("albedo", share, "what is reflected, in [0, 1]", Spectrum::Constant(Float(0.9))),
          number("fuzz", "", 0, "radius of the ball, in [0, 1]")),
      plugin<MaterialText>("dielectric", "smooth glass", make_dielectric,
                           number("intIOR", "", 1.5046, "index of refraction inside, > 0"),
                           number("extIOR", "", 1.000277, "index of refraction outside, > 0"),
                           color("specularReflectance", share, "factor of what is reflected, in [0, 1]", one),
                           color("specularTransmittance", share, "factor of what is refracted, in [0, 1]", one)),
      plugin<MaterialText>("roughplastic",
                           "glossy paint: a rough clear coat over a diffuse base, without inner scattering",
                           make_roughplastic, number("intIOR", "", 1.49, "index of refraction inside, > 0"),
                           number("extIOR", "", 1.000277, "index of refraction outside, > 0"), alpha("in [0.0001, 1]"),
                           distribution(), color("diffuseReflectance", share, "of the base, in [0, 1]", half),
                           color("specularReflectance", share, "factor of what the coat reflects, in [0, 1]", one))
          .accepting({only(false, "nonlinear", "the base keeps its colour")}),
      plugin<MaterialText>("roughdielectric", "ground glass", make_roughdielectric,
                           number("intIOR", "", 1.5046, "index of refraction inside, > 0"),
                           number("extIOR", "", 1.000277, "index of refraction outside, > 0"),
                           alpha("0 for smooth glass, or in [0.0001, 1]"), distribution(),
                           color("specularReflectance", share, "factor of what is reflected, in [0, 1]", one),
                           color("specularTransmittance", share, "factor of what is refracted, in [0, 1]", one)),
      plugin<MaterialText>("twosided", "the BSDF inside it, which all of ours are on both sides", make_twosided,
                           inner_bsdf()),
  };
  return rows;
}

} // namespace render::mitsuba
