#include <render/io/mitsuba.h>
#include <render/io/obj.h>
#include <render/io/xml_values.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <cmath>
#include <filesystem>
#include <map>

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

Float reflectance_in_range(const XmlElement& e, Float value) {
  if (!(value >= 0 && value <= 1)) e.fail(fmt::format("reflectance {} must lie in [0, 1]", value));
  return value;
}

Spectrum albedo(const XmlElement& e, const Parameters& p, std::string_view name, const Spectrum& fallback) {
  const Spectrum color = p.color(name, fallback);
  for (int c = 0; c < 3; ++c) reflectance_in_range(e, color[c]);
  return color;
}

class Reader {
 public:
  explicit Reader(std::string path) : path_(std::move(path)) {}

  Scene read() {
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
    mc::with_context(path_, [&] { scene_.prepare(); });
    return std::move(scene_);
  }

 private:
  void integrator(const XmlElement& e) {
    const std::string& type = e.attribute("type");
    if (type != "path") unknown(e, type, {"path"});
    const Parameters p(e);
    scene_.defaults.max_depth = p.integer("maxDepth", -1);
    if (scene_.defaults.max_depth < -1 || scene_.defaults.max_depth == 0)
      e.fail(fmt::format("maxDepth {} must be -1 or at least 1", scene_.defaults.max_depth));
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
      scene_.defaults.spp = Parameters(*s).integer("sampleCount", 64);
      if (scene_.defaults.spp < 1) s->fail(fmt::format("sampleCount {} must be at least 1", scene_.defaults.spp));
      Parameters(*s).accept({"seed", "dimension", "scramble"});
    }
    ThinLens& camera = scene_.camera;
    const Transform t = p.transform("toWorld");
    for (int column = 0; column < 3; ++column)
      if (!(t.col(column).norm() > 0)) e.fail("toWorld is singular");
    camera.right = -t.col(0).normalized().cast<Float>();
    camera.up = t.col(1).normalized().cast<Float>();
    camera.forward = t.col(2).normalized().cast<Float>();
    camera.origin = t.col(3).cast<Float>();
    const double fov = p.number("fov");
    if (!(fov > 0 && fov < 180)) e.fail(fmt::format("fov {} must lie in (0, 180) degrees", fov));
    const std::string axis = p.string("fovAxis", "x");
    static const std::map<std::string, ThinLens::FovAxis> axes = {{"x", ThinLens::FovAxis::x},
                                                                  {"y", ThinLens::FovAxis::y},
                                                                  {"smaller", ThinLens::FovAxis::smaller},
                                                                  {"larger", ThinLens::FovAxis::larger}};
    if (!axes.contains(axis)) e.fail(fmt::format("fovAxis '{}' must be x, y, smaller or larger", axis));
    camera.fov_axis = axes.at(axis);
    camera.tan_half_fov = Float(std::tan(fov * mc::pi<double> / 360));
    camera.near = Float(p.number("nearClip", 0));
    if (!(camera.near >= 0)) e.fail(fmt::format("nearClip {} must be >= 0", camera.near));
    camera.focus_distance = Float(p.number("focusDistance", 1));
    if (!(camera.focus_distance > 0)) e.fail(fmt::format("focusDistance {} must be > 0", camera.focus_distance));
    if (type == "thinlens") camera.lens_radius = Float(p.number("apertureRadius"));
    if (!(camera.lens_radius >= 0)) e.fail(fmt::format("apertureRadius {} must be >= 0", camera.lens_radius));
    p.accept({"farClip"});
  }

  void film(const XmlElement& e) {
    e.attribute_or("type", "");
    const Parameters p(e);
    scene_.defaults.width = p.integer("width", 768);
    scene_.defaults.height = p.integer("height", 576);
    if (scene_.defaults.width < 1 || scene_.defaults.height < 1)
      e.fail(fmt::format("size {}x{} needs at least one pixel", scene_.defaults.width, scene_.defaults.height));
    p.accept({"banner", "pixelFormat", "fileFormat", "componentFormat", "gamma", "exposure", "filename", "attachLog"});
    const XmlElement* f = child_of(e, "rfilter");
    if (!f) {
      scene_.filter = GaussianFilter{};
      return;
    }
    const std::string& type = f->attribute("type");
    const Parameters q(*f);
    const auto positive = [&](std::string_view name, double fallback) {
      const double value = q.number(name, fallback);
      if (!(value > 0)) f->fail(fmt::format("{} {} must be > 0", name, value));
      return Float(value);
    };
    if (type == "box") scene_.filter = BoxFilter{positive("radius", 0.5)};
    else if (type == "tent") scene_.filter = TentFilter{positive("radius", 1)};
    else if (type == "gaussian") scene_.filter = GaussianFilter{positive("stddev", 0.5)};
    else if (type == "subpixeltent") {
      const int n = q.integer("n", 2);
      if (n < 1) f->fail(fmt::format("n {} must be at least 1", n));
      scene_.filter = SubpixelTentFilter{n, positive("radius", 0.5)};
    } else unknown(*f, type, {"box", "tent", "gaussian", "subpixeltent"});
  }

  int add_bsdf(const XmlElement& e) {
    scene_.bsdfs.push_back(bsdf(e));
    return static_cast<int>(scene_.bsdfs.size()) - 1;
  }

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
    if (type == "diffuse") return Lambert{albedo(e, p, "reflectance", Spectrum::Constant(Float(0.5)))};
    if (type == "conductor") {
      if (p.string("material", "none") != "none") e.fail("only the material 'none', a perfect mirror, is supported");
      return Metal{albedo(e, p, "specularReflectance", Spectrum::Ones()), 0};
    }
    if (type == "fuzzymetal") {
      const double fuzz = p.number("fuzz", 0);
      if (!(fuzz >= 0 && fuzz <= 1)) e.fail(fmt::format("fuzz {} must lie in [0, 1]", fuzz));
      return Metal{albedo(e, p, "albedo", Spectrum::Constant(Float(0.9))), Float(fuzz)};
    }
    if (type == "dielectric") {
      const double inside = p.number("intIOR", 1.5046), outside = p.number("extIOR", 1.000277);
      if (!(inside > 0 && outside > 0))
        e.fail(fmt::format("indices of refraction {} and {} must be > 0", inside, outside));
      return Dielectric{Float(inside / outside), albedo(e, p, "specularReflectance", Spectrum::Ones()),
                        albedo(e, p, "specularTransmittance", Spectrum::Ones())};
    }
    unknown(e, type, {"diffuse", "conductor", "fuzzymetal", "dielectric", "twosided"});
  }

  int bsdf_of(const XmlElement& e) {
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
    scene_.bsdfs.push_back(Lambert{});
    return static_cast<int>(scene_.bsdfs.size()) - 1;
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
      const Vec3d center = t.leftCols<3>() * p.vector("center", Vec3d(0, 0, 0)) + t.col(3);
      const double scale = t.col(0).norm();
      if (!(t.leftCols<3>().transpose() * t.leftCols<3>()).isApprox(scale * scale * Eigen::Matrix3d::Identity(), 1e-9))
        e.fail("toWorld of a sphere must scale all axes alike");
      const double radius = scale * p.number("radius", 1);
      const bool flip = p.boolean("flipNormals", false);
      if (p.find("capHeight")) {
        const Vec3d axis = t.leftCols<3>() * p.vector("capAxis");
        return Sphere::cap(center, radius, axis, scale * p.number("capHeight"), flip);
      }
      return Sphere(center, radius, flip);
    }
    unknown(e, type, {"obj", "rectangle", "cube", "sphere"});
  }

  void shape(const XmlElement& e) {
    e.attribute_or("id", "");
    const Parameters p(e);
    std::optional<AreaLight> light;
    if (const XmlElement* emitter = child_of(e, "emitter")) {
      const std::string& type = emitter->attribute("type");
      if (type != "area") unknown(*emitter, type, {"area"});
      const Parameters q(*emitter);
      light = AreaLight{-1, radiance(*emitter, q, "radiance", {}), q.boolean("twoSided", false)};
    }
    Shape s = geometry(e, p);
    if (light && !(s.area() > 0))
      e.fail(fmt::format("an emitting shape needs an area > 0, but this one has {}", s.area()));
    const int index = scene_.add(std::move(s), bsdf_of(e), light);
    if (p.boolean("guide", false)) scene_.guides.push_back(index);
  }

  static Spectrum radiance(const XmlElement& e, const Parameters& p, std::string_view name,
                           std::optional<Spectrum> fallback) {
    const Spectrum value = p.color(name, fallback);
    if (!((value >= 0).all() && value.isFinite().all()))
      e.fail(fmt::format("{} ({}, {}, {}) must be finite and >= 0", name, value[0], value[1], value[2]));
    return value;
  }

  void background(const XmlElement& e) {
    if (scene_.background) e.fail("a second background; only one is allowed");
    e.attribute_or("id", "");
    const std::string& type = e.attribute("type");
    const Parameters p(e);
    if (type == "constant")
      scene_.background = ConstantBackground{radiance(e, p, "radiance", Spectrum(Spectrum::Ones()))};
    else if (type == "gradient") {
      const GradientBackground sky;
      scene_.background = GradientBackground{radiance(e, p, "bottom", sky.bottom), radiance(e, p, "top", sky.top)};
    } else unknown(e, type, {"constant", "gradient"});
  }

  std::string path_;
  Scene scene_;
  std::map<std::string, int> named_bsdfs_;
  std::vector<const XmlElement*> shapes_;
};

} // namespace

Scene read_mitsuba(const std::string& path) { return Reader(path).read(); }

} // namespace render
