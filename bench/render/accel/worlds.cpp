#include "worlds.h"

#include <render/io/mitsuba/mitsuba.h>

#include <mc/core/frame.h>
#include <mc/random/pcg.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/sphere.h>

#include <cmath>

namespace bench {

namespace {

using mc::pi;

void add_quad(World& w, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto first = static_cast<std::uint32_t>(w.positions.size());
  w.positions.insert(w.positions.end(), {a, b, c, d});
  w.triangles.push_back({first, first + 1, first + 2});
  w.triangles.push_back({first, first + 2, first + 3});
}

render::ThinLens looking_from(const Vec3& origin) {
  render::Transform to_world;
  to_world.translation = origin.cast<double>();
  return render::ThinLens(to_world, {.fov = 50});
}

Vec3 in_cube(mc::Pcg& random) { return 2 * random.point<Float, 3>() - Vec3::Ones(); }
Vec3 direction(mc::Pcg& random) { return mc::UniformSphere<Float>{}.sample(random.point<Float, 2>()); }

} // namespace

std::vector<render::Shape> World::shapes() const {
  std::vector<render::Shape> made = meshes;
  if (meshes.empty() && !triangles.empty()) made.emplace_back(render::TriangleMesh(positions, triangles));
  for (const Ball& s : spheres) made.emplace_back(render::Sphere(s.center.cast<double>(), double(s.radius)));
  for (render::Shape& s : made) s.discard_sampling_table();
  return made;
}

World bumpy_sphere(std::string name, int n) {
  World w{std::move(name)};
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double theta = pi<double> * (i + 0.02) / (n + 0.04), phi = 2 * pi<double> * j / n;
      const double r = 1 + 0.08 * std::sin(17 * theta) * std::cos(13 * phi) + 0.02 * std::sin(61 * theta + 47 * phi);
      w.positions.push_back(Vec3(Float(r * std::sin(theta) * std::cos(phi)), Float(r * std::sin(theta) * std::sin(phi)),
                                 Float(r * std::cos(theta))));
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const auto a = static_cast<std::uint32_t>(i * (n + 1) + j), b = a + static_cast<std::uint32_t>(n) + 1;
      w.triangles.push_back({a, b, b + 1});
      w.triangles.push_back({a, b + 1, a + 1});
    }
  const Float s = 2;
  add_quad(w, {-s, -s, -s}, {s, -s, -s}, {s, -s, s}, {-s, -s, s});
  add_quad(w, {-s, s, -s}, {-s, s, s}, {s, s, s}, {s, s, -s});
  add_quad(w, {-s, -s, -s}, {-s, -s, s}, {-s, s, s}, {-s, s, -s});
  add_quad(w, {s, -s, -s}, {s, s, -s}, {s, s, s}, {s, -s, s});
  add_quad(w, {-s, -s, s}, {s, -s, s}, {s, s, s}, {-s, s, s});
  w.camera = looking_from({0, 0, -5});
  return w;
}

World needles(int count) {
  World w{"needles"};
  mc::Pcg random(2);
  for (int i = 0; i < count; ++i) {
    const Vec3 middle = in_cube(random);
    const Vec3 along = direction(random) * Float(0.1),
               across = mc::cross<Float>(along, direction(random)) * Float(0.01);
    const auto first = static_cast<std::uint32_t>(w.positions.size());
    w.positions.insert(w.positions.end(), {middle - along, middle + along, middle + across});
    w.triangles.push_back({first, first + 1, first + 2});
  }
  w.camera = looking_from({0, 0, -4});
  return w;
}

World balls(int count) {
  World w{"spheres"};
  mc::Pcg random(3);
  const Float distance = 2 / std::cbrt(Float(count));
  for (int i = 0; i < count; ++i) {
    const Vec3 center = in_cube(random);
    w.spheres.push_back({center, distance * (Float(0.01) + Float(0.19) * random.uniform<Float>())});
  }
  w.camera = looking_from({0, 0, -4});
  return w;
}

World scene_file(const std::string& path) {
  World w{path.substr(path.find_last_of('/') + 1)};
  const render::SceneFile file = render::read_mitsuba(path);
  for (const render::Surface& s : file.scene.surfaces()) {
    const auto* mesh = std::get_if<render::TriangleMesh>(s.shape.get());
    if (mesh) w.meshes.emplace_back(*mesh);
    for (std::size_t t = 0; mesh && t < mesh->size(); ++t) {
      const auto first = static_cast<std::uint32_t>(w.positions.size());
      for (const Vec3& p : mesh->vertices(t)) w.positions.push_back(p);
      w.triangles.push_back({first, first + 1, first + 2});
    }
  }
  w.camera = file.scene.camera();
  return w;
}

Rays::Rays(const World& world, const std::vector<render::Shape>& shapes, const render::Bvh& bvh, int n) {
  mc::Pcg random(1);
  const auto tan_half = world.camera.tan_half(1);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Ray ray =
          world.camera.ray({(Float(x) + Float(0.5)) / Float(n), (Float(y) + Float(0.5)) / Float(n)}, tan_half, {0, 0});
      primary.push_back(ray);
      const auto hit = bvh.intersect(ray);
      if (!hit) continue;
      const auto p = shapes[static_cast<std::size_t>(hit->shape)].surface_point(ray, *hit);
      const auto frame = mc::Frame<Float>::from_z(p.ng.dot(ray.d) < 0 ? p.ng : Vec3(-p.ng));
      bounce.push_back(
          p.spawn_ray(frame.to_world(mc::CosineHemisphere<Float>{}.sample(random.point<Float, 2>())).normalized()));
      const Vec3 light = world.camera.origin() + Float(0.1) * (p.p - world.camera.origin()).norm() * direction(random);
      const Vec3 o = p.offset_origin(light - p.p);
      shadow.push_back({o, Vec3(light - o), Float(0.9999)});
    }
}

} // namespace bench
