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

// The constant, or a placeholder for a texture.
Spectrum constant_of(const Reflectance& r) {
  const auto* color = std::get_if<Spectrum>(&r);
  return color ? *color : Spectrum(Spectrum::Constant(Float(0.5)));
}
std::optional<Texture> texture_of(const Reflectance& r) {
  if (const auto* texture = std::get_if<Texture>(&r)) return *texture;
  return {};
}

// The BSDF, with those of its parameters that are textures.
Material textured(Bsdf bsdf, BsdfTextures textures) {
  if (textures.empty()) return Material(std::move(bsdf));
  return TexturedBsdf(std::move(bsdf), std::move(textures));
}

Material make_diffuse(const Reflectance& reflectance) {
  return one_sided(textured(Lambert(constant_of(reflectance)), {.diffuse_reflectance = texture_of(reflectance)}));
}

/// Optical constants of a conductor, as the scene gives them.
struct ConductorSettings {
  std::optional<std::string> material;
  std::optional<Spectrum> eta, k;
};

// Optical constants over the index of the outside. Those of the material none, eta = 0, reflect all at every angle.
OpticalConstants constants_of(const ConductorSettings& given, double outside) {
  const auto& [material, eta, k] = given;
  mc::require(outside > 0, "index of refraction {} must be > 0", outside);
  mc::require(eta.has_value() == k.has_value(), "eta and k belong together; give both, or a material");
  mc::require(!eta || !material, "material and eta contradict each other; give the material, or eta and k");
  if (material == "none") return {Spectrum::Zero(), Spectrum::Ones()};
  const OpticalConstants c = eta ? OpticalConstants{*eta, *k} : metal_constants(material.value_or("Cu"));
  return {c.eta / Float(outside), c.k / Float(outside)};
}

Material make_conductor(const std::optional<std::string>& material, const std::optional<Spectrum>& eta,
                        const std::optional<Spectrum>& k, double outside, const Reflectance& reflectance) {
  const OpticalConstants metal = constants_of({material, eta, k}, outside);
  return one_sided(textured(SmoothConductor(metal.eta, metal.k, constant_of(reflectance)),
                            {.specular_reflectance = texture_of(reflectance)}));
}

Bsdf make_fuzzymetal(const Spectrum& albedo, double fuzz) { return FuzzyMetal(albedo, Float(fuzz)); }

/// A number or a texture.
using NumberOrTexture = std::variant<double, Texture>;

