#include <render/accel/bvh.h>

#include <algorithm>
#include <cmath>

namespace render {

/// The ray turned so that its longest axis is z and sheared to (0, 0, 1) [WoopBenthinWald13, section 3].
struct Shear {
  int kx, ky, kz;
  Float sx, sy;

  explicit Shear(const Vec3& d) {
    d.cwiseAbs().maxCoeff(&kz);
    kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    sx = d[kx] / d[kz], sy = d[ky] / d[kz];
  }
};

namespace {

Box sphere_box(const Sphere& s) {
  // Rounded outward, so that the float box holds the double sphere.
  Box box;
  for (int a = 0; a < 3; ++a) {
    box.lo[a] = std::nextafter(Float(s.center()[a] - s.radius()), -mc::infinity<Float>);
    box.hi[a] = std::nextafter(Float(s.center()[a] + s.radius()), mc::infinity<Float>);
  }
  return box;
}

} // namespace

Bvh::Bvh(std::span<const Shape> shapes) {
  std::vector<Box> triangle_boxes, sphere_boxes;
  std::vector<std::array<Vec3, 3>> vertices;
  std::vector<Sphere> spheres;
  std::vector<int> sphere_ids;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&shapes[i])) {
      for (std::size_t t = 0; t < mesh->size(); ++t) {
        const auto v = mesh->vertices(t);
        const Vec3d a = v[0].cast<double>();
        if (!(mc::cross<double>(v[1].cast<double>() - a, v[2].cast<double>() - a).squaredNorm() > 0)) continue;
        Box box;
        for (const Vec3& p : v) box.add(p);
        triangle_boxes.push_back(box);
        vertices.push_back(v);
        triangle_ids_.push_back({static_cast<int>(i), static_cast<int>(t)});
      }
    } else {
      spheres.push_back(std::get<Sphere>(shapes[i]));
      sphere_ids.push_back(static_cast<int>(i));
      sphere_boxes.push_back(sphere_box(spheres.back()));
    }
  }
  for (const Box& b : triangle_boxes) bounds_.add(b);
  for (const Box& b : sphere_boxes) bounds_.add(b);

  triangle_tree_ = WideTree(triangle_boxes);
  for (const auto& leaf : triangle_tree_.leaves()) {
    TriangleBlock block;
    for (std::uint32_t lane = 0; lane < 4; ++lane) {
      const std::uint32_t id = triangle_tree_.order()[leaf.first + std::min(lane, leaf.count - 1)];
      for (int k = 0; k < 3; ++k)
        for (int a = 0; a < 3; ++a) block.v[k][a][lane] = vertices[id][static_cast<std::size_t>(k)][a];
      block.id[lane] = id;
    }
    triangle_blocks_.push_back(block);
  }
  sphere_tree_ = WideTree(sphere_boxes);
  for (const auto& leaf : sphere_tree_.leaves()) {
    SphereBlock block;
    for (std::uint32_t lane = 0; lane < 4; ++lane) {
      const std::uint32_t id = sphere_tree_.order()[leaf.first + std::min(lane, leaf.count - 1)];
      const Sphere& s = spheres[id];
      for (int a = 0; a < 3; ++a) {
        block.center[a][lane] = s.center()[a];
        block.axis[a][lane] = s.axis()[a];
      }
      block.radius2[lane] = s.radius() * s.radius();
      block.cap[lane] = s.is_cap() ? s.radius() - s.height() : -mc::infinity<double>;
      block.shape[lane] = sphere_ids[id];
    }
    sphere_blocks_.push_back(block);
  }
}

