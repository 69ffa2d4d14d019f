#include <render/io/mitsuba/plugins.h>

namespace render::mitsuba {

namespace {

constexpr int default_spp = 4;
constexpr std::size_t diagonal = 4; // index in fovAxis

SensorSettings make_sensor(const Transform& to_world, double fov, std::size_t axis, double near, double far,
                           const std::optional<double>& focus_distance, const FilmSettings& film, int spp,
                           double radius) {
  constexpr FovAxis axes[] = {FovAxis::x, FovAxis::y, FovAxis::smaller, FovAxis::larger, FovAxis::diagonal};
  const double focus = focus_distance.value_or(std::isfinite(far) ? far : 1e4);
  return {ThinLens(to_world, {axes[axis], fov, radius, focus, near, far}), film, spp};
}

// Diagonal field of view of a lens on 35 mm film, 36 mm by 24 mm [degrees].
double diagonal_fov(double focal_length) {
  return 360 / mc::pi<double> * std::atan(std::hypot(36.0, 24.0) / (2 * focal_length));
}

SensorSettings make_perspective(const Transform& to_world, const std::optional<double>& fov, std::size_t axis,
                                double near, double far, const std::optional<double>& focus_distance,
                                const FilmSettings& film, int spp, const std::optional<double>& focal_length) {
  mc::require(!fov || !focal_length, "perspective: give fov or focalLength, not both");
  mc::require(!focal_length || *focal_length > 0, "perspective: focalLength {} must be > 0", focal_length.value_or(0));
  if (fov) return make_sensor(to_world, *fov, axis, near, far, focus_distance, film, spp, 0);
  return make_sensor(to_world, diagonal_fov(focal_length.value_or(50)), diagonal, near, far, focus_distance, film, spp,
                     0);
}

SensorSettings make_thinlens(const Transform& to_world, double fov, std::size_t axis, double near, double far,
                             const std::optional<double>& focus_distance, const FilmSettings& film, int spp,
                             const std::optional<double>& radius, const std::optional<double>& f_number,
                             const std::optional<double>& focal_length) {
  mc::require(radius.has_value() != f_number.has_value() && f_number.has_value() == focal_length.has_value(),
              "thinlens: give apertureRadius, or fNumber and focalLength together");
  mc::require(!f_number || *f_number > 0, "thinlens: fNumber {} must be > 0", f_number.value_or(0));
  return make_sensor(to_world, fov, axis, near, far, focus_distance, film, spp,
                     radius ? *radius : *focal_length / (2 * *f_number));
}

// Mitsuba's film spans [-1, 1] of the frame's x axis, whose length is the scale of toWorld. The length of the z axis
// has no meaning.
SensorSettings make_orthographic(Transform to_world, double near, double far, const FilmSettings& film, int spp) {
  LensOptions lens;
  lens.half_width = to_world.linear.col(0).norm();
  to_world.linear.col(2) = to_world.linear.col(2).normalized() * lens.half_width;
  lens.near = near;
  lens.far = far;
  return {ThinLens(to_world, lens), film, spp};
}

Parameter<double> fov() { return number("fov", "degrees", "field of view along fovAxis, in (0, 180)"); }

// Reads a length such as "50mm".
double millimetres_of(const XmlElement& e, Context&) {
  std::string text = e.attribute("value");
  if (text.ends_with("mm")) text.resize(text.size() - 2);
  return parse_number(e, text);
}

Parameter<Transform> frame() { return transform("toWorld", "the camera's frame: x to the left, y up, z forward"); }
Parameter<double> near_clip() {
  return number("nearClip", "scene units", 0, "what stands closer before the lens is cut away");
}
Parameter<double> far_clip() {
  return number("farClip", "scene units", mc::infinity<double>, "what stands farther is cut away, > nearClip");
}
Parameter<FilmSettings> film_of_sensor() {
  const FilmSettings by_mitsuba{768, 576, GaussianFilter()}, by_lajolla{256, 256, BoxFilter()};
  return nested("film", "the picture", film_plugins)
      .with_default(by_mitsuba, "hdrfilm")
      .with_lajolla_default(by_lajolla, "hdrfilm");
}
Parameter<int> sampler_of_sensor() {
  return nested("sampler", "how many samples", sampler_plugins).with_default(default_spp, "independent");
}

Parameter<std::optional<NamedMedium>> medium_of_sensor() {
  return optional(Parameter<NamedMedium>{
      {"<medium>", "medium", "", {"medium"}, "what is around the camera, and outside of shapes without it inside"},
      read_medium});
}

template <class Make> struct InMedium {
  Make make;
  template <class... Values>
  SensorSettings operator()(const std::optional<NamedMedium>& medium, const Values&... values) const {
    SensorSettings settings = make(values...);
    settings.medium = medium;
    return settings;
  }
};

// A row for a camera with a field of view.
template <class Make, class Fov, class... V>
Plugin<SensorSettings> sensor_plugin(std::string name, std::string meaning, Make make, const Parameter<Fov>& fov,
                                     const Parameter<V>&... parameters) {
  return plugin<SensorSettings>(
      std::move(name), std::move(meaning), InMedium<Make>{make}, medium_of_sensor(), frame(), fov,
      choice("fovAxis", {"x", "y", "smaller", "larger", "diagonal"}, "the side of the film that fov spans", 0),
      near_clip(), far_clip(),
      optional(number("focusDistance", "scene units", "to the plane in focus; of no effect for a pinhole"))
          .with_default(std::nullopt, "farClip, or 1e4"),
      film_of_sensor(), sampler_of_sensor(), parameters...);
}

FilmSettings make_film(int width, int height, const Filter& filter, double, double, std::size_t) {
  mc::require(width >= 1 && height >= 1, "size {}x{} needs at least one pixel", width, height);
  return {width, height, filter};
}

// Restricts a parameter that would change the image of Mitsuba to its default. lajolla ignores the parameter.
//   is_refused : whether another value is an error; else it is a warning.
template <class T> Parameter<T> only_default(const Parameter<T>& p, const std::string& remedy, bool is_refused = true) {
  Parameter<T> only = p;
  only.declared.meaning += "; only this is supported: " + remedy;
  only.parse = [p, remedy, is_refused](const XmlElement& e, Context& context) {
    if (p.parse(e, context) == *p.fallback) return *p.fallback;
    const std::string what = fmt::format("{} = {} is not supported", p.declared.name, e.attribute("value"));
    const bool is_lajolla = context.dialect() == Dialect::lajolla;
    if (!is_lajolla && is_refused) e.fail(fmt::format("{}; {}", what, remedy));
    context.warn(e, fmt::format("{}{}; {}", what, is_lajolla ? ", nor does lajolla look at it" : "", remedy));
    return *p.fallback;
  };
  return only;
}

// Images contain colours only, so there is no alpha channel to omit.
Parameter<std::size_t> pixel_format() {
  auto p = choice("pixelFormat", {"rgb", "rgba"}, "colours; there is no alpha in them", 0);
  p.parse = [of_mitsuba = p.parse](const XmlElement& e, Context& context) {
    if (context.dialect() == Dialect::mitsuba) return of_mitsuba(e, context);
    const std::string& word = e.attribute("value");
    if (word != "rgb" && word != "rgba")
      context.warn(e, fmt::format("pixelFormat = {} is not supported, nor does lajolla look at it; say rgb", word));
    return std::size_t{0};
  };
  return p;
}

Plugin<FilmSettings> film_plugin(std::string name) {
  std::vector<Declaration> ignored;
  for (const char* other : {"fileFormat", "componentFormat", "attachLog", "filename"})
    ignored.push_back(no_effect(other, "the command line says what is written"));
  ignored.push_back(no_effect("banner", "none is drawn into the picture"));
  ignored.push_back(no_effect("highQualityEdges", "pixels at the edges always get the light of their whole filter"));
  return plugin<FilmSettings>(
             std::move(name), "the size of the picture and its filter", make_film,
             integer("width", "pixels in a row", 768).with_lajolla_default(256, "256"),
             integer("height", "rows", 576).with_lajolla_default(256, "256"),
             nested("rfilter", "how samples make a pixel", filter_plugins)
                 .with_default(GaussianFilter(), "gaussian")
                 .with_lajolla_default(BoxFilter(), "box"),
             only_default(number("gamma", "", -1, "of a PNG, by the sRGB curve"), "remove it, or say -1", false),
             only_default(number("exposure", "stops", 0, "of a PNG"), "remove it and say carlo render --exposure"),
             pixel_format())
      .accepting(ignored);
}

// Radius of a filter. Its size parameter is the radius in Mitsuba and the width in lajolla.
double radius_of(const std::optional<double>& radius, const std::optional<double>& width, double fallback) {
  mc::require(!radius || !width, "give width or radius, its half, not both");
  return width ? *width / 2 : radius.value_or(fallback);
}

constexpr double box_radius = 0.5, tent_radius = 1;

BoxFilter make_box(const std::optional<double>& radius, const std::optional<double>& width) {
  return BoxFilter(Float(radius_of(radius, width, box_radius)));
}
TentFilter make_tent(const std::optional<double>& radius, const std::optional<double>& width) {
  return TentFilter(Float(radius_of(radius, width, tent_radius)));
}

Parameter<std::optional<double>> half_side(double fallback) {
  return optional(number("radius", "pixels", "half its side, > 0"))
      .with_default(std::nullopt, fmt::format("{}", fallback))
      .ignored_by_lajolla("width, which is twice that");
}
Parameter<std::optional<double>> side() {
  return optional(number("width", "pixels", "its side, > 0, instead of radius")).lajolla_only("radius, its half");
}

GaussianFilter make_gaussian(double stddev) { return GaussianFilter(Float(stddev)); }
SubpixelTentFilter make_subpixeltent(int n, double radius) { return SubpixelTentFilter(n, Float(radius)); }

int make_distribution(int samples) {
  mc::require(samples >= 1, "sampleCount {} must be at least 1", samples);
  return samples;
}

Plugin<int> sampler_plugin(std::string name) {
  return plugin<int>(std::move(name), "samples per pixel; which points they are, --sampler says", make_distribution,
                     integer("sampleCount", "samples per pixel, >= 1", default_spp))
      .accepting({no_effect("seed", "--seed says it"), no_effect("dimension", "our points have as many as are needed"),
                  no_effect("scramble", "our points are always randomised"),
                  no_effect("jitter", "our points are always randomised")});
}

IntegratorSettings make_direct() { return {.max_depth = 2}; }

IntegratorSettings make_normals() { return {.aov = Aov::normals}; }

IntegratorSettings make_ao(double ray_length) {
  mc::require(ray_length > 0, "rayLength {} must be > 0; Mitsuba's automatic length, -1, is not supported", ray_length);
  return {.aov = {Aov::ambient_occlusion, ray_length}};
}

IntegratorSettings make_path(int max_depth) {
  mc::require(max_depth == -1 || max_depth >= 1, "maxDepth {} must be -1 or at least 1", max_depth);
  return {.max_depth = max_depth};
}

IntegratorSettings make_same(const IntegratorSettings& inner) { return inner; }

Plugin<IntegratorSettings> path(std::string name, std::string meaning) {
  return plugin<IntegratorSettings>(std::move(name), std::move(meaning), make_path,
                                    integer("maxDepth", "longest path in edges; -1: no limit", -1))
      .accepting({no_effect("rrDepth", "Russian roulette follows the throughput"),
                  no_effect("strictNormals", "the geometry always decides on which side light is"),
                  no_effect("version", "lajolla's, which have the same mean where they apply"),
                  only(false, "hideEmitters", "lights are seen")});
}

Plugin<IntegratorSettings> wrapper(std::string name, std::string meaning) {
  return plugin<IntegratorSettings>(std::move(name), std::move(meaning), make_same,
                                    nested("integrator", "what renders the picture", integrator_plugins));
}

} // namespace

const Plugins<SensorSettings>& sensor_plugins() {
  static const Plugins<SensorSettings> rows = {
      sensor_plugin("perspective", "a pinhole camera", make_perspective,
                    optional(fov()).with_default(std::nullopt, "by focalLength").with_lajolla_default(45.0, "45"),
                    optional(Parameter<double>{{"focalLength",
                                                "length, as 50mm",
                                                "mm",
                                                {"string"},
                                                "of a lens that sees as much of 35 mm film's diagonal, instead of fov"},
                                               millimetres_of})
                        .with_default(std::nullopt, "50mm")),
      sensor_plugin(
          "thinlens", "a lens with depth of field", make_thinlens, fov().with_lajolla_default(45, "45"),
          optional(number("apertureRadius", "scene units", "radius of the lens, >= 0")),
          optional(number("fNumber", "", "focalLength over the lens's diameter, > 0, instead of the radius (ours)")),
          optional(number("focalLength", "scene units", "of the lens; fov says how much is seen (ours)"))),
      plugin<SensorSettings>("orthographic",
                             "parallel rays; the film is twice as wide as the x axis of toWorld is long",
                             InMedium<decltype(&make_orthographic)>{make_orthographic}, medium_of_sensor(), frame(),
                             near_clip(), far_clip(), film_of_sensor(), sampler_of_sensor())
          .accepting({no_effect("focusDistance", "parallel rays have no focus")}),
  };
  return rows;
}

const Plugins<FilmSettings>& film_plugins() {
  static const Plugins<FilmSettings> rows = {film_plugin("hdrfilm"), film_plugin("ldrfilm")};
  return rows;
}

const Plugins<Filter>& filter_plugins() {
  static const Plugins<Filter> rows = {
      plugin<Filter>("box", "all of a square alike", make_box, half_side(box_radius), side()),
      plugin<Filter>("tent", "falls linearly from the centre, in x and in y", make_tent, half_side(tent_radius),
                     side()),
      plugin<Filter>("gaussian", "the normal distribution, not cut off", make_gaussian,
                     number("stddev", "pixels", 0.5, "its standard deviation, > 0")),
      plugin<Filter>("subpixeltent", "the mean of n x n tents about the centres of the subpixels, as in smallpt (ours)",
                     make_subpixeltent, integer("n", "subpixels in a row, >= 1", 2),
                     number("radius", "pixels", 0.5, "half the side of a tent, > 0")),
  };
  return rows;
}

const Plugins<int>& sampler_plugins() {
  static const Plugins<int> rows = {sampler_plugin("independent"), sampler_plugin("stratified"),
                                    sampler_plugin("ldsampler"),   sampler_plugin("halton"),
                                    sampler_plugin("hammersley"),  sampler_plugin("sobol"),
                                    sampler_plugin("multijitter"), sampler_plugin("orthogonal")};
  return rows;
}

const Plugins<IntegratorSettings>& integrator_plugins() {
  static const Plugins<IntegratorSettings> rows = {
      path("path", "paths from the camera, in media too; --strategy says how they find the lights"),
      path("volpath", "as path"),
      path("volpathmis", "as path"),
      path("volpath_simple", "as path"),
      plugin<IntegratorSettings>("direct", "what lights send by way of one surface: paths of at most two edges",
                                 make_direct)
          .accepting({no_effect("shadingSamples", "--spp says it"), no_effect("emitterSamples", "--spp says it"),
                      no_effect("bsdfSamples", "--spp says it"),
                      no_effect("strictNormals", "the geometry always decides on which side light is"),
                      only(false, "hideEmitters", "lights are seen")}),
      plugin<IntegratorSettings>(
          "ao", "ambient occlusion: the share of a uniform sky's light that nothing near keeps away", make_ao,
          number("rayLength", "scene units", "what stands farther away counts as sky, > 0"))
          .accepting({no_effect("shadingSamples", "--spp says it")}),
      wrapper("moment", "the integrator inside it; every EXR contains the variance"),
      wrapper("aov", "the integrator inside it; carlo render --layers writes normals, depth and albedo")
          .accepting({no_effect("aovs", "--layers writes all it has")}),
      plugin<IntegratorSettings>(
          "normals", "the normal n of what is seen, as the colour (n + 1) / 2; beyond it the sky (ours)", make_normals),
  };
  return rows;
}

} // namespace render::mitsuba
