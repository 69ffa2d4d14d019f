#include <render/io/mitsuba/mitsuba.h>

#include <render/io/mitsuba/plugins.h>
#include <render/io/mitsuba/variables.h>
#include <render/scene/resolution.h>

#include <mc/core/text.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace render {

namespace {

using namespace mitsuba;

class Reader {
 public:
  Reader(const XmlElement& root, Dialect dialect, const Vec3d& origin) : root_(root), context_(root, dialect, origin) {}

  /// Position of the camera, from the <sensor> alone.
  Vec3d eye() {
    for (const XmlElement& e : root_.children)
      if (e.tag == "sensor") return read_plugin(sensor_plugins(), e, context_).camera.origin().cast<double>();
    return Vec3d::Zero();
  }

  SceneFile read() {
    for (const XmlElement& e : root_.children) read(e);
    if (!sensor_) root_.fail("there is no <sensor>; a camera is needed");
    set_ambient_medium();
    context_.builder.set(sensor_->camera);
    context_.builder.set(sensor_->film.filter);
    const IntegratorSettings integrator = integrator_.value_or(IntegratorSettings());
    return {mc::with_context(root_.file, [&] { return context_.builder.build(); }),
            {sensor_->film.width, sensor_->film.height, sensor_->spp, integrator.max_depth, integrator.aov},
            context_.origin(),
            context_.warnings(),
            context_.files(),
            std::move(surface_names_),
            std::move(light_names_)};
  }

 private:
  void read(const XmlElement& e) {
    if (e.tag == "integrator") only_one(e, integrator_) = read_plugin(integrator_plugins(), e, context_);
    else if (e.tag == "sensor") only_one(e, sensor_) = read_plugin(sensor_plugins(), e, context_);
    else if (e.tag == "emitter") emitter(e);
    else if (e.tag == "bsdf") named_bsdf(e);
    else if (e.tag == "texture") named_texture(e);
    else if (e.tag == "medium") named(e, medium_plugins());
    else if (e.tag == "phase") named(e, phase_plugins());
    else if (e.tag == "film") named(e, film_plugins());
    else if (e.tag == "rfilter") named(e, filter_plugins());
    else if (e.tag == "sampler") named(e, sampler_plugins());
    else if (e.tag == "shape") shape(e);
    else if (e.tag == "path") context_.folders.add(e);
    else if (e.tag != "default")
      e.fail(
          "unknown element; use default, include, path, integrator, sensor, bsdf, texture, shape or emitter; or, for "
          "a <ref>, film, rfilter, sampler, medium or phase");
  }

  template <class T> std::optional<T>& only_one(const XmlElement& e, std::optional<T>& place) {
    if (place) e.fail(fmt::format("a second <{}>; only one is allowed", e.tag));
    return place;
  }

  // The sensor's medium is the ambient one, unless a shape has it inside. What surrounds a shape must be one of these.
  void set_ambient_medium() {
    const std::optional<NamedMedium>& own = sensor_->medium;
    if (own && !interiors_.contains(own->element)) context_.builder.set_ambient(own->medium);
    for (const auto& [shape, medium] : exteriors_)
      if (!interiors_.contains(medium) && !(own && own->element == medium))
        shape->fail(
            fmt::format("its exterior is the medium of {}, which is neither the sensor's nor inside a shape; add it "
                        "to the sensor by a <ref>, or remove it",
                        medium->where()));
  }

  // A boundary without BSDF is invisible in Mitsuba 0.6 and lajolla.
  BsdfId bsdf_of(const ShapeDescription& s) {
    if (s.bsdf) return *s.bsdf;
    if ((s.interior || s.exterior) && !s.emission && !context_.is_mitsuba_2()) return context_.invisible_material();
    return context_.default_bsdf(s.emission.has_value());
  }

  void emitter(const XmlElement& e) {
    if (e.attribute("type") == "area") return named_area(e);
    Light light = read_plugin(emitter_plugins(), e, context_);
    if (light.is_infinite() && std::exchange(has_background_, true)) e.fail("a second background; only one is allowed");
    context_.builder.add(std::move(light));
    light_names_.push_back(name_of(e));
  }

  static std::string name_of(const XmlElement& e) {
    const std::string id = e.attribute_or("id", "");
    return fmt::format("{}{} ({})", e.attribute("type"), id.empty() ? "" : " '" + mc::printable(id) + "'", e.where());
  }

  void named_area(const XmlElement& e) {
    if (!e.has("id")) e.fail("an area shines only as part of a <shape>; put it into one, or give it an id for a <ref>");
    named(e, surface_emitter_plugins());
    if (!context_.is_referenced(e)) context_.warn(e, "no <ref> in a <shape> names its id, so it does not shine");
  }

  // Reads a plugin that a <ref> may reference, so that its errors are reported in any case. The id is required: nothing
  // could reference the plugin without it.
  template <class T> void named(const XmlElement& e, const Plugins<T>& rows) {
    read_plugin(rows, e, context_);
    e.attribute("id");
  }

  void named_bsdf(const XmlElement& e) {
    context_.bsdf(e);
    e.attribute("id");
  }

  void named_texture(const XmlElement& e) {
    context_.texture(e);
    e.attribute("id");
  }

