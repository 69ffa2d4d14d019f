#include <render/io/mesh/mesh_scene.h>

#include <render/io/image/image_io.h>
#include <render/io/mesh/mesh.h>
#include <render/io/mesh/mtl.h>
#include <render/scene/builder.h>

#include <mc/core/file.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace render {

namespace {

constexpr double fov = 35;       // degrees, along the shorter side of the image
constexpr double largest = 1e30; // the ground is fifty times as large and must stay far below the largest float
constexpr double margin = 0.95;  // largest extent of the mesh, as a fraction of the image

MeshFile read_mesh(const std::string& path) {
  const std::string extension = mc::lowercase_extension(path);
  if (extension == ".obj") return read_obj(path);
  if (extension == ".ply") return read_ply(path);
  return read_serialized(path, 0);
}

// Bounding box of all triangles.
struct Extent {
  Vec3d lo = Vec3d::Constant(mc::infinity<double>), hi = -lo;
};

Extent extent_of(const MeshFile& mesh) {
  Extent extent;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t i : triangle) {
      extent.lo = extent.lo.cwiseMin(mesh.positions[i]);
      extent.hi = extent.hi.cwiseMax(mesh.positions[i]);
    }
  return extent;
}

// Camera at the smallest distance from which all vertices project into the image.
ThinLens camera_for(const MeshFile& mesh, const Vec3d& middle, double size) {
  const Vec3d forward = Vec3d(-0.5, -0.35, -1).normalized();
  const Transform frame = Transform::look_at(-forward, Vec3d::Zero(), Vec3d::UnitY());
  const double tan_half = margin * std::tan(fov * mc::pi<double> / 360);
  double distance = 0;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t i : triangle) {
      const Vec3d p = frame.linear.transpose() * (mesh.positions[i] - middle); // left, up, away
      const double aside = std::max({std::abs(p.x()), std::abs(p.y()), 0.1 * size});
      distance = std::max(distance, aside / tan_half - p.z());
    }
  LensOptions options;
  options.fov_axis = FovAxis::smaller;
  options.fov = fov;
  return ThinLens(Transform::look_at(-distance * forward, Vec3d::Zero(), Vec3d::UnitY()), options);
}

// A square of ground below the mesh, at a distance of a thousandth of its size, so that a flat mesh does not coincide
// with it.
Shape ground_below(const Extent& extent, double size) {
  const double y = (extent.lo.y() - extent.hi.y()) / 2 - 1e-3 * size, half = 50 * size;
  return TriangleMesh::rectangle(
      Transform::columns(half * Vec3d::UnitX(), -half * Vec3d::UnitZ(), Vec3d::UnitY(), {0, y, 0}));
}

const Spectrum grey = Spectrum::Constant(Float(0.6));

/// The materials of an OBJ file.
class Materials {
 public:
  // Reads the files that an OBJ file names. What is missing is a warning, and the material is grey.
  Materials(const std::string& path, const MeshFile& mesh)
      : path_(path), folder_(std::filesystem::path(path).parent_path()), files_({path}) {
    for (const std::string& name : mesh.material_files)
      if (const auto mtl = existing(name, "mtllib")) materials_.merge(read_mtl(*mtl));
  }

  /// Adds the triangles of the material with this name.
  void add(const std::string& name, const MeshFile& triangles, Shape shape, SceneBuilder& builder) {
    const auto known = materials_.find(name);
    if (known == materials_.end()) return builder.add(std::move(shape), {builder.add(Lambert(grey))});
    const MtlMaterial& mtl = known->second;
    const bool emits = mtl.Ke && !is_black(*mtl.Ke);
    Material material = material_of(mtl, triangles);
    if (mtl.d < 1 && !refracts(mtl) && !emits) material.mask = std::make_shared<const Mask>(Float(mtl.d));
    SceneBuilder::SurfaceProperties properties{.bsdf = builder.add(std::move(material))};
    if (emits) properties.emission = Emission{*mtl.Ke};
    builder.add(std::move(shape), properties);
  }

