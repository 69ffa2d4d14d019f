#include <render/io/mesh_scene.h>

#include <render/io/mesh/mesh.h>
#include <render/scene/builder.h>

#include <mc/core/file.h>

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
    TriangleMesh shape = to_shape(mesh, Transform::translate(-middle), mesh.normals.empty());
    builder.add(std::move(shape), {builder.add(Lambert(Spectrum::Constant(Float(0.6))))});
    builder.add(ground_below(extent, size), {builder.add(Lambert(Spectrum::Constant(Float(0.4))))});
    builder.add(Light(GradientBackground()));
    builder.set(camera_for(mesh, middle, size));
    SceneFile file{builder.build(), {.width = 640, .height = 480, .spp = 64}, middle};
    file.files = {path};
    if (mesh.meshes > 1)
      file.warnings.push_back(fmt::format(
          "{}: this is mesh 0 of the {} in it; a scene shows others, by <shape type=\"serialized\"> with shapeIndex",
          path, mesh.meshes));
    return file;
  });
}

} // namespace render
