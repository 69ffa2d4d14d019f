#include <render/io/mitsuba.h>
#include <render/io/obj.h>
#include <render/io/xml_values.h>
#include <render/scene/builder.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

namespace render {

namespace {

using Names = std::vector<std::string_view>;

[[noreturn]] void unknown(const XmlElement& e, const std::string& type, const Names& known) {
  e.fail(
      fmt::format("unknown type '{}'{}; use one of {}", type, mc::did_you_mean(type, known), fmt::join(known, ", ")));
}

const XmlElement* child_of(const XmlElement& parent, std::string_view tag) {
  const XmlElement* found = nullptr;
  for (const XmlElement& child : parent.children)
    if (child.tag == tag) {
      if (found) child.fail(fmt::format("a second <{}>; only one is allowed here", tag));
      child.mark();
      found = &child;
    }
  return found;
}

class Reader {
 public:
  explicit Reader(std::string path) : path_(std::move(path)) {}

  SceneFile read() {
    const XmlElement root = read_xml(path_);
    root.mark();
    if (root.tag != "scene") root.fail("the document must be a <scene>");
    root.attribute_or("version", "");
    bool has_sensor = false;
    for (const XmlElement& e : root.children) {
      e.mark();
      if (e.tag == "integrator") integrator(e);
      else if (e.tag == "sensor") has_sensor = true, sensor(e);
      else if (e.tag == "bsdf") {
        const std::string& id = e.attribute("id");
        if (!named_bsdfs_.try_emplace(id, add_bsdf(e)).second)
          e.fail(fmt::format("a second BSDF with the id '{}'; ids must differ", id));
      } else if (e.tag == "shape") shapes_.push_back(&e); // after all BSDFs, which may be named later
      else if (e.tag == "emitter") background(e);
      else e.fail("unknown element; use integrator, sensor, bsdf, shape or emitter");
    }
    if (!has_sensor) root.fail("there is no <sensor>; a camera is needed");
    for (const XmlElement* e : shapes_) mc::with_context(e->where(), [&] { shape(*e); });
    root.require_all_seen();
    return {mc::with_context(path_, [&] { return scene_.build(); }), defaults_};
  }

 private:
  void integrator(const XmlElement& e) {
    const std::string& type = e.attribute("type");
    if (type != "path") unknown(e, type, {"path"});
    const Parameters p(e);
    defaults_.max_depth = p.integer("maxDepth", -1);
    if (defaults_.max_depth < -1 || defaults_.max_depth == 0)
      e.fail(fmt::format("maxDepth {} must be -1 or at least 1", defaults_.max_depth));
    p.accept({"rrDepth", "strictNormals", "hideEmitters"});
  }

  void sensor(const XmlElement& e) {
    const std::string& type = e.attribute("type");
    if (type != "perspective" && type != "thinlens") unknown(e, type, {"perspective", "thinlens"});
    e.attribute_or("id", "");
    const Parameters p(e);
    if (const XmlElement* film_element = child_of(e, "film")) film(*film_element);
    if (const XmlElement* s = child_of(e, "sampler")) {
      s->attribute_or("type", "");
      defaults_.spp = Parameters(*s).integer("sampleCount", 64);
      if (defaults_.spp < 1) s->fail(fmt::format("sampleCount {} must be at least 1", defaults_.spp));
      Parameters(*s).accept({"seed", "dimension", "scramble"});
    }
    LensOptions lens;
    lens.fov = p.number("fov");
    const std::string axis = p.string("fovAxis", "x");
    static const std::map<std::string, FovAxis> axes = {
        {"x", FovAxis::x}, {"y", FovAxis::y}, {"smaller", FovAxis::smaller}, {"larger", FovAxis::larger}};
    if (!axes.contains(axis)) e.fail(fmt::format("fovAxis '{}' must be x, y, smaller or larger", axis));
    lens.fov_axis = axes.at(axis);
    lens.near = p.number("nearClip", 0);
    lens.focus_distance = p.number("focusDistance", 1);
    if (type == "thinlens") lens.radius = p.number("apertureRadius");
    const Transform to_world = p.transform("toWorld");
    mc::with_context(e.where(), [&] { scene_.set(ThinLens(to_world, lens)); });
    p.accept({"farClip"});
  }

  void film(const XmlElement& e) {
    e.attribute_or("type", "");
    const Parameters p(e);
    defaults_.width = p.integer("width", 768);
    defaults_.height = p.integer("height", 576);
    if (defaults_.width < 1 || defaults_.height < 1)
      e.fail(fmt::format("size {}x{} needs at least one pixel", defaults_.width, defaults_.height));
    p.accept({"banner", "pixelFormat", "fileFormat", "componentFormat", "gamma", "exposure", "filename", "attachLog"});
    if (const XmlElement* f = child_of(e, "rfilter")) scene_.set(filter(*f));
    else scene_.set(GaussianFilter());
  }

  static Filter filter(const XmlElement& e) {
    const std::string& type = e.attribute("type");
    const Parameters p(e);
    const auto number = [&](std::string_view name, double fallback) { return Float(p.number(name, fallback)); };
    return mc::with_context(e.where(), [&]() -> Filter {
      if (type == "box") return BoxFilter(number("radius", 0.5));
      if (type == "tent") return TentFilter(number("radius", 1));
      if (type == "gaussian") return GaussianFilter(number("stddev", 0.5));
      if (type == "subpixeltent") return SubpixelTentFilter(p.integer("n", 2), number("radius", 0.5));
      unknown(e, type, {"box", "tent", "gaussian", "subpixeltent"});
    });
  }

  BsdfId add_bsdf(const XmlElement& e) { return scene_.add(bsdf(e)); }

