#include <catalogue/bsdf_case.h>

#include <render/bsdf/textured_bsdf.h>

namespace carlo {

namespace {

// Adds a BSDF as renderers call it. The checks are thus compiled once for all of them.
void add(Catalogue& c, const std::string& name, const std::string& parameters, const render::Bsdf& bsdf,
         const std::vector<double>& angles, const mc::BsdfOptions& bounds = {}) {
  add_bsdf(c, name, parameters, bsdf, angles, bounds);
}

/// A phase function about -wo. Its values include the cosine, by which a BSDF is multiplied.
struct Scattering {
  render::PhaseFunction phase;

  std::optional<render::BsdfSample> sample(const render::Vec3& wo, render::Float uc, const render::Vec2& u) const {
    auto s = phase.sample(wo, uc, u);
    s->f *= std::abs(s->wi.z());
    return s;
  }
  render::Spectrum eval(const render::Vec3& wo, const render::Vec3& wi) const {
    return phase.eval(wo, wi) * std::abs(wi.z());
  }
  render::Float pdf(const render::Vec3& wo, const render::Vec3& wi) const { return phase.pdf(wo, wi); }
};

} // namespace

void add_bsdfs(Catalogue& c) {
  add(c, "Lambert", "", render::Lambert{}, {0, 60, 89.9, 120});
  const std::vector<render::Spectrum> texels = {{1, 0, 0.5f}, {0, 1, 0.5f}, {0.2f, 0.4f, 0.5f}, {1, 1, 0.5f}};
  const render::Texture picture = render::Bitmap(std::make_shared<const render::Texels>(2, 2, texels));
  add(c, "TexturedBsdf", "Lambert, between four texels",
      render::TexturedBsdf(render::Lambert(), {.diffuse_reflectance = picture}).at({0.3, 0.6}), {0, 60, 120});
  // The book's fuzzy metal is not reciprocal by definition.
  add(c, "FuzzyMetal", "fuzz=0", render::FuzzyMetal{}, {0, 60, 89.9, 120}, {.reciprocal = false});
  add(c, "FuzzyMetal", "fuzz=0.1", render::FuzzyMetal({0.9f, 0.8f, 0.7f}, render::Float(0.1)), {0, 60, 85, 89.9},
      {.reciprocal = false, .mass_tolerance = 1e-4});
  add(c, "FuzzyMetal", "fuzz=1", render::FuzzyMetal({0.9f, 0.8f, 0.7f}, 1), {0, 60, 85, 120}, {.reciprocal = false});
  add_roughness_limit(c, "FuzzyMetal", "fuzz -> 0",
                      [](render::Float fuzz) {
                        return render::FuzzyMetal({0.9f, 0.8f, 0.7f}, fuzz);
                      },
                      {0, 60, 85, 120});
  add(c, "Dielectric", "eta=1.5", render::Dielectric{}, {0, 60, 89.9, 130, 150}, {.eta = 1.5});
  const render::Spectrum paint(0.1f, 0.5f, 0.3f), one = render::Spectrum::Ones();
  // At alpha 1e-4 and 89.9 degrees the lobe is as wide as six steps of a float direction.
  const auto grazing = [](double alpha) { return alpha < 1e-3 ? 89 : 89.9; };
  for (const double alpha : {1e-4, 1e-3, 0.02, 0.3, 1.0})
    add(c, "RoughPlastic", fmt::format("LayeredBase, alpha={}", alpha),
        render::RoughPlastic(render::Float(1.49), render::Float(alpha), paint, one), {0, 60, 85, grazing(alpha), 120});
  // LajollaBase exists for comparison with lajolla and gains energy. It obeys the energy law only with colours of at
  // most .5.
  const render::Spectrum half = one / 2;
  for (const double alpha : {1e-4, 0.02, 1.0})
    add(c, "RoughPlastic", fmt::format("LajollaBase, specular=0.5, alpha={}", alpha),
        render::RoughPlastic<render::LajollaBase>(render::Float(1.49), render::Float(alpha), paint, half),
        {0, 60, 85, grazing(alpha), 120});
  const render::TexturedBsdf worn(render::RoughPlastic(render::Float(1.49), render::Float(0.1), paint, one),
                                  {.alpha = render::RoughnessTexture(picture)});
  add(c, "TexturedBsdf", "RoughPlastic of textured roughness", worn.at({0.3, 0.6}), {0, 60, 89.9, 120});
  add(c, "SmoothPlastic", "LayeredBase", render::SmoothPlastic(render::Float(1.49), paint, one), {0, 60, 89.9, 120});
  add(c, "SmoothPlastic", "LajollaBase, specular=0.5",
      render::SmoothPlastic<render::LajollaBase>(render::Float(1.49), paint, half), {0, 60, 89.9, 120});
  const render::Spectrum gold(0.143f, 0.375f, 1.442f), gold_k(3.983f, 2.386f, 1.603f);
  add(c, "SmoothConductor", "", render::SmoothConductor(gold, gold_k), {0, 60, 89.9, 120});
  for (const double alpha : {1e-4, 1e-3, 0.02, 0.3, 1.0}) {
    const std::vector<double> angles = {0, 60, grazing(alpha), 120};
    add(c, "RoughConductor", fmt::format("TrowbridgeReitzFacets, alpha={}", alpha),
        render::RoughConductor(gold, gold_k, render::TrowbridgeReitzFacets(render::Float(alpha))), angles);
    add(c, "RoughConductor", fmt::format("BeckmannFacets, alpha={}", alpha),
        render::RoughConductor(gold, gold_k, render::BeckmannFacets(render::Float(alpha))), angles);
    add(c, "RoughConductor", fmt::format("BlinnPhongFacets, alpha={}", alpha),
        render::RoughConductor(gold, gold_k, render::BlinnPhongFacets(render::Float(alpha))), angles);
  }
  for (const double alpha : {1e-4, 1e-3, 0.1, 0.5, 0.7, 1.0})
    add(c, "RoughDielectric", fmt::format("alpha={}", alpha),
        render::RoughDielectric(render::Float(1.5), render::Float(alpha)), {0, 60, grazing(alpha), 120, 150},
        {.eta = 1.5});
  for (const double alpha : {1e-3, 0.3}) {
    add(c, "RoughDielectric", fmt::format("BeckmannFacets, alpha={}", alpha),
        render::RoughDielectric<render::BeckmannFacets>(render::Float(1.5), render::Float(alpha)),
        {0, 60, grazing(alpha), 120, 150}, {.eta = 1.5});
    add(c, "RoughPlastic", fmt::format("LayeredBase, BeckmannFacets, alpha={}", alpha),
        render::RoughPlastic<render::LayeredBase, render::BeckmannFacets>(render::Float(1.49), render::Float(alpha),
                                                                          paint, one),
        {0, 60, grazing(alpha), 120});
  }
  add(c, "ThinDielectric", "eta=1.5", render::ThinDielectric{}, {0, 60, 89.9, 120});
  for (const double g : {-0.5, 0.0, 0.9, 0.99})
    add_bsdf(c, "PhaseFunction", fmt::format("g={:g}", g), Scattering{render::PhaseFunction(render::Float(g))},
             {0, 60, 120}, {.cosine = false, .lossless = true});
}

} // namespace carlo