  /// All files read.
  const std::set<std::string>& files() const { return files_; }
  /// What is missing.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  // Glass, diffuse, or diffuse under a coat whose highlight is about as wide as that of the exponent Ns [WalterEtAl07].
  Material material_of(const MtlMaterial& mtl, const MeshFile& triangles) {
    if (refracts(mtl)) return Bsdf(Dielectric(Float(mtl.Ni)));
    const Spectrum diffuse = mtl.Kd.value_or(grey).min(Float(1));
    const Spectrum specular = mtl.Ks.value_or(Spectrum::Zero()).min(Float(1));
    const auto alpha = Float(std::clamp(std::sqrt(2 / (mtl.Ns + 2)), double(least_alpha), 1.0));
    const Bsdf bsdf = is_black(specular) ? Bsdf(Lambert(diffuse))
                                         : Bsdf(RoughPlastic<LayeredBase>(Float(1.5), alpha, diffuse, specular));
    if (mtl.map_Kd.empty()) return bsdf;
    if (triangles.uvs.empty()) {
      warnings_.push_back(fmt::format("{}: map_Kd {} needs texture coordinates, but {}; its Kd is used", path_,
                                      mtl.map_Kd, triangles.missing_uv_reason));
      return bsdf;
    }
    const auto path = existing(mtl.map_Kd, "map_Kd");
    if (!path) return bsdf;
    std::shared_ptr<const Texels>& picture = pictures_[*path];
    if (!picture) {
      Image image = read_image(*path);
      picture = std::make_shared<const Texels>(image.width, image.height, std::move(image.pixels), *path);
    }
    return TexturedBsdf(bsdf, {.diffuse_reflectance = Bitmap(picture)});
  }
  static bool refracts(const MtlMaterial& mtl) { return mtl.is_glass() && std::abs(mtl.Ni - 1) >= 1e-4; }
  // The path of a file that a statement names.
  std::optional<std::string> existing(std::string name, const char* statement) {
    std::replace(name.begin(), name.end(), '\\', '/');
    std::string path = (folder_ / name).string();
    if (std::filesystem::exists(path)) {
      files_.insert(path);
      return path;
    }
    warnings_.push_back(fmt::format("{}: {} {}: no such file; it is left out", path_, statement, name));
    return {};
  }

  std::string path_;
  std::filesystem::path folder_;
  std::map<std::string, MtlMaterial, std::less<>> materials_;
  std::map<std::string, std::shared_ptr<const Texels>> pictures_; ///< by path: materials share them
  std::set<std::string> files_;
  std::vector<std::string> warnings_;
};

bool has_area(const MeshFile& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    const Vec3d &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    return mc::cross<double>(b - a, c - a).squaredNorm() > 0;
  });
}

} // namespace

bool is_mesh_file(const std::string& path) {
  const std::string extension = mc::lowercase_extension(path);
  return extension == ".obj" || extension == ".ply" || extension == ".serialized";
}

SceneFile read_mesh_scene(const std::string& path) {
  const MeshFile mesh = read_mesh(path);
  const Extent extent = extent_of(mesh);
  const Vec3d middle = (extent.lo + extent.hi) / 2;
  const double size = (extent.hi - extent.lo).stableNorm() / 2;
  SceneBuilder builder;
  return mc::with_context(path, [&] {
    mc::require(!mesh.triangles.empty(), "no triangle; at least one is needed");
    mc::require(size <= largest, "the mesh reaches {:.3g} from its middle, more than {:.0g}; scale it down", size,
                largest);
    const auto shape_of = [&](const MeshFile& part) {
      return to_shape(part, Transform::translate(-middle), part.normals.empty());
    };
    Materials materials(path, mesh);
    if (mesh.triangle_materials.empty()) builder.add(shape_of(mesh), {builder.add(Lambert(grey))});
    const std::vector<MeshFile> parts = parts_of(mesh);
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (has_area(parts[i])) materials.add(mesh.material_names[i], parts[i], shape_of(parts[i]), builder);
    builder.add(ground_below(extent, size), {builder.add(Lambert(Spectrum::Constant(Float(0.4))))});
    builder.add(Light(GradientBackground()));
    builder.set(camera_for(mesh, middle, size));
    SceneFile file{builder.build(), {.width = 640, .height = 480, .spp = 64}, middle};
    file.files = materials.files();
    file.warnings = materials.warnings();
    if (mesh.meshes > 1)
      file.warnings.push_back(fmt::format(
          "{}: this is mesh 0 of the {} in it; a scene shows others, by <shape type=\"serialized\"> with shapeIndex",
          path, mesh.meshes));
    return file;
  });
}

} // namespace render
