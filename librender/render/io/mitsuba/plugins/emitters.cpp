#include <render/io/mitsuba/plugins.h>

namespace render::mitsuba {

namespace {

const std::string radiance_unit = "W/(m^2 sr)";

Emission make_area(const Reflectance& radiance, bool two_sided) {
  if (const auto* texture = std::get_if<Texture>(&radiance)) return {Spectrum::Ones(), two_sided, *texture};
  return {std::get<Spectrum>(radiance), two_sided};
}

ConstantBackground make_constant(const Spectrum& radiance) { return ConstantBackground(radiance); }

GradientBackground make_gradient(const Spectrum& bottom, const Spectrum& top) {
  return GradientBackground(bottom, top);
}

Environment make_envmap(const Transform& to_world, double scale, const std::shared_ptr<const Texels>& texels) {
  Transform turn; // a translation has no effect on an infinitely distant light
  turn.linear = to_world.linear;
  return Environment(texels, turn, scale);
}

PointLight make_point(const Transform& to_world, const Vec3d& position, const Spectrum& intensity) {
  return {to_world.point(position), intensity};
}

DirectionalLight make_directional(const Transform& to_world, const Vec3d& direction, const Spectrum& irradiance) {
  return {to_world.vector(direction), irradiance};
}

SpotLight make_spot(const Transform& to_world, const Spectrum& intensity, double cutoff,
                    const std::optional<double>& beam) {
  return {to_world.translation, to_world.vector(Vec3d::UnitZ()), intensity, {cutoff, beam.value_or(0.75 * cutoff)}};
}

Declaration sampling_weight() {
  return no_effect("samplingWeight", "lights are chosen by what they give where light is sought");
}

} // namespace

const Plugins<Emission>& surface_emitter_plugins() {
  static const Plugins<Emission> rows = {
      plugin<Emission>(
          "area",
          "the same radiance in every direction, from the side that the shape's normal points to; a lamp "
          "in the plane of another surface, as of a ceiling, is seen or hidden by rounding: keep them apart",
          make_area, or_texture(color("radiance", radiance_unit, "what is emitted, >= 0")),
          boolean("twoSided", "whether the other side shines too (ours)"))
          .accepting({sampling_weight()}),
  };
  return rows;
}

const Plugins<Light>& emitter_plugins() {
  static const Plugins<Light> rows = {
      plugin<Light>("constant", "the same radiance from every direction where no shape is met", make_constant,
                    color("radiance", radiance_unit, "what arrives, >= 0", Spectrum::Ones()))
          .accepting({sampling_weight()}),
      plugin<Light>("envmap", "a latitude-longitude picture of everything far away, +y its top row", make_envmap,
                    transform("toWorld", "a rotation; where it moves things is of no effect"),
                    number("scale", "", 1, "factor of the picture's values, > 0"),
                    picture("filename", "the picture: .exr, .hdr, .pfm, .png, .jpg, .bmp, .tga, .ppm or .pgm"))
          .accepting({sampling_weight()}),
      plugin<Light>("gradient", "a sky that is linear in the height of the direction (ours)", make_gradient,
                    color("bottom", radiance_unit, "what arrives from -y, >= 0", Spectrum::Ones()),
                    color("top", radiance_unit, "what arrives from +y, >= 0", Spectrum(Float(0.5), Float(0.7), 1))),
      plugin<Light>("point",
                    "a point with the same intensity in all directions; only the strategies nee, mis and mis+lt find "
                    "its light, and only mis+lt its caustics, where they are seen directly",
                    make_point, transform("toWorld", "from the light's space to the scene's"),
                    point("position", "where it is", Vec3d::Zero()),
                    color("intensity", "W/sr", "what is emitted, >= 0", Spectrum::Ones()))
          .accepting({sampling_weight()}),
      plugin<Light>("spot",
                    "a point that emits into a cone about +z, the same intensity up to beamWidth, then falling "
                    "linearly in the angle to 0 at cutoffAngle; found as point is",
                    make_spot, transform("toWorld", "from the light's space to the scene's"),
                    color("intensity", "W/sr", "what is emitted along the axis, >= 0", Spectrum::Ones()),
                    number("cutoffAngle", "degrees", 20, "from the axis to where the light ends, in (0, 180]"),
                    optional(number("beamWidth", "degrees",
                                    "from the axis to where the intensity starts to fall, in [0, cutoffAngle]"))
                        .with_default(std::nullopt, "3/4 of cutoffAngle"))
          .accepting({sampling_weight()}),
      plugin<Light>("directional",
                    "parallel light from far away; only the strategies nee, mis and mis+lt find it, and only mis+lt "
                    "its caustics, where they are seen directly",
                    make_directional,
                    transform("toWorld", "turns the direction; where it moves things is of no effect"),
                    point("direction", "in which the light goes, of any length", Vec3d::UnitZ()),
                    color("irradiance", "W/m^2", "of what it meets head-on, >= 0", Spectrum::Ones()))
          .accepting({sampling_weight()}),
  };
  return rows;
}

} // namespace render::mitsuba
