#include <render/io/mitsuba/plugins/plugins.h>

namespace render::mitsuba {

namespace {

const std::string radiance_unit = "W/(m^2 sr)";

Emission make_area(const Spectrum& radiance, bool two_sided) { return {radiance, two_sided}; }

ConstantBackground make_constant(const Spectrum& radiance) { return ConstantBackground(radiance); }

GradientBackground make_gradient(const Spectrum& bottom, const Spectrum& top) {
  return GradientBackground(bottom, top);
}

Environment make_envmap(const Transform& to_world, double scale, const std::shared_ptr<const Texels>& texels) {
  Transform turn; // where it stands says nothing of what is infinitely far away
  turn.linear = to_world.linear;
  return Environment(texels, turn, scale);
}

} // namespace

const Plugins<Emission>& surface_emitter_plugins() {
  static const Plugins<Emission> rows = {
      plugin<Emission>("area", "the same radiance in every direction, from the side that the shape's normal points to",
                       make_area, color("radiance", radiance_unit, "what is emitted, >= 0"),
                       boolean("twoSided", "whether the other side shines too (ours)")),
  };
  return rows;
}

const Plugins<Light>& emitter_plugins() {
  static const Plugins<Light> rows = {
      plugin<Light>("constant", "the same radiance from every direction where no shape is met", make_constant,
                    color("radiance", radiance_unit, "what arrives, >= 0", Spectrum::Ones())),
      plugin<Light>("envmap", "a latitude-longitude picture of everything far away, +y its top row", make_envmap,
                    transform("toWorld", "a rotation; where it moves things is of no effect"),
                    number("scale", "", 1, "factor of the picture's values, > 0"),
                    picture("filename", "the picture: .exr, .pfm, .png or .jpg"))
          .accepting({no_effect("samplingWeight", "lights are chosen by what they give where light is sought")}),
      plugin<Light>("gradient", "a sky that is linear in the height of the direction (ours)", make_gradient,
                    color("bottom", radiance_unit, "what arrives from -y, >= 0", Spectrum::Ones()),
                    color("top", radiance_unit, "what arrives from +y, >= 0", Spectrum(Float(0.5), Float(0.7), 1))),
  };
  return rows;
}

} // namespace render::mitsuba
