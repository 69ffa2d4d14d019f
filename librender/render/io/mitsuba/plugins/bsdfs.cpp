#include <render/io/mitsuba/plugins/plugins.h>

namespace render::mitsuba {

namespace {

const std::string share = "share of light";

Material make_diffuse(const Reflectance& reflectance) {
  if (const auto* texture = std::get_if<Texture>(&reflectance)) return TexturedLambert(*texture);
  return Bsdf(Lambert(std::get<Spectrum>(reflectance)));
}

Bsdf make_conductor(std::size_t, const Spectrum& reflectance) { return Metal(reflectance, 0); }

Bsdf make_fuzzymetal(const Spectrum& albedo, double fuzz) { return Metal(albedo, Float(fuzz)); }

Bsdf make_dielectric(double inside, double outside, const Spectrum& reflectance, const Spectrum& transmittance) {
  mc::require(inside > 0 && outside > 0, "indices of refraction {} and {} must be > 0", inside, outside);
  return Dielectric(Float(inside / outside), reflectance, transmittance);
}

Bsdf make_roughplastic(double inside, double outside, double alpha, std::size_t, const Spectrum& diffuse,
                       const Spectrum& specular, std::size_t base) {
  mc::require(inside > 0 && outside > 0, "indices of refraction {} and {} must be > 0", inside, outside);
  const Float eta = Float(inside / outside);
  if (base == 1) return RoughPlastic<LajollaBase>(eta, Float(alpha), diffuse, specular);
  return RoughPlastic(eta, Float(alpha), diffuse, specular);
}

Bsdf make_roughdielectric(double inside, double outside, double alpha, std::size_t, const Spectrum& reflectance,
                          const Spectrum& transmittance) {
  mc::require(inside > 0 && outside > 0, "indices of refraction {} and {} must be > 0", inside, outside);
  const Float eta = Float(inside / outside);
  if (alpha == 0) return Dielectric(eta, reflectance, transmittance);
  return RoughDielectric(eta, Float(alpha), reflectance, transmittance);
}

Material make_twosided(const Material& inner) { return inner; }

Bsdf make_roughconductor(const Spectrum& eta, const Spectrum& k, double outside, double alpha, std::size_t distribution,
                         const Spectrum& reflectance) {
  mc::require(outside > 0, "index of refraction {} must be > 0", outside);
  const Spectrum inner = eta / Float(outside), inner_k = k / Float(outside);
  const Float a = checked_alpha("rough conductor: alpha", Float(alpha));
  if (distribution == 1) return RoughConductor(inner, inner_k, BlinnPhongFacets(a), reflectance);
  return RoughConductor(inner, inner_k, Microfacets(a), reflectance);
}

Material make_mask(const Reflectance& opacity, Material inner) {
  mc::require(!inner.mask, "a mask inside another; make one of both");
  if (const auto* texture = std::get_if<Texture>(&opacity)) {
    inner.mask = std::make_shared<const Mask>(*texture);
  } else {
    const Spectrum& c = std::get<Spectrum>(opacity);
    mc::require(c[0] == c[1] && c[1] == c[2], "opacity ({}, {}, {}) must be the same for all colours", c[0], c[1],
                c[2]);
    inner.mask = std::make_shared<const Mask>(c[0]);
  }
  return inner;
}

Parameter<Material> inner_bsdf(std::string meaning) {
  return {{"<bsdf>", "bsdf", "", {"bsdf", "ref"}, std::move(meaning)},
          [](const XmlElement& e, Context& context) { return context.read_bsdf(e); },
          {},
          {}};
}

Parameter<double> alpha(const std::string& range) {
  return number("alpha", "", 0.1, "root mean square slope of the facets, " + range).in_lajolla(0.01, "0.01");
}

Parameter<std::size_t> distribution(const std::vector<std::string>& names) {
  return choice("distribution", names, "of the facets; Mitsuba's default, beckmann, is not supported", 0);
}

} // namespace

const Plugins<Material>& bsdf_plugins() {
  static const Spectrum half = Spectrum::Constant(Float(0.5)), one = Spectrum::Ones();
  static const Plugins<Material> rows = {
      plugin<Material>("diffuse", "perfectly diffuse reflection, alike on both sides", make_diffuse,
                       color_or_texture("reflectance", share, "what is reflected, in [0, 1]", half)),
      plugin<Material>("conductor", "a perfect mirror", make_conductor,
                       choice("material", {"none"}, "all is reflected; metals by name are not supported"),
                       color("specularReflectance", share, "factor of what is reflected, in [0, 1]", one)),
      plugin<Material>("fuzzymetal", "the metal of [Shirley16]: mirrored directions moved by a point in a ball (ours)",
                       make_fuzzymetal,
                       color("albedo", share, "what is reflected, in [0, 1]", Spectrum::Constant(Float(0.9))),
                       number("fuzz", "", 0, "radius of the ball, in [0, 1]")),
      plugin<Material>("dielectric", "smooth glass", make_dielectric,
                       number("intIOR", "", 1.5046, "index of refraction inside, > 0"),
                       number("extIOR", "", 1.000277, "index of refraction outside, > 0"),
                       color("specularReflectance", share, "factor of what is reflected, in [0, 1]", one),
                       color("specularTransmittance", share, "factor of what is refracted, in [0, 1]", one)),
      plugin<Material>("roughplastic", "glossy paint: a rough clear coat over a diffuse base", make_roughplastic,
                       number("intIOR", "", 1.49, "index of refraction inside, > 0"),
                       number("extIOR", "", 1.000277, "index of refraction outside, > 0"), alpha("in [0.0001, 1]"),
                       distribution({"ggx"}), color("diffuseReflectance", share, "of the base, in [0, 1]", half),
                       color("specularReflectance", share, "factor of what the coat reflects, in [0, 1]", one),
                       choice("base", {"layered", "lajolla"},
                              "(ours) what the base gets: what the coat lets through, or lajolla's (1 - F)^2 of the "
                              "half vector, which near the horizon is more than there is",
                              0)
                           .in_lajolla(1, "lajolla"))
          .accepting({only(false, "nonlinear", "the base keeps its colour")}),
      plugin<Material>("roughdielectric", "ground glass", make_roughdielectric,
                       number("intIOR", "", 1.5046, "index of refraction inside, > 0"),
                       number("extIOR", "", 1.000277, "index of refraction outside, > 0"),
                       alpha("0 for smooth glass, or in [0.0001, 1]"), distribution({"ggx"}),
                       color("specularReflectance", share, "factor of what is reflected, in [0, 1]", one),
                       color("specularTransmittance", share, "factor of what is refracted, in [0, 1]", one)),
      plugin<Material>("roughconductor",
                       "metal with facets of GGX, or of Blinn-Phong with the exponent 2 / alpha^2 - 2",
                       make_roughconductor, color("eta", "", "index of refraction, >= 0"),
                       color("k", "", "extinction coefficient, >= 0; not 0 where eta is"),
                       number("extEta", "", 1.000277, "index of refraction outside, > 0"), alpha("in [0.0001, 1]"),
                       distribution({"ggx", "phong"}),
                       color("specularReflectance", share, "factor of what is reflected, in [0, 1]", one)),
      plugin<Material>("twosided", "the BSDF inside it, which all of ours are on both sides", make_twosided,
                       inner_bsdf("what covers both sides")),
      plugin<Material>("mask", "the BSDF inside it, with holes", make_mask,
                       color_or_texture("opacity", "share of light",
                                        "what the surface stops, in [0, 1]; a gray, or of a texture the channels' mean",
                                        half),
                       inner_bsdf("what covers the rest")),
  };
  return rows;
}

} // namespace render::mitsuba