/// Root mean square slope of microfacets, and whether the file contains it.
struct Slope {
  NumberOrTexture alpha;
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

/// Roughness of facets: a number, or a texture and its lower bound.
struct Roughness {
  double alpha; ///< 0: smooth.
  std::optional<RoughnessTexture> texture = {};
};

Roughness roughness_of(const NumberOrTexture& alpha, bool is_root) {
  if (const auto* number = std::get_if<double>(&alpha)) return {*number};
  const RoughnessTexture texture(std::get<Texture>(alpha), is_root);
  return {texture.least(), texture};
}

// The roughness of lajolla is the square root of alpha. Like lajolla, replaces roughness in (0, .01) by .01.
Roughness roughness_of(const Slope& slope, const std::optional<NumberOrTexture>& root) {
  mc::require(!slope.is_given || !root, "give alpha or roughness, its square root, not both");
  if (!root) return roughness_of(slope.alpha, false);
  Roughness roughness = roughness_of(*root, true);
  if (roughness.texture || roughness.alpha == 0) return roughness;
  mc::require(roughness.alpha >= 0 && roughness.alpha <= 1, "roughness {} must lie in [0, 1]", roughness.alpha);
  constexpr double least = 0.01;
  return {mc::sqr(std::max(roughness.alpha, least))};
}

Float relative_index(double inside, double outside) {
  mc::require(inside > 0 && outside > 0, "indices of refraction {} and {} must be > 0", inside, outside);
  return Float(inside / outside);
}

// Distributions of facets, in the order of their names in distribution().
enum class FacetShape { beckmann, ggx, phong };

template <class Base>
Bsdf plastic_over(Float eta, Float alpha, FacetShape facets, const Spectrum& diffuse, const Spectrum& specular,
                  InternalReflections internal) {
  if (alpha == 0) return SmoothPlastic<Base>(eta, diffuse, specular, internal);
  if constexpr (std::is_same_v<Base, LayeredBase>)
    if (facets == FacetShape::beckmann)
      return RoughPlastic<Base, BeckmannFacets>(eta, alpha, diffuse, specular, internal);
  return RoughPlastic<Base>(eta, alpha, diffuse, specular, internal);
}

Material make_roughplastic(double inside, double outside, const Slope& slope,
                           const std::optional<NumberOrTexture>& root, const std::optional<FacetShape>& given_facets,
                           const Reflectance& diffuse, const Reflectance& specular, bool nonlinear, std::size_t base) {
  const FacetShape facets = given_facets.value_or(base == 1 ? FacetShape::ggx : FacetShape::beckmann);
  const Float eta = relative_index(inside, outside);
  const Roughness roughness = roughness_of(slope, root);
  mc::require(!nonlinear || base != 1, "nonlinear needs the base layered; that of lajolla ignores the coat");
  mc::require(facets == FacetShape::ggx || base != 1, "beckmann needs the base layered; the facets of lajolla are ggx");
  const auto internal = nonlinear ? InternalReflections::nonlinear : InternalReflections::linear;
  const auto make = base == 1 ? plastic_over<LajollaBase> : plastic_over<LayeredBase>;
  return one_sided(
      textured(make(eta, Float(roughness.alpha), facets, constant_of(diffuse), constant_of(specular), internal),
               {.diffuse_reflectance = texture_of(diffuse),
                .specular_reflectance = texture_of(specular),
                .alpha = roughness.texture}));
}

Material make_plastic(double inside, double outside, const Slope& slope, const std::optional<NumberOrTexture>& root,
                      const Reflectance& diffuse, const Reflectance& specular, bool nonlinear, std::size_t base) {
  return make_roughplastic(inside, outside, slope, root, FacetShape::ggx, diffuse, specular, nonlinear, base);
}

Bsdf glass(Float eta, Float alpha, FacetShape facets, const Spectrum& reflectance, const Spectrum& transmittance) {
  if (alpha == 0) return Dielectric(eta, reflectance, transmittance);
  if (facets == FacetShape::beckmann) return RoughDielectric<BeckmannFacets>(eta, alpha, reflectance, transmittance);
  return RoughDielectric<>(eta, alpha, reflectance, transmittance);
}

Material make_roughdielectric(double inside, double outside, const Slope& slope,
                              const std::optional<NumberOrTexture>& root, const std::optional<double>& alpha_u,
                              const std::optional<double>& alpha_v, const std::optional<FacetShape>& facets,
                              const Reflectance& reflectance, const Reflectance& transmittance) {
  const Roughness roughness = roughness_of(isotropic(slope, alpha_u, alpha_v), root);
  return textured(glass(relative_index(inside, outside), Float(roughness.alpha), facets.value_or(FacetShape::beckmann),
                        constant_of(reflectance), constant_of(transmittance)),
                  {.specular_reflectance = texture_of(reflectance),
                   .specular_transmittance = texture_of(transmittance),
                   .alpha = roughness.texture});
}

Material make_dielectric(double inside, double outside, const Slope& slope, const std::optional<NumberOrTexture>& root,
                         const Reflectance& reflectance, const Reflectance& transmittance) {
  return make_roughdielectric(inside, outside, slope, root, {}, {}, FacetShape::ggx, reflectance, transmittance);
}

Material make_thindielectric(double inside, double outside, const Reflectance& reflectance,
                             const Reflectance& transmittance) {
  return textured(
      ThinDielectric(relative_index(inside, outside), constant_of(reflectance), constant_of(transmittance)),
      {.specular_reflectance = texture_of(reflectance), .specular_transmittance = texture_of(transmittance)});
}

Material make_twosided(Material inner) {
  inner.one_sided = false;
  return inner;
}

Material make_roughconductor(const std::optional<std::string>& material, const std::optional<Spectrum>& eta,
                             const std::optional<Spectrum>& k, double outside, const Slope& slope,
                             const std::optional<double>& alpha_u, const std::optional<double>& alpha_v,
                             const std::optional<FacetShape>& given_facets, const Reflectance& reflectance) {
  const OpticalConstants metal = constants_of({material, eta, k}, outside);
  const Roughness roughness = roughness_of(isotropic(slope, alpha_u, alpha_v), {});
  const auto alpha = Float(roughness.alpha);
  const Spectrum color = constant_of(reflectance);
  const auto make = [&]() -> Bsdf {
    if (alpha == 0) return SmoothConductor(metal.eta, metal.k, color);
    switch (given_facets.value_or(FacetShape::beckmann)) {
    case FacetShape::ggx: return RoughConductor(metal.eta, metal.k, TrowbridgeReitzFacets(alpha), color);
    case FacetShape::phong: return RoughConductor(metal.eta, metal.k, BlinnPhongFacets(alpha), color);
    case FacetShape::beckmann: break;
    }
    return RoughConductor(metal.eta, metal.k, BeckmannFacets(alpha), color);
  };
  return one_sided(textured(make(), {.specular_reflectance = texture_of(reflectance), .alpha = roughness.texture}));
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
          [](const XmlElement& e, Context& context) { return context.read_bsdf(e); }};
}

