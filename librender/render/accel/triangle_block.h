#pragma once
/// Triangles as leaves of the BVH.

#include <render/accel/wide_tree.h>
#include <render/core/lanes.h>
#include <render/core/ray.h>
#include <render/shape/triangle_mesh.h>

#include <array>
#include <cmath>
#include <type_traits>

namespace render {

/// Eight triangles. A block type of BlockTree.
///   inside test : watertight [WoopBenthinWald13]; a hit exactly on an edge is decided again in double.
///   distance    : from the plane equation in double. The distance of the watertight test can be far less accurate.
/// Degenerate triangles are left out.
class TriangleBlock {
 public:
  /// Kind of the shapes whose primitives are triangles.
  using ShapeType = TriangleMesh;
  static constexpr std::uint32_t max_brute_force =
      48; ///< Up to this number of triangles, testing all blocks is faster than a node and sorting its children.

  /// One triangle of a mesh.
  struct Primitive {
    const TriangleMesh* mesh; ///< Mesh of the triangle.
    int shape, prim;          ///< Indices of the shape and of the triangle in its mesh.

    /// Corners of the triangle.
    std::array<Vec3, 3> vertices() const { return mesh->vertices(static_cast<std::size_t>(prim)); }
    /// Bounds of the triangle.
    Bounds bounds() const {
      Bounds b;
      for (const Vec3& p : vertices()) b.add(p);
      return b;
    }
  };
  /// Number of triangles in a mesh, degenerate ones included.
  static std::size_t size(const TriangleMesh& mesh) { return mesh.size(); }
  /// Writes the triangles of [begin, end) that are not degenerate to `to`; returns the end of the output.
  static Primitive* collect(const TriangleMesh& mesh, int index, std::size_t begin, std::size_t end, Primitive* to);

  /// The ray, rotated so that its longest axis is z and sheared to (0, 0, 1) [WoopBenthinWald13, section 3].
  struct RaySetup {
    int kx, ky, kz; ///< Permutation of the axes; kz is the longest axis of the direction.
    Float sx, sy;   ///< Shear.

    explicit RaySetup(const Ray& ray) {
      const Vec3& d = ray.d;
      const Float ax = std::abs(d.x()), ay = std::abs(d.y());
      kz = std::abs(d.z()) > std::max(ax, ay) ? 2 : int(ay > ax); // compiles to no branch
      kx = (kz + 1) % 3;
      ky = (kz + 2) % 3;
      sx = d[kx] / d[kz];
      sy = d[ky] / d[kz];
    }
  };

  /// Stores a triangle in a lane.
  void set(std::uint32_t lane, const Primitive& p) {
    const auto v = p.vertices();
    for (std::size_t k = 0; k < 3; ++k)
      for (int a = 0; a < 3; ++a) v_[k][a][lane] = v[k][a];
    shape_[lane] = p.shape;
    prim_[lane] = p.prim;
  }

  /// Nearest hit with 0 < t < t_max, stored in t_max and hit; with any = true, only whether there is a hit.
  template <bool any> bool intersect(const Ray& ray, const RaySetup& shear, Float& t_max, Hit& hit) const;

 private:
  Vec3d vertex(std::size_t k, int lane) const {
    return {double(v_[k][0][lane]), double(v_[k][1][lane]), double(v_[k][2][lane])};
  }
  /// The ray intersects the plane of a triangle at t = above / slope. Differences of floats and their products are
  /// nearly exact in double; if Float is double, the products are compensated. The plane is not stored in the block:
  /// few triangles of a block need it, and it would make the block much larger.
  struct PlaneCrossing {
    double above, slope;
  };
  PlaneCrossing plane_crossing(const Ray& ray, int lane) const {
    const Vec3d a = vertex(0, lane), b = vertex(1, lane) - a, c = vertex(2, lane) - a;
    const Vec3d n = std::is_same_v<Float, double> ? mc::cross<double>(b, c) : b.cross(c);
    return {n.dot(a - ray.o.cast<double>()), n.dot(ray.d.cast<double>())};
  }

  Lanes v_[3][3]; ///< [vertex][axis]
  int shape_[8], prim_[8];
};

// The ray hits if the signed areas opposite vertices 0, 1, 2 in the sheared frame have the same sign.
template <bool any> bool TriangleBlock::intersect(const Ray& ray, const RaySetup& shear, Float& t_max, Hit& hit) const {
  Lanes x[3], y[3];
  for (int k = 0; k < 3; ++k) {
    const Lanes z = v_[k][shear.kz] - ray.o[shear.kz];
    x[k] = (v_[k][shear.kx] - ray.o[shear.kx]) - shear.sx * z;
    y[k] = (v_[k][shear.ky] - ray.o[shear.ky]) - shear.sy * z;
  }
  const Lanes areas0 = x[2] * y[1] - y[2] * x[1], areas1 = x[0] * y[2] - y[0] * x[2],
              areas2 = x[1] * y[0] - y[1] * x[0];
  const Lanes lowest = detail::smaller(areas0, detail::smaller(areas1, areas2)),
              highest = detail::larger(areas0, detail::larger(areas1, areas2));
  unsigned candidates = detail::less_equal(Lanes{}, lowest) | detail::less_equal(highest, Lanes{});
  bool found = false;
  for (; candidates != 0; candidates &= candidates - 1) {
    const int lane = __builtin_ctz(candidates);
    const auto [above, slope] = plane_crossing(ray, lane);
    const double ahead = slope < 0 ? -above : above;
    if (!(ahead > 0 && ahead < double(t_max) * std::abs(slope))) continue;
    double area0 = double(areas0[lane]), area1 = double(areas1[lane]), area2 = double(areas2[lane]);
    if (area0 == 0 || area1 == 0 || area2 == 0) [[unlikely]] {
      // On an edge to float precision. Products of floats are exact in double, so both triangles at the edge decide
      // consistently.
      const auto edge = [&](int a, int b) {
        return double(x[a][lane]) * double(y[b][lane]) - double(y[a][lane]) * double(x[b][lane]);
      };
      area0 = edge(2, 1);
      area1 = edge(0, 2);
      area2 = edge(1, 0);
      if ((area0 < 0 || area1 < 0 || area2 < 0) && (area0 > 0 || area1 > 0 || area2 > 0)) continue;
    }
    const double det = area0 + area1 + area2;
    if (det == 0) continue;
    if constexpr (any) return true;
    const double t = above / slope;
    t_max = Float(t);
    const double inverse = 1 / det;
    hit = {t, shape_[lane], prim_[lane], Float(area1 * inverse), Float(area2 * inverse)};
    found = true;
  }
  return found;
}

} // namespace render
