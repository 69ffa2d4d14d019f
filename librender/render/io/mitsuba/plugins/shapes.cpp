#include <render/io/mesh/mesh.h>
#include <render/io/mitsuba/plugins.h>

#include <mc/core/error.h>

namespace render::mitsuba {

namespace {

const std::string scene_units = "scene units";

struct PlacedShape {
  Shape shape;
  std::string missing_uv_reason; ///< Why a mesh has no texture coordinates.
  PlacedShape(Shape s, std::string why = {}) : shape(std::move(s)), missing_uv_reason(std::move(why)) {}
};

// max_angle : largest angle between smoothed faces [degrees].
PlacedShape placed(const std::string& name, const MeshFile& mesh, const Transform& to_world, bool is_flat,
                   const std::optional<double>& max_angle) {
  return mc::with_context(name, [&] {
    mc::require(!is_flat || !max_angle, "faceNormals and maxSmoothAngle contradict each other; give one");
    const std::string& why = mesh.missing_uv_reason;
    return PlacedShape(max_angle ? to_shape(split_at_edges(mesh, to_world, *max_angle), to_world)
                                 : to_shape(mesh, to_world, is_flat),
                       why.empty() ? why : fmt::format("{}: {}", name, why));
  });
}

// is_flipped : whether `read` measures v from the top. read_obj() does, because OBJ files measure it from the bottom.
template <MeshFile (*read)(const std::string&), bool is_flipped>
PlacedShape make_mesh(const std::string& path, const Transform& to_world, bool face_normals,
                      const std::optional<double>& max_angle, bool flip) {
  MeshFile mesh = read(path);
  if (flip != is_flipped)
    for (auto& uv : mesh.uvs) uv[1] = 1 - uv[1];
  return placed(path, mesh, to_world, face_normals, max_angle);
}

PlacedShape make_serialized(const std::string& path, const Transform& to_world, bool face_normals,
                            const std::optional<double>& max_angle, int index) {
  return placed(fmt::format("{}: mesh {}", path, index), read_serialized(path, index), to_world, face_normals,
                max_angle);
}

Shape make_rectangle(const Transform& to_world, bool flip) {
  TriangleMesh square = TriangleMesh::rectangle(flip ? to_world * Transform::scale({1, 1, -1}) : to_world);
  mc::require(square.area() > 0, "toWorld makes a line of the square, or a point; nothing would be seen");
  return square;
}

Shape make_disk(const Transform& to_world, bool flip) { return Disk(to_world, flip); }

// toWorld may stretch a cylinder along its axis.
Shape make_cylinder(const Transform& to_world, const Vec3d& from, const Vec3d& to, double radius, bool flip) {
  mc::require(from != to, "p0 and p1 must differ; both are ({}, {}, {})", from.x(), from.y(), from.z());
  const auto local = mc::Frame<double>::from_z((to - from).normalized());
  Eigen::Matrix3d axes;
  axes << to_world.vector(local.x), to_world.vector(local.y), to_world.vector(local.z);
  const Eigen::RowVector3d length = axes.colwise().norm();
  mc::require((length.array() > 0).all(),
              "toWorld flattens the cylinder, or makes a line of it; nothing would be seen");
  const Eigen::Matrix3d unit = axes.array().rowwise() / length.array();
  mc::require((unit.transpose() * unit).isApprox(Eigen::Matrix3d::Identity(), 1e-9) &&
                  std::abs(length[0] - length[1]) <= 1e-9 * length[0],
              "toWorld of a cylinder must keep it round and straight: it may turn, move and scale it, and stretch it "
              "along its axis");
  return Cylinder(to_world.point(from), to_world.point(to), length[0] * radius, flip);
}

Shape make_cube(const Transform& to_world) {
  mc::require(to_world.linear.determinant() != 0, "toWorld flattens the cube; use a rectangle for what is flat");
  return TriangleMesh::box(to_world);
}

/// Centre of a sphere before toWorld rotates and translates it, and whether toWorld also scales the centre.
struct Center {
  Vec3d at = Vec3d::Zero();
  bool is_scaled = true;
};

Shape make_sphere(const Transform& to_world, const Center& center, double radius, bool flip, std::size_t pole,
                  const std::optional<Vec3d>& cap_axis, const std::optional<double>& cap_height) {
  mc::require((to_world.linear.colwise().lpNorm<Eigen::Infinity>().array() > 0).all(),
              "toWorld flattens the sphere, or makes a point of it; nothing would be seen");
  const double scale = to_world.linear.col(0).stableNorm();
  const Eigen::Matrix3d turn = to_world.linear / scale;
  mc::require((turn.transpose() * turn).isApprox(Eigen::Matrix3d::Identity(), 1e-9),
              "toWorld of a sphere must scale all axes alike");
  mc::require(cap_axis.has_value() == cap_height.has_value(),
              "capAxis and capHeight belong together; give both or none");
  const Vec3d at = to_world.point(center.is_scaled ? center.at : Vec3d(center.at / scale));
  const bool is_z_up = pole == 0;
  Eigen::Matrix3d axes = turn;
  if (!is_z_up) axes << turn.col(0), turn.col(2), turn.col(1);
  const Sphere sphere = cap_axis
                            ? Sphere::cap(at, scale * radius, to_world.vector(*cap_axis), scale * *cap_height, flip)
                            : Sphere(at, scale * radius, flip);
  return sphere.with_uv_axes(axes, is_z_up ? 0 : -0.5);
}

Parameter<std::optional<BsdfId>> bsdf_of_shape() {
  const Parameter<std::optional<BsdfId>> p{
      {"<bsdf>", "bsdf", "", {"bsdf"}, "what covers it"},
      [](const XmlElement& e, Context& context) { return std::optional(context.bsdf(e)); }};
  return p.with_default(std::nullopt, "diffuse; of what shines black");
}

Parameter<std::optional<NamedMedium>> medium_of_shape(const std::string& name, const std::string& meaning,
                                                      const std::vector<std::string>& roles) {
  Parameter<NamedMedium> p{{name, "medium", "", {"medium"}, meaning}, read_medium};
  p.declared.roles = roles;
  return optional(p);
}

template <class Make> struct Covered {
  Make make;
  template <class... Values>
  ShapeDescription operator()(const std::optional<BsdfId>& bsdf, const std::optional<Emission>& emission,
                              const std::optional<NamedMedium>& interior, const std::optional<NamedMedium>& exterior,
                              bool importance_target, const Values&... values) const {
    PlacedShape placed = make(values...);
    return {std::move(placed.shape),
            bsdf,
            emission,
            importance_target,
            interior,
            exterior,
            std::move(placed.missing_uv_reason)};
  }
};

// A row for a geometry, with the parameters common to all shapes.
template <class Make, class... V>
Plugin<ShapeDescription> shape_plugin(std::string name, std::string meaning, Make make,
                                      const Parameter<V>&... parameters) {
  return plugin<ShapeDescription>(
      std::move(name), std::move(meaning), Covered<Make>{make}, bsdf_of_shape(),
      optional(nested("emitter", "makes it shine", surface_emitter_plugins)),
      medium_of_shape("<medium>", "what fills it: where its normals do not point to, up to the next surface",
                      {"", "interior"}),
      medium_of_shape("<medium name=\"exterior\">", "the medium around it: that of the sensor, or of a shape around it",
                      {"exterior"}),
      boolean("guide", "whether the strategies `mixture` and `guides` aim at it (ours)"), parameters...);
}

constexpr const char* per_length = "1 / scene unit";

HomogeneousMedium make_homogeneous(const std::optional<Spectrum>& sigma_a, const std::optional<Spectrum>& sigma_s,
                                   const std::optional<Spectrum>& sigma_t, const std::optional<Spectrum>& albedo,
                                   double scale, const PhaseFunction& phase_function) {
  const bool by_parts = sigma_a || sigma_s, by_sum = sigma_t || albedo;
  mc::require(by_parts != by_sum, "give sigmaA and sigmaS, or sigmaT and albedo");
  mc::require(std::isfinite(scale) && scale >= 0, "scale {} must be finite and >= 0", scale);
  const Spectrum zero = Spectrum::Zero(),
                 share = checked_reflectance("albedo", albedo.value_or(Spectrum::Constant(Float(0.75)))),
                 sum = sigma_t.value_or(Spectrum::Ones());
  const Spectrum absorbed = by_sum ? Spectrum(sum * (1 - share)) : sigma_a.value_or(zero),
                 scattered = by_sum ? Spectrum(sum * share) : sigma_s.value_or(zero);
  return HomogeneousMedium(absorbed * Float(scale), scattered * Float(scale), phase_function);
}

PhaseFunction make_henyey_greenstein(double g) { return PhaseFunction(Float(g)); }

Parameter<Transform> to_world() { return transform("toWorld", "from the shape's space to the scene's"); }

Parameter<Transform> to_world_of_sphere() {
  Parameter<Transform> p = to_world();
  p.parse = [](const XmlElement& e, Context& context) {
    if (context.dialect() == Dialect::lajolla)
      context.warn(e, "lajolla leaves a sphere where it is, here toWorld counts; say center and radius instead");
    return transform_of(e);
  };
  return p;
}

Parameter<Center> center() {
  const Parameter<Center> p{{"center",
                             "point",
                             "",
                             {"point", "vector"},
                             "its centre, which toWorld turns and moves, and since Mitsuba 2 scales"},
                            [](const XmlElement& e, Context& context) {
                              return Center{vector_of(e), context.is_mitsuba_2()};
                            }};
  return p.with_default({}, "0, 0, 0");
}

Parameter<std::optional<double>> max_smooth_angle() {
  auto p = optional(number("maxSmoothAngle", "degrees",
                           "faces that meet at more keep their edge, the others are smooth whatever the file says; "
                           "lajolla leaves it out"));
  p.parse = [](const XmlElement& e, Context& context) -> std::optional<double> {
    const double angle = number_of(e);
    if (context.dialect() == Dialect::lajolla) return {};
    return angle;
  };
  return p;
}

// A row for a mesh file, with the parameters common to all mesh files.
template <class Make, class... V>
Plugin<ShapeDescription> mesh_plugin(std::string name, std::string meaning, Make make,
                                     const Parameter<V>&... parameters) {
  return shape_plugin(
      std::move(name), std::move(meaning), make, file("filename", "the mesh, relative to the scene file"), to_world(),
      boolean("faceNormals", "whether it is flat: without the file's normals, or smooth ones where it has none"),
      max_smooth_angle(), parameters...);
}

} // namespace

const Plugins<HomogeneousMedium>& medium_plugins() {
  static const Plugins<HomogeneousMedium> rows = {
      plugin<HomogeneousMedium>(
          "homogeneous", "absorbs and scatters alike everywhere", make_homogeneous,
          optional(color("sigmaA", per_length, "what is absorbed, >= 0")).with_default(std::nullopt, "0"),
          optional(color("sigmaS", per_length, "what is scattered, >= 0")).with_default(std::nullopt, "0"),
          optional(color("sigmaT", per_length, "both together, >= 0, instead")).with_default(std::nullopt, "1"),
          optional(color("albedo", "", "share of it that is scattered, in [0, 1]")).with_default(std::nullopt, "0.75"),
          number("scale", "", 1, "factor of all that is absorbed and scattered, >= 0"),
          nested("phase", "directions of what is scattered", phase_plugins).with_default(PhaseFunction(), "isotropic"))
          .accepting({no_effect("hasSpectralExtinction", "channels are sampled in proportion to their light"),
                      no_effect("sampleEmitters", "--strategy says it")}),
  };
  return rows;
}

const Plugins<PhaseFunction>& phase_plugins() {
  static const Plugins<PhaseFunction> rows = {
      plugin<PhaseFunction>("isotropic", "alike in all directions", [] { return PhaseFunction(); }),
      plugin<PhaseFunction>(
          "hg", "the phase function of Henyey and Greenstein", make_henyey_greenstein,
          number("g", "", 0.8, "mean cosine of the deflection, in (-1, 1); > 0: forward").with_lajolla_default(0, "0")),
  };
  return rows;
}

NamedMedium read_medium(const XmlElement& e, Context& context) {
  const XmlElement& element = context.resolve(e, {"medium"});
  return {read_plugin(medium_plugins(), element, context), &element};
}

const Plugins<ShapeDescription>& shape_plugins() {
  static const Plugins<ShapeDescription> rows = {
      mesh_plugin("obj", "a mesh in Wavefront's format; its materials are ignored", make_mesh<read_obj, true>,
                  boolean("flipTexCoords", "whether the file measures v from the bottom of a texture", true)),
      mesh_plugin("ply", "a mesh in Stanford's format, ascii or binary, of faces or triangle strips",
                  make_mesh<read_ply, false>,
                  boolean("flipTexCoords", "whether the file measures v from the bottom of a texture", false)),
      mesh_plugin("serialized", "a mesh in Mitsuba's own format, versions 3 and 4", make_serialized,
                  integer("shapeIndex", "which of the file's meshes, >= 0", 0)),
      shape_plugin("rectangle", "the square [-1, 1]^2 in the plane z = 0, normal +z", make_rectangle, to_world(),
                   boolean("flipNormals", "whether the normal is -z")),
      shape_plugin("disk", "the unit disk in the plane z = 0, normal +z; toWorld may make an ellipse of it", make_disk,
                   to_world(), boolean("flipNormals", "whether the normal is -z")),
      shape_plugin("cylinder", "the wall of a circular cylinder, without its ends, normal outward", make_cylinder,
                   to_world(), point("p0", "centre of one end", Vec3d::Zero()),
                   point("p1", "centre of the other end", Vec3d::UnitZ()),
                   number("radius", scene_units, 1, "its radius, > 0"),
                   boolean("flipNormals", "whether the normals point inward")),
      shape_plugin("cube", "the cube [-1, 1]^3, normals outward", make_cube, to_world()),
      shape_plugin(
          "sphere", "a sphere, or the cap of one", make_sphere, to_world_of_sphere(), center(),
          number("radius", scene_units, 1, "its radius, > 0"),
          boolean("flipNormals", "whether the normals point inward"),
          choice("pole", {"z", "y"},
                 "where v is 0; u in [0, 1] turns from x to y about z, u in [-1/2, 1/2] from x to z about y (ours)", 0)
              .with_lajolla_default(1, "y"),
          optional(point("capAxis", "direction of the cap's pole from the centre (ours)", Vec3d::Zero())),
          optional(number("capHeight", scene_units, "how far the cap reaches from its pole, in (0, 2 radius] (ours)"))),
  };
  return rows;
}

} // namespace render::mitsuba
