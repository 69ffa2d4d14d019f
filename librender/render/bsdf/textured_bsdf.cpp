#include <render/bsdf/textured_bsdf.h>

namespace render {

namespace {

// Checks a texture, if there is one, of a parameter that the BSDF has or lacks.
void require_parameter(const std::optional<Texture>& texture, bool has_parameter, std::string_view name) {
  if (!texture) return;
  mc::require(has_parameter, "textured BSDF: this BSDF has no {}", name);
  texture->require_reflectance(name);
}

} // namespace

TexturedBsdf::TexturedBsdf(Bsdf untextured, BsdfTextures textures)
    : untextured_(std::move(untextured)), textures_(std::move(textures)) {
  untextured_ = dispatch(untextured_, [&](auto bsdf) -> Bsdf {
    require_parameter(
        textures_.diffuse_reflectance, requires { bsdf.set_diffuse_reflectance(Spectrum()); }, "diffuse reflectance");
    require_parameter(
        textures_.specular_reflectance, requires { bsdf.set_specular_reflectance(Spectrum()); },
        "specular reflectance");
    require_parameter(
        textures_.specular_transmittance, requires { bsdf.set_specular_transmittance(Spectrum()); },
        "specular transmittance");
    if constexpr (requires { bsdf.set_alpha(Float()); }) {
      if (textures_.alpha) {
        if constexpr (requires { bsdf.prepare_alpha(); }) bsdf.prepare_alpha();
        bsdf.set_alpha(textures_.alpha->least());
      }
    } else {
      mc::require(!textures_.alpha, "textured BSDF: this BSDF has no alpha");
    }
    return bsdf;
  });
  const auto& [diffuse, specular, transmitted, alpha] = textures_;
  for (const auto* texture : {&diffuse, &specular, &transmitted})
    is_filtered_ = is_filtered_ || (*texture && (*texture)->is_filtered());
  is_filtered_ = is_filtered_ || (alpha && alpha->is_filtered());
}

Bsdf TexturedBsdf::at(const Vec2d& uv, Float footprint) const {
  return dispatch(untextured_, [&](auto bsdf) -> Bsdf {
    const auto color = [&](const Texture& t) { return Spectrum(t.eval(uv, footprint).min(Float(1))); };
    if constexpr (requires { bsdf.set_alpha(Float()); })
      if (textures_.alpha) bsdf.set_alpha(textures_.alpha->at(uv, footprint));
    if constexpr (requires { bsdf.set_diffuse_reflectance(Spectrum()); })
      if (const auto& t = textures_.diffuse_reflectance) bsdf.set_diffuse_reflectance(color(*t));
    if constexpr (requires { bsdf.set_specular_reflectance(Spectrum()); })
      if (const auto& t = textures_.specular_reflectance) bsdf.set_specular_reflectance(color(*t));
    if constexpr (requires { bsdf.set_specular_transmittance(Spectrum()); })
      if (const auto& t = textures_.specular_transmittance) bsdf.set_specular_transmittance(color(*t));
    return bsdf;
  });
}

} // namespace render
