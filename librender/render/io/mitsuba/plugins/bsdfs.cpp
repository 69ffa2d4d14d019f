#include <render/io/metals.h>
#include <render/io/mitsuba/plugins.h>

#include <mc/core/text.h>

#include <cctype>

namespace render::mitsuba {

namespace {

// Opaque BSDFs of Mitsuba reflect on one side, unless `twosided` contains them. Context::bsdf() makes them two-sided in
// the dialect lajolla.
Material one_sided(Material material) {
  material.one_sided = true;
  return material;
}

Material make_diffuse(const Reflectance& reflectance) {
  const auto* texture = std::get_if<Texture>(&reflectance);
  return one_sided(texture ? Material(TexturedBsdf(TexturedLambert(*texture)))
                           : Material(Bsdf(Lambert(std::get<Spectrum>(reflectance)))));
}

/// Optical constants of a conductor, as the scene gives them.
struct ConductorSettings {
  std::optional<std::string> material;
  std::optional<Spectrum> eta, k;
};

// Optical constants over the index of the outside. Nothing for the material none, a perfect mirror.
std::optional<OpticalConstants> constants_of(const ConductorSettings& given, double outside) {
  const auto& [material, eta, k] = given;
  mc::require(outside > 0, "index of refraction {} must be > 0", outside);
  mc::require(eta.has_value() == k.has_value(), "eta and k belong together; give both, or a material");
  mc::require(!eta || !material, "material and eta contradict each other; give the material, or eta and k");
  if (material == "none") return {};
  const OpticalConstants c = eta ? OpticalConstants{*eta, *k} : metal_constants(material.value_or("Cu"));
  return OpticalConstants{c.eta / Float(outside), c.k / Float(outside)};
}

Material make_conductor(const std::optional<std::string>& material, const std::optional<Spectrum>& eta,
                        const std::optional<Spectrum>& k, double outside, const Spectrum& reflectance) {
  const auto constants = constants_of({material, eta, k}, outside);
  if (!constants) return one_sided(Bsdf(FuzzyMetal(reflectance, 0)));
  return one_sided(Bsdf(SmoothConductor(constants->eta, constants->k, reflectance)));
}

Bsdf make_fuzzymetal(const Spectrum& albedo, double fuzz) { return FuzzyMetal(albedo, Float(fuzz)); }

/// Root mean square slope of microfacets, and whether the file contains it.
struct Slope {
  double alpha;
  bool is_given = false;
};

// The slope from alpha, or from equal alphaU and alphaV.
Slope isotropic(const Slope& slope, const std::optional<double>& u, const std::optional<double>& v) {
  if (!u && !v) return slope;
  mc::require(u == v, "anisotropic facets are not supported: alphaU {} and alphaV {} must be equal; give alpha instead",
              u ? fmt::format("{}", *u) : "(missing)", v ? fmt::format("{}", *v) : "(missing)");
  mc::require(!slope.is_given, "give alpha, or alphaU and alphaV, not both");
  return {*u, true};
}

// The roughness of lajolla is the square root of alpha. Like lajolla, replaces roughness in (0, .01) by .01.
double alpha_of(const Slope& slope, const std::optional<double>& roughness) {
  mc::require(!slope.is_given || !roughness, "give alpha or roughness, its square root, not both");
  if (!roughness) return slope.alpha;
  mc::require(*roughness >= 0 && *roughness <= 1, "roughness {} must lie in [0, 1]", *roughness);
  constexpr double least = 0.01;
  return *roughness == 0 ? 0 : mc::sqr(std::max(*roughness, least));
}

Float relative_index(double inside, double outside) {
  mc::require(inside > 0 && outside > 0, "indices of refraction {} and {} must be > 0", inside, outside);
  return Float(inside / outside);
}

// Constant part of a reflectance: a placeholder if it is a texture.
Spectrum constant_of(const Reflectance& r) {
  const auto* color = std::get_if<Spectrum>(&r);
  return color ? *color : Spectrum(Spectrum::Constant(Float(0.5)));
}
std::optional<Texture> texture_of(const Reflectance& r) {
  if (const auto* texture = std::get_if<Texture>(&r)) return *texture;
  return {};
}

template <class Paint> Material painted(Paint paint, const Reflectance& diffuse, const Reflectance& specular) {
  std::optional<Texture> base = texture_of(diffuse), coat = texture_of(specular);
  if (!base && !coat) return one_sided(Bsdf(std::move(paint)));
  return one_sided(TexturedBsdf(TexturedPlastic<Paint>(std::move(paint), std::move(base), std::move(coat))));
}

// Distributions of facets, in the order of their names in distribution().
enum class FacetShape { beckmann, ggx, phong };

template <class Base>
Material plastic_over(Float eta, double alpha, FacetShape facets, const Reflectance& diffuse,
                      const Reflectance& specular, InternalReflections internal) {
  const Spectrum base = constant_of(diffuse), coat = constant_of(specular);
  if (alpha == 0) return painted(SmoothPlastic<Base>(eta, base, coat, internal), diffuse, specular);
  if constexpr (std::is_same_v<Base, LayeredBase>)
    if (facets == FacetShape::beckmann)
      return painted(RoughPlastic<Base, BeckmannFacets>(eta, Float(alpha), base, coat, internal), diffuse, specular);
  return painted(RoughPlastic<Base>(eta, Float(alpha), base, coat, internal), diffuse, specular);
}

Material make_roughplastic(double inside, double outside, const Slope& slope, const std::optional<double>& roughness,
                           const std::optional<FacetShape>& given_facets, const Reflectance& diffuse,
                           const Reflectance& specular, bool nonlinear, std::size_t base) {
  const FacetShape facets = given_facets.value_or(base == 1 ? FacetShape::ggx : FacetShape::beckmann);
  const Float eta = relative_index(inside, outside);
  const double alpha = alpha_of(slope, roughness);
  mc::require(!nonlinear || base != 1, "nonlinear needs the base layered; that of lajolla ignores the coat");
  mc::require(facets == FacetShape::ggx || base != 1, "beckmann needs the base layered; the facets of lajolla are ggx");
  const auto internal = nonlinear ? InternalReflections::nonlinear : InternalReflections::linear;
  return base == 1 ? plastic_over<LajollaBase>(eta, alpha, facets, diffuse, specular, internal)
                   : plastic_over<LayeredBase>(eta, alpha, facets, diffuse, specular, internal);
}

Material make_plastic(double inside, double outside, const Slope& slope, const std::optional<double>& roughness,
                      const Reflectance& diffuse, const Reflectance& specular, bool nonlinear, std::size_t base) {
  return make_roughplastic(inside, outside, slope, roughness, FacetShape::ggx, diffuse, specular, nonlinear, base);
}

Bsdf glass(Float eta, double alpha, FacetShape facets, const Spectrum& reflectance, const Spectrum& transmittance) {
  if (alpha == 0) return Dielectric(eta, reflectance, transmittance);
  if (facets == FacetShape::beckmann)
    return RoughDielectric<BeckmannFacets>(eta, Float(alpha), reflectance, transmittance);
  return RoughDielectric<>(eta, Float(alpha), reflectance, transmittance);
}

Bsdf make_dielectric(double inside, double outside, const Slope& slope, const std::optional<double>& roughness,
                     const Spectrum& reflectance, const Spectrum& transmittance) {
  return glass(relative_index(inside, outside), alpha_of(slope, roughness), FacetShape::ggx, reflectance,
               transmittance);
}

Bsdf make_roughdielectric(double inside, double outside, const Slope& slope, const std::optional<double>& roughness,
                          const std::optional<double>& alpha_u, const std::optional<double>& alpha_v,
                          const std::optional<FacetShape>& facets, const Spectrum& reflectance,
                          const Spectrum& transmittance) {
  return glass(relative_index(inside, outside), alpha_of(isotropic(slope, alpha_u, alpha_v), roughness),
               facets.value_or(FacetShape::beckmann), reflectance, transmittance);
}

Bsdf make_thindielectric(double inside, double outside, const Spectrum& reflectance, const Spectrum& transmittance) {
  return ThinDielectric(relative_index(inside, outside), reflectance, transmittance);
}

Material make_twosided(Material inner) {
  inner.one_sided = false;
  return inner;
}

Material make_roughconductor(const std::optional<std::string>& material, const std::optional<Spectrum>& eta,
                             const std::optional<Spectrum>& k, double outside, const Slope& slope,
                             const std::optional<double>& alpha_u, const std::optional<double>& alpha_v,
                             const std::optional<FacetShape>& given_facets, const Spectrum& reflectance) {
  // F is 1 at every angle for eta = 0.
  const OpticalConstants metal =
      constants_of({material, eta, k}, outside).value_or(OpticalConstants{Spectrum::Zero(), Spectrum::Ones()});
  const auto alpha = Float(isotropic(slope, alpha_u, alpha_v).alpha);
  const FacetShape facets = given_facets.value_or(FacetShape::beckmann);
  if (alpha == 0) return one_sided(Bsdf(SmoothConductor(metal.eta, metal.k, reflectance)));
  if (facets == FacetShape::beckmann)
    return one_sided(Bsdf(RoughConductor(metal.eta, metal.k, BeckmannFacets(alpha), reflectance)));
  if (facets == FacetShape::phong)
    return one_sided(Bsdf(RoughConductor(metal.eta, metal.k, BlinnPhongFacets(alpha), reflectance)));
  return one_sided(Bsdf(RoughConductor(metal.eta, metal.k, TrowbridgeReitzFacets(alpha), reflectance)));
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
  return {{"<bsdf>", "bsdf", "", {"bsdf"}, std::move(meaning)},
          [](const XmlElement& e, Context& context) { return context.read_bsdf(e); },
          {},
          {}};
}

Slope given_slope(const XmlElement& e, Context&) { return {number_of(e), true}; }

Parameter<Slope> slope() {
  return {{"alpha",
           "number",
           "",
           {"float", "integer"},
           "root mean square slope of the facets, 0 where it is smooth, or in [0.0001, 1]"},
          given_slope,
          {},
          {}};
}
Parameter<Slope> alpha() { return slope().with_default({0.1}, "0.1").with_lajolla_default({0.01}, "0.01"); }
/// Slope parameter of smooth materials. The smooth materials of lajolla are its rough ones with another default;
/// `rough` is the rough plugin of Mitsuba.
Parameter<Slope> alpha_of_smooth(const std::string& rough) {
  return slope().with_default({0}, "0").lajolla_only(rough);
}
Parameter<std::optional<double>> slope_along(const std::string& name, const std::string& axis) {
  return optional(
      number(name, "", "alpha along " + axis + "; anisotropic facets are not supported, so only equal ones"));
}
Parameter<std::optional<double>> roughness() {
  return optional(number("roughness", "", "the root of alpha, in [0, 1], instead of it"))
      .lajolla_only("alpha, its square");
}

std::string metal_of(const XmlElement& e, Context&) {
  const std::string& name = e.attribute("value");
  if (name != "none") mc::with_context(fmt::format("{}: <{}>", e.where(), e.tag), [&] { metal_constants(name); });
  return name;
}

Parameter<std::optional<std::string>> metal() {
  const std::string meaning = fmt::format(
      "none: all is reflected; or the metal, one of {}, with measured eta and k converted to RGB as spectra",
      fmt::join(metal_names(), ", "));
  const Parameter<std::string> p{{"material", "none or a metal", "", {"string"}, meaning}, metal_of, {}, {}};
  return optional(p).with_default(std::nullopt, "Cu, or eta and k");
}
Parameter<std::optional<Spectrum>> eta_of_metal() {
  return optional(color("eta", "", "index of refraction, >= 0, instead of material"));
}
Parameter<std::optional<Spectrum>> k_of_metal() {
  return optional(color("k", "", "extinction coefficient, >= 0; not 0 where eta is"));
}

Parameter<std::optional<FacetShape>> distribution(const std::vector<std::string>& names) {
  const Parameter<std::size_t> index =
      choice("distribution", names, "of the facets' normals; of lajolla's base only ggx");
  const Parameter<std::optional<FacetShape>> p{
      index.declared,
      [index](const XmlElement& e, Context& context) { return static_cast<FacetShape>(index.parse(e, context)); },
      {},
      {}};
  return p.with_default(std::nullopt, "beckmann").with_lajolla_default(FacetShape::ggx, "ggx");
}

Parameter<std::size_t> base() {
  return choice(
             "base", {"layered", "lajolla"},
             "(ours) what the base gets: what the coat lets through, or lajolla's (1 - F)^2 of the half vector, which "
             "near the horizon is more than there is",
             0)
      .with_lajolla_default(1, "lajolla");
}

Parameter<bool> nonlinear() {
  return boolean("nonlinear", "whether light between coat and base takes the colour of the base at every reflection");
}

Parameter<Reflectance> color_of_base() {
  return reflectance_or_texture("diffuseReflectance", "of the base, in [0, 1]", Spectrum::Constant(Float(0.5)));
}
Parameter<Reflectance> color_of_coat() {
  return reflectance_or_texture("specularReflectance", "factor of what the coat reflects, in [0, 1]", Spectrum::Ones());
}

struct Medium {
  std::string_view name;
  double index;
};
// At 589 nm, between 0 and 20 degrees Celsius. Source: Mitsuba 0.6, which took most of them from [Hecht02].
constexpr Medium media[] = {{"vacuum", 1},        {"helium", 1.000036},        {"hydrogen", 1.000132},
                            {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.333},
                            {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
                            {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
                            {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
                            {"pyrex", 1.47},      {"acrylic glass", 1.49},     {"polypropylene", 1.49},
                            {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
                            {"pet", 1.575},       {"diamond", 2.419}};

double index_of_medium(const XmlElement& e) {
  std::string word = e.attribute("value");
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::vector<std::string_view> names;
  for (const Medium& medium : media) {
    if (medium.name == word) return medium.index;
    names.push_back(medium.name);
  }
  e.fail(fmt::format("no index of refraction is known of '{}'{}; give a number, or one of {}", word,
                     mc::did_you_mean(word, names), fmt::join(names, ", ")));
}

Parameter<double> refractive_index(const std::string& name, const std::string& where, double fallback) {
  const Parameter<double> p{
      {name,
       "number or name",
       "",
       {"float", "integer", "string"},
       "index of refraction " + where + ", > 0, or bk7, water, ..."},
      [](const XmlElement& e, Context&) { return e.tag == "string" ? index_of_medium(e) : number_of(e); },
      {},
      {}};
  return p.with_default(fallback, fmt::format("{}", fallback));
}

} // namespace

const Plugins<Material>& bsdf_plugins() {
  static const Spectrum half = Spectrum::Constant(Float(0.5)), one = Spectrum::Ones();
  static const Plugins<Material> rows = {
      plugin<Material>("diffuse", "perfectly diffuse reflection", make_diffuse,
                       reflectance_or_texture("reflectance", "what is reflected, in [0, 1]", half)),
      plugin<Material>("conductor", "polished metal, or a perfect mirror", make_conductor, metal(), eta_of_metal(),
                       k_of_metal(), refractive_index("extEta", "outside", 1.000277),
                       reflectance("specularReflectance", "factor of what is reflected, in [0, 1]", one)),
      plugin<Material>("fuzzymetal", "the metal of [Shirley16]: mirrored directions moved by a point in a ball (ours)",
                       make_fuzzymetal,
                       reflectance("albedo", "what is reflected, in [0, 1]", Spectrum::Constant(Float(0.9))),
                       number("fuzz", "", 0, "radius of the ball, in [0, 1]")),
      plugin<Material>("dielectric", "smooth glass", make_dielectric, refractive_index("intIOR", "inside", 1.5046),
                       refractive_index("extIOR", "outside", 1.000277), alpha_of_smooth("roughdielectric"), roughness(),
                       reflectance("specularReflectance", "factor of what is reflected, in [0, 1]", one),
                       reflectance("specularTransmittance", "factor of what is refracted, in [0, 1]", one)),
      plugin<Material>("thindielectric", "a pane of glass too thin to displace light", make_thindielectric,
                       refractive_index("intIOR", "inside", 1.5046), refractive_index("extIOR", "outside", 1.000277),
                       reflectance("specularReflectance", "factor of what is reflected, in [0, 1]", one),
                       reflectance("specularTransmittance", "factor of what passes, in [0, 1]", one)),
      plugin<Material>("plastic", "polished paint: a smooth clear coat over a diffuse base", make_plastic,
                       refractive_index("intIOR", "inside", 1.49), refractive_index("extIOR", "outside", 1.000277),
                       alpha_of_smooth("roughplastic"), roughness(), color_of_base(), color_of_coat(), nonlinear(),
                       base()),
      plugin<Material>("roughplastic", "glossy paint: a rough clear coat over a diffuse base", make_roughplastic,
                       refractive_index("intIOR", "inside", 1.49), refractive_index("extIOR", "outside", 1.000277),
                       alpha(), roughness(), distribution({"beckmann", "ggx"}), color_of_base(), color_of_coat(),
                       nonlinear(), base()),
      plugin<Material>("roughdielectric", "ground glass", make_roughdielectric,
                       refractive_index("intIOR", "inside", 1.5046), refractive_index("extIOR", "outside", 1.000277),
                       alpha(), roughness(), slope_along("alphaU", "u"), slope_along("alphaV", "v"),
                       distribution({"beckmann", "ggx"}),
                       reflectance("specularReflectance", "factor of what is reflected, in [0, 1]", one),
                       reflectance("specularTransmittance", "factor of what is refracted, in [0, 1]", one)),
      plugin<Material>("roughconductor", "metal with facets, of which Blinn-Phong's have the exponent 2 / alpha^2 - 2",
                       make_roughconductor, metal(), eta_of_metal(), k_of_metal(),
                       refractive_index("extEta", "outside", 1.000277), alpha(), slope_along("alphaU", "u"),
                       slope_along("alphaV", "v"), distribution({"beckmann", "ggx", "phong"}),
                       reflectance("specularReflectance", "factor of what is reflected, in [0, 1]", one)),
      plugin<Material>("twosided", "the BSDF inside it, on both sides of the surface", make_twosided,
                       inner_bsdf("what covers both sides")),
      plugin<Material>("null", "nothing: the boundary of a medium alone", [] { return Material::invisible(); }),
      plugin<Material>(
          "mask", "the BSDF inside it, with holes", make_mask,
          reflectance_or_texture("opacity",
                                 "what the surface stops, in [0, 1]; a gray, or of a texture the channels' mean", half),
          inner_bsdf("what covers the rest")),
  };
  return rows;
}

} // namespace render::mitsuba