Parameter<Slope> slope() {
  const auto alpha = or_texture(number("alpha", "",
                                       "root mean square slope of the facets, 0 where it is smooth, or in [0.0001, 1]; "
                                       "of a texture the channels' mean, at least 0.0001"));
  return {alpha.declared, [alpha](const XmlElement& e, Context& context) {
            return Slope{alpha.parse(e, context), true};
          }};
}
Parameter<Slope> alpha() { return slope().with_default({0.1}, "0.1").with_lajolla_default({0.01}, "0.01"); }
/// Slope parameter of smooth materials. The smooth materials of lajolla are its rough ones with another default;
/// `rough` is the rough plugin of Mitsuba.
Parameter<Slope> alpha_of_smooth(const std::string& rough) {
  return slope().with_default({0.0}, "0").lajolla_only(rough);
}
Parameter<std::optional<double>> slope_along(const std::string& name, const std::string& axis) {
  return optional(
      number(name, "", "alpha along " + axis + "; anisotropic facets are not supported, so only equal ones"));
}
Parameter<std::optional<NumberOrTexture>> roughness() {
  return optional(or_texture(number("roughness", "", "the root of alpha, in [0, 1], instead of it")))
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
  const Parameter<std::string> p{{"material", "none or a metal", "", {"string"}, meaning}, metal_of};
  return optional(p).with_default(std::nullopt, "Cu, or eta and k");
}
// Converters clip no colours outside the gamut. The Fresnel equations depend on the squares of eta and k.
Parameter<std::optional<Spectrum>> optical_constant(const std::string& name, const std::string& meaning) {
  Parameter<Spectrum> p = color(name, "", meaning);
  p.parse = [p](const XmlElement& e, Context& context) {
    const Spectrum value = p.parse(e, context);
    if ((value < 0).any())
      context.warn(e, "a negative value has no physical meaning; its sign is ignored, as in Mitsuba");
    return Spectrum(value.abs());
  };
  return optional(p);
}
Parameter<std::optional<Spectrum>> eta_of_metal() {
  return optical_constant("eta", "index of refraction, >= 0, instead of material");
}
Parameter<std::optional<Spectrum>> k_of_metal() {
  return optical_constant("k", "extinction coefficient, >= 0; not 0 where eta is");
}

Parameter<std::optional<FacetShape>> distribution(const std::vector<std::string>& names) {
  const Parameter<std::size_t> index =
      choice("distribution", names, "of the facets' normals; of lajolla's base only ggx");
  const Parameter<std::optional<FacetShape>> p{index.declared, [index](const XmlElement& e, Context& context) {
                                                 return static_cast<FacetShape>(index.parse(e, context));
                                               }};
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
      [](const XmlElement& e, Context&) { return e.tag == "string" ? index_of_medium(e) : number_of(e); }};
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
                       reflectance_or_texture("specularReflectance", "factor of what is reflected, in [0, 1]", one)),
      plugin<Material>("fuzzymetal", "the metal of [Shirley16]: mirrored directions moved by a point in a ball (ours)",
                       make_fuzzymetal,
                       reflectance("albedo", "what is reflected, in [0, 1]", Spectrum::Constant(Float(0.9))),
                       number("fuzz", "", 0, "radius of the ball, in [0, 1]")),
      plugin<Material>("dielectric", "smooth glass", make_dielectric, refractive_index("intIOR", "inside", 1.5046),
                       refractive_index("extIOR", "outside", 1.000277), alpha_of_smooth("roughdielectric"), roughness(),
                       reflectance_or_texture("specularReflectance", "factor of what is reflected, in [0, 1]", one),
                       reflectance_or_texture("specularTransmittance", "factor of what is refracted, in [0, 1]", one)),
      plugin<Material>("thindielectric", "a pane of glass too thin to displace light", make_thindielectric,
                       refractive_index("intIOR", "inside", 1.5046), refractive_index("extIOR", "outside", 1.000277),
                       reflectance_or_texture("specularReflectance", "factor of what is reflected, in [0, 1]", one),
                       reflectance_or_texture("specularTransmittance", "factor of what passes, in [0, 1]", one)),
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
                       reflectance_or_texture("specularReflectance", "factor of what is reflected, in [0, 1]", one),
                       reflectance_or_texture("specularTransmittance", "factor of what is refracted, in [0, 1]", one)),
      plugin<Material>("roughconductor", "metal with facets, of which Blinn-Phong's have the exponent 2 / alpha^2 - 2",
                       make_roughconductor, metal(), eta_of_metal(), k_of_metal(),
                       refractive_index("extEta", "outside", 1.000277), alpha(), slope_along("alphaU", "u"),
                       slope_along("alphaV", "v"), distribution({"beckmann", "ggx", "phong"}),
                       reflectance_or_texture("specularReflectance", "factor of what is reflected, in [0, 1]", one)),
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