// U, V, W are the signed areas opposite vertices 0, 1, 2 in the sheared frame; all of one sign: inside.
template <bool any>
bool Bvh::intersect_block(const TriangleBlock& block, const Ray& ray, const Shear& shear, Float& t_max, Hit& hit) const {
  Four x[3], y[3];
  for (int k = 0; k < 3; ++k) {
    const Four z = block.v[k][shear.kz] - ray.o[shear.kz];
    x[k] = (block.v[k][shear.kx] - ray.o[shear.kx]) - shear.sx * z;
    y[k] = (block.v[k][shear.ky] - ray.o[shear.ky]) - shear.sy * z;
  }
  const Four u4 = x[2] * y[1] - y[2] * x[1], v4 = x[0] * y[2] - y[0] * x[2], w4 = x[1] * y[0] - y[1] * x[0];
  const Four lowest = u4 < v4 ? (u4 < w4 ? u4 : w4) : (v4 < w4 ? v4 : w4);
  const Four highest = u4 > v4 ? (u4 > w4 ? u4 : w4) : (v4 > w4 ? v4 : w4);
  const auto candidates = (lowest >= 0) | (highest <= 0);
  if (!(candidates[0] | candidates[1] | candidates[2] | candidates[3])) return false;

  bool found = false;
  for (int lane = 0; lane < 4; ++lane) {
    if (!candidates[lane]) continue;
    double u = double(u4[lane]), v = double(v4[lane]), w = double(w4[lane]);
    if (u == 0 || v == 0 || w == 0) {
      // On an edge to float precision: products of floats are exact in double, so both neighbours decide alike.
      const auto edge = [&](int a, int b) {
        return double(x[a][lane]) * double(y[b][lane]) - double(y[a][lane]) * double(x[b][lane]);
      };
      u = edge(2, 1), v = edge(0, 2), w = edge(1, 0);
      if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) continue;
    }
    const double det = u + v + w;
    if (det == 0) continue;

    const auto vertex = [&](int k) { return Vec3d(block.v[k][0][lane], block.v[k][1][lane], block.v[k][2][lane]); };
    // Differences of floats and their products are all but exact in double; no compensated product is needed.
    const Vec3d p0 = vertex(0), e1 = vertex(1) - p0, e2 = vertex(2) - p0;
    const Vec3d n(e1.y() * e2.z() - e1.z() * e2.y(), e1.z() * e2.x() - e1.x() * e2.z(), e1.x() * e2.y() - e1.y() * e2.x());
    const double t = n.dot(p0 - ray.o.cast<double>()) / n.dot(ray.d.cast<double>());
    if (!(t > 0 && t < double(t_max))) continue;
    if constexpr (any) return true;
    const Float rounded = Float(t);
    t_max = rounded;
    const TriangleId id = triangle_ids_[block.id[lane]];
    hit = {rounded, id.shape, id.prim, Float(v / det), Float(w / det)};
    found = true;
  }
  return found;
}

// Sphere::intersect, four at a time.
bool Bvh::intersect_block(const SphereBlock& block, const Ray& ray, Float& t_max, Hit& hit) {
  const Vec3d d = ray.d.cast<double>();
  const double a = d.squaredNorm(), inverse_a = 1 / a;
  const FourDoubles ox = double(ray.o.x()) - block.center[0], oy = double(ray.o.y()) - block.center[1], oz = double(ray.o.z()) - block.center[2];
  const FourDoubles b = -(ox * d.x() + oy * d.y() + oz * d.z()), nearest = b * inverse_a;
  const FourDoubles px = ox + d.x() * nearest, py = oy + d.y() * nearest, pz = oz + d.z() * nearest;
  const FourDoubles discriminant = block.radius2 - (px * px + py * py + pz * pz);
  const auto crossed = discriminant >= 0;
  if (!(crossed[0] | crossed[1] | crossed[2] | crossed[3])) return false;

  FourDoubles root;
  for (int i = 0; i < 4; ++i) root[i] = std::sqrt(crossed[i] ? a * discriminant[i] : 0.0);
  const FourDoubles q = b < 0 ? b - root : b + root;
  const FourDoubles c = ox * ox + oy * oy + oz * oz - block.radius2;
  const FourDoubles first = q * inverse_a, second = c / q; // q = 0 gives NaN, which is no hit
  const FourDoubles t0 = first < second ? first : second, t1 = first < second ? second : first;
  const double limit = double(t_max);
  const FourDoubles along = block.axis[0] * d.x() + block.axis[1] * d.y() + block.axis[2] * d.z();
  const FourDoubles start = block.axis[0] * ox + block.axis[1] * oy + block.axis[2] * oz;
  const auto hit0 = crossed & (t0 > 0) & (t0 < limit) & (start + t0 * along >= block.cap);
  const auto hit1 = crossed & (t1 > 0) & (t1 < limit) & (start + t1 * along >= block.cap);
  bool found = false;
  for (int i = 0; i < 4; ++i) {
    if (!(hit0[i] | hit1[i])) continue;
    const double t = hit0[i] ? t0[i] : t1[i];
    if (found && !(t < double(t_max))) continue;
    found = true;
    t_max = Float(t);
    hit = {t_max, block.shape[i], 0, 0, 0};
  }
  return found;
}

template <bool any> bool Bvh::trace(const Ray& ray, Hit& hit) const {
  constexpr auto order = any ? WideTree::Order::any : WideTree::Order::near_first;
  Float t_max = ray.t_max;
  bool found = false;
  if (!triangle_tree_.empty()) {
    const Shear shear(ray.d);
    triangle_tree_.traverse<order>(ray, t_max, [&](std::uint32_t leaf, Float& t) {
      found |= intersect_block<any>(triangle_blocks_[leaf], ray, shear, t, hit);
      return any && found;
    });
    if (any && found) return true;
  }
  sphere_tree_.traverse<order>(ray, t_max, [&](std::uint32_t leaf, Float& t) {
    found |= intersect_block(sphere_blocks_[leaf], ray, t, hit);
    return any && found;
  });
  return found;
}

std::optional<Hit> Bvh::intersect(const Ray& ray) const {
  Hit hit;
  return trace<false>(ray, hit) ? std::optional(hit) : std::nullopt;
}

bool Bvh::occluded(const Ray& ray) const {
  Hit hit;
  return trace<true>(ray, hit);
}

} // namespace render