  void shape(const XmlElement& e) {
    ShapeDescription s = read_plugin(shape_plugins(), e, context_);
    const BsdfId bsdf = bsdf_of(s);
    if (s.interior) interiors_.insert(s.interior->element);
    if (s.exterior) exteriors_.emplace_back(&e, s.exterior->element);
    std::optional<HomogeneousMedium> interior;
    if (s.interior) interior = s.interior->medium;
    else if (s.exterior && context_.builder.is_clear(bsdf)) interior = HomogeneousMedium(Spectrum::Zero());
    surface_names_.push_back(name_of(e));
    if (s.emission) light_names_.push_back(name_of(e));
    mc::with_context(e.where(), [&] {
      context_.builder.add(std::move(s.shape), {bsdf, s.emission, s.importance_target, interior, s.missing_uv_reason});
    });
  }

  const XmlElement& root_;
  Context context_;
  std::optional<IntegratorSettings> integrator_;
  std::optional<SensorSettings> sensor_;
  std::set<const XmlElement*> interiors_;                                  ///< Media inside shapes.
  std::vector<std::pair<const XmlElement*, const XmlElement*>> exteriors_; ///< Shapes with the media around them.
  bool has_background_ = false;
  std::vector<std::string> surface_names_, light_names_;
};

// FloatResolution::ratio of the scene if `origin` were its origin.
double coarseness_about(const Vec3d& origin, const Scene& scene) {
  constexpr double step = double(std::numeric_limits<Float>::epsilon());
  double worst = 0;
  for (const Surface& s : scene.surfaces()) {
    const Eigen::AlignedBox3d box = s.shape->box();
    const auto reach = [&](const Vec3d& from) {
      return std::max((box.min() - from).lpNorm<Eigen::Infinity>(), (box.max() - from).lpNorm<Eigen::Infinity>());
    };
    // At least the rounding error of its coordinates.
    const double size = std::max(box.diagonal().norm(), step * reach(Vec3d::Zero()));
    worst = std::max(worst, step * reach(origin) / size);
  }
  return worst;
}

// The median of the centres of the surfaces along each axis. Walls of huge radius do not affect it.
Vec3d median_of(const Scene& scene) {
  Vec3d median;
  for (int a = 0; a < 3; ++a) {
    std::vector<double> middles;
    for (const Surface& s : scene.surfaces()) middles.push_back(s.shape->box().center()[a]);
    const auto half = middles.begin() + static_cast<std::ptrdiff_t>(middles.size() / 2);
    std::nth_element(middles.begin(), half, middles.end());
    median[a] = *half;
  }
  return median;
}

// Offset by which the origin should move, or 0. Coordinates are floats, which are too coarse for geometry far from the
// origin. The middle of the bounds is used if the scene lies far away compared with its size. Huge walls may hide such
// a scene: then the median is used, if it resolves the shapes much better than the origin does. If the shapes overflow,
// the position of the camera is used.
Vec3d middle_of(const Scene& scene) {
  if (scene.surfaces().empty()) return Vec3d::Zero();
  const Vec3d lo = scene.bounds().lo.cast<double>(), hi = scene.bounds().hi.cast<double>(), middle = (lo + hi) / 2;
  if (!middle.allFinite()) return scene.camera().origin().cast<double>();
  if (middle.norm() > 8 * (hi - lo).norm()) return middle;
  const Vec3d median = median_of(scene);
  const double here = coarseness_about(Vec3d::Zero(), scene), there = coarseness_about(median, scene);
  return here > max_resolution_ratio / 8 && there < std::min(max_resolution_ratio, here / 4) ? median
                                                                                             : Vec3d(Vec3d::Zero());
}

// Reads the scene relative to the origin of the file, or to its own middle if that is far away. Repeats up to four
// times, because the middle of a distant scene is inaccurate at first.
SceneFile read_where_it_stands(const XmlElement& root, Dialect dialect) {
  Vec3d origin = Vec3d::Zero();
  for (int looks = 1;; ++looks) {
    Vec3d step;
    try {
      SceneFile file = Reader(root, dialect, origin).read();
      step = middle_of(file.scene);
      if (step.isZero() || looks == 4) return file;
    } catch (const mc::Error&) { // far from the origin, a small lamp may have lost its area
      step = looks == 1 ? Reader(root, dialect, origin).eye() : Vec3d(Vec3d::Zero());
      if (step.isZero()) throw;
    }
    origin += step;
  }
}

// Adds the files of all elements, which may come from includes.
void add_files(const XmlElement& element, std::set<std::string>& files) {
  files.insert(element.file);
  for (const XmlElement& child : element.children) add_files(child, files);
}

} // namespace

Dialect dialect_from(std::string_view name) {
  constexpr std::array<std::string_view, 2> names = {"mitsuba", "lajolla"};
  return static_cast<Dialect>(mc::index_of("dialect", name, names));
}

SceneFile read_mitsuba(const std::string& path, Dialect dialect, const Variables& variables) {
  XmlElement root = read_xml(path);
  root.mark_used();
  if (root.tag != "scene") root.fail("the document must be a <scene>");
  is_mitsuba_2_scene(root);
  include_files(root);
  substitute_variables(root, variables);
  SceneFile file = read_where_it_stands(root, dialect);
  root.require_all_used();
  add_files(root, file.files);
  return file;
}

} // namespace render