  Bsdf bsdf(const XmlElement& e) {
    e.mark();
    e.attribute_or("id", "");
    const std::string& type = e.attribute("type");
    const Parameters p(e);
    if (type == "twosided") {
      const XmlElement* inner = child_of(e, "bsdf");
      if (!inner) e.fail("twosided needs a <bsdf> inside");
      return bsdf(*inner);
    }
    if (type == "diffuse") {
      const Spectrum reflectance = p.color("reflectance", Spectrum::Constant(Float(0.5)));
      return mc::with_context(e.where(), [&] { return Lambert(reflectance); });
    }
    if (type == "conductor") {
      if (p.string("material", "none") != "none") e.fail("only the material 'none', a perfect mirror, is supported");
      const Spectrum reflectance = p.color("specularReflectance", Spectrum::Ones());
      return mc::with_context(e.where(), [&] { return Metal(reflectance); });
    }
    if (type == "fuzzymetal") {
      const Spectrum albedo = p.color("albedo", Spectrum::Constant(Float(0.9)));
      const Float fuzz = Float(p.number("fuzz", 0));
      return mc::with_context(e.where(), [&] { return Metal(albedo, fuzz); });
    }
    if (type == "dielectric") {
      const double inside = p.number("intIOR", 1.5046), outside = p.number("extIOR", 1.000277);
      if (!(inside > 0 && outside > 0))
        e.fail(fmt::format("indices of refraction {} and {} must be > 0", inside, outside));
      const Spectrum reflectance = p.color("specularReflectance", Spectrum::Ones()),
                     transmittance = p.color("specularTransmittance", Spectrum::Ones());
      return mc::with_context(e.where(),
                              [&] { return Dielectric(Float(inside / outside), reflectance, transmittance); });
    }
    unknown(e, type, {"diffuse", "conductor", "fuzzymetal", "dielectric", "twosided"});
  }

  BsdfId bsdf_of(const XmlElement& e) {
    const XmlElement* inline_bsdf = child_of(e, "bsdf");
    const XmlElement* ref = child_of(e, "ref");
    if (inline_bsdf && ref) e.fail("both a <bsdf> and a <ref>; only one is allowed");
    if (inline_bsdf) return add_bsdf(*inline_bsdf);
    if (ref) {
      ref->attribute_or("name", "");
      const std::string& id = ref->attribute("id");
      const auto it = named_bsdfs_.find(id);
      if (it != named_bsdfs_.end()) return it->second;
      Names known;
      for (const auto& [name, index] : named_bsdfs_) known.push_back(name);
      ref->fail(fmt::format("no BSDF has the id '{}'{}", id, mc::did_you_mean(id, known)));
    }
    return scene_.add(Lambert());
  }

  Shape geometry(const XmlElement& e, const Parameters& p) {
    const std::string& type = e.attribute("type");
    const Transform t = p.transform("toWorld");
    if (type == "obj") {
      const std::string file = p.string("filename");
      p.accept({"faceNormals", "maxSmoothAngle"});
      return read_obj((std::filesystem::path(path_).parent_path() / file).string(), t);
    }
    if (type == "rectangle") return TriangleMesh::rectangle(t);
    if (type == "cube") return TriangleMesh::box(t);
    if (type == "sphere") {
      const Vec3d center = t.point(p.vector("center", Vec3d(0, 0, 0)));
      const double scale = t.linear.col(0).norm();
      if (!(t.linear.transpose() * t.linear).isApprox(scale * scale * Eigen::Matrix3d::Identity(), 1e-9))
        e.fail("toWorld of a sphere must scale all axes alike");
      const double radius = scale * p.number("radius", 1);
      const bool flip = p.boolean("flipNormals", false);
      if (p.find("capHeight")) {
        const Vec3d axis = t.vector(p.vector("capAxis"));
        return Sphere::cap(center, radius, axis, scale * p.number("capHeight"), flip);
      }
      return Sphere(center, radius, flip);
    }
    unknown(e, type, {"obj", "rectangle", "cube", "sphere"});
  }

  void shape(const XmlElement& e) {
    e.attribute_or("id", "");
    const Parameters p(e);
    std::optional<Emission> emission;
    if (const XmlElement* emitter = child_of(e, "emitter")) {
      const std::string& type = emitter->attribute("type");
      if (type != "area") unknown(*emitter, type, {"area"});
      const Parameters q(*emitter);
      emission = Emission{q.color("radiance"), q.boolean("twoSided", false)};
    }
    Shape s = geometry(e, p);
    scene_.add(std::move(s), {bsdf_of(e), emission, p.boolean("guide", false)});
  }

  void background(const XmlElement& e) {
    if (std::exchange(has_background_, true)) e.fail("a second background; only one is allowed");
    e.attribute_or("id", "");
    const std::string& type = e.attribute("type");
    const Parameters p(e);
    if (type == "constant") {
      const Spectrum radiance = p.color("radiance", Spectrum::Ones());
      mc::with_context(e.where(), [&] { scene_.add(Light(ConstantBackground(radiance))); });
    } else if (type == "gradient") {
      const Spectrum bottom = p.color("bottom", Spectrum::Ones()),
                     top = p.color("top", Spectrum(Float(0.5), Float(0.7), 1));
      mc::with_context(e.where(), [&] { scene_.add(Light(GradientBackground(bottom, top))); });
    } else unknown(e, type, {"constant", "gradient"});
  }

  std::string path_;
  SceneBuilder scene_;
  RenderDefaults defaults_;
  bool has_background_ = false;
  std::map<std::string, BsdfId> named_bsdfs_;
  std::vector<const XmlElement*> shapes_;
};

} // namespace

SceneFile read_mitsuba(const std::string& path) { return Reader(path).read(); }

} // namespace render
