#include <render/accel/bvh.h>

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include <gtest/gtest.h>

#include <map>

namespace {

using namespace render;
using Triangle = std::array<std::uint32_t, 3>;

Vec3 direction(mc::Pcg& random) { return mc::UniformSphere<Float>{}.sample(random.point<Float, 2>()); }
Vec3 in_cube(mc::Pcg& random) { return Vec3::Constant(-1) + Vec3(2 * random.point<Float, 3>()); }

Shape soup(int n, Float size, std::uint64_t seed) {
  mc::Pcg random(seed);
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (int i = 0; i < n; ++i) {
    const Vec3 center = in_cube(random);
    for (int k = 0; k < 3; ++k) positions.push_back(center + size * in_cube(random));
    const auto first = static_cast<std::uint32_t>(3 * i);
    triangles.push_back({first, first + 1, first + 2});
  }
  return TriangleMesh(positions, triangles);
}

struct Solid {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
};

/// An octahedron, subdivided `levels` times on the unit sphere, then scaled and translated.
Solid ball(int levels, Float scale, const Vec3& center) {
  Solid s{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(s.positions.size()));
      if (fresh) s.positions.push_back(Vec3(s.positions[a] + s.positions[b]).normalized());
      return it->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : s.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    s.triangles = finer;
  }
  for (Vec3& p : s.positions) p = scale * p + center;
  return s;
}

/// The nearest crossing, by testing every triangle in double. `clear` is false if a crossing is too close to an edge,
/// or a triangle too steep, for float coordinates to decide.
struct Answer {
  double t = mc::infinity<double>;
  int prim = -1;
  bool clear = true;
};

Answer brute_force(const TriangleMesh& mesh, const Ray& ray) {
  Answer best;
  const Vec3d o = ray.o.cast<double>(), d = ray.d.cast<double>();
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const auto v = mesh.vertices(i);
    const Vec3d a = v[0].cast<double>(), e1 = v[1].cast<double>() - a, e2 = v[2].cast<double>() - a,
                n = mc::cross<double>(e1, e2);
    const double det = -n.dot(d);
    const Vec3d s = o - a, q = mc::cross<double>(s, d);
    const double t = n.dot(s) / det, b1 = e2.dot(q) / det, b2 = -e1.dot(q) / det,
                 inside = std::min({b1, b2, 1 - b1 - b2});
    if (inside < -1e-3 || t < -1e-3) continue;
    if (std::abs(det) < 1e-3 * n.norm() || inside < 1e-3 || std::abs(t) < 1e-3) best.clear = false;
    if (t > 0 && t < best.t) {
      best.t = t;
      best.prim = static_cast<int>(i);
    }
  }
  return best;
}

TEST(Bvh, FindsWhatTestingEveryTriangleFinds) {
  int compared = 0, hits = 0;
  for (const auto& [n, size] : {std::pair{1, 1.0}, {3, 0.8}, {60, 0.4}, {1000, 0.15}}) {
    const Shape shape = soup(n, Float(size), 7);
    const Bvh bvh(std::span(&shape, 1));
    mc::Pcg random(8);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 o = 2 * in_cube(random);
      const Ray ray{o, Vec3(in_cube(random) - o).normalized()};
      const Answer truth = brute_force(std::get<TriangleMesh>(shape), ray);
      const auto hit = bvh.intersect(ray);
      EXPECT_EQ(bvh.occluded(ray), hit.has_value()) << "closest and any hit disagree, ray " << i;
      if (!truth.clear) continue;
      ++compared;
      ASSERT_EQ(hit.has_value(), truth.prim >= 0) << n << " triangles, ray " << i;
      if (!hit) continue;
      ++hits;
      EXPECT_EQ(hit->prim, truth.prim) << n << " triangles, ray " << i;
      // One rounding to Float, plus the rounding of both double evaluations, which a slope of 1e-3 magnifies.
      EXPECT_LE(std::abs(double(hit->t) - truth.t),
                std::numeric_limits<Float>::epsilon() * truth.t + 0x1p-52 * 1e3 * 16);
      // t is rounded once. The barycentric point agrees with the ray up to the rounding of float differences.
      const Vec3 p = shape.surface_point(ray, *hit).p;
      EXPECT_LE((p - ray.at(hit->t)).norm(), 1e-5);
    }
  }
  EXPECT_GE(compared, 3500);
  EXPECT_GE(hits, 500);
}

#if defined(__SIZEOF_FLOAT128__)
__extension__ using Exact = __float128; // holds the products of three differences of floats
#else
using Exact = long double; // of 113 bits, too
#endif

/// The nearest triangle that a ray meets, by exact arithmetic; -1: none.
int exact_hit(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles, const Ray& ray) {
  using V = std::array<Exact, 3>;
  const auto from = [](const Vec3& a, const Vec3& b) {
    return V{Exact(a.x()) - Exact(b.x()), Exact(a.y()) - Exact(b.y()), Exact(a.z()) - Exact(b.z())};
  };
  const auto triple = [](const V& a, const V& b, const V& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  const V d = from(ray.d, Vec3::Zero());
  int nearest = -1;
  Exact t = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Vec3 &p = positions[triangles[i][0]], &q = positions[triangles[i][1]], &r = positions[triangles[i][2]];
    const V a = from(p, ray.o), b = from(q, ray.o), c = from(r, ray.o);
    const Exact u = triple(d, c, b), v = triple(d, a, c), w = triple(d, b, a), det = u + v + w;
    if (det == 0 || (u < 0 || v < 0 || w < 0) == (u > 0 || v > 0 || w > 0)) continue;
    const Exact here = triple(a, b, c) / -det;
    if (here > 0 && (nearest < 0 || here < t)) nearest = static_cast<int>(i), t = here;
  }
  return nearest;
}

// Rays that leave long and thin triangles. They do not meet the triangle that they leave.
TEST(Bvh, RaysFromNeedlesHitWhatExactArithmeticFinds) {
  mc::Pcg random(2);
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 700; ++i) {
    const Vec3 middle = Float(0.25) * in_cube(random), along = direction(random) * Float(0.1),
               across = mc::cross<Float>(along, direction(random)) * Float(0.03);
    positions.insert(positions.end(), {middle - along, middle + along, middle + across});
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const std::array shapes{Shape(TriangleMesh(positions, triangles))};
  const Bvh bvh{std::span<const Shape>(shapes)};
  int hits = 0;
  for (int rays = 0; rays < 700;) {
    const Vec2 at = Float(0.25) * (2 * random.point<Float, 2>() - Vec2::Ones());
    const Ray arrives{Vec3(at.x(), at.y(), -4), Vec3(0, 0, 1)};
    const auto hit = bvh.intersect(arrives);
    if (!hit) continue;
    ++rays;
    const Ray leaves = shapes[0].surface_point(arrives, *hit).spawn_ray(direction(random));
    const auto next = bvh.intersect(leaves);
    hits += next.has_value();
    EXPECT_EQ(next ? next->prim : -1, exact_hit(positions, triangles, leaves));
  }
  EXPECT_GE(hits, 30);
}

TEST(Bvh, HitsEndBeforeTMax) {
  const Shape shape = soup(200, Float(0.3), 9);
  const Bvh bvh(std::span(&shape, 1));
  mc::Pcg random(10);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    Ray ray{2 * in_cube(random), direction(random)};
    const auto hit = bvh.intersect(ray);
    if (!hit) continue;
    ++hits;
    ray.t_max = std::nextafter(std::nextafter(Float(hit->t), Float(0)), Float(0));
    EXPECT_FALSE(bvh.occluded(ray)) << i;
    EXPECT_EQ(bvh.intersect(ray), std::nullopt) << i;
    ray.t_max = std::nextafter(Float(hit->t), mc::infinity<Float>);
    EXPECT_TRUE(bvh.occluded(ray)) << i;
  }
  EXPECT_GE(hits, 200);
}

// Rays from inside a closed mesh towards vertices and points of edges: none escapes, at any position of the mesh.
TEST(Bvh, ClosedMeshesDoNotLeak) {
  int rays = 0, leaks = 0, missed_by_any = 0;
  for (const Float scale : {Float(1e-4), Float(1), Float(1e6)})
    for (const Vec3& center : {Vec3(0, 0, 0), Vec3(Float(0.3), -70, 11)}) {
      const Solid solid = ball(4, scale, scale * center);
      const Shape shape = TriangleMesh(solid.positions, solid.triangles);
      const Bvh bvh(std::span(&shape, 1));
      mc::Pcg random(11);
      for (const auto& triangle : solid.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 a = solid.positions[triangle[k]], b = solid.positions[triangle[(k + 1) % 3]];
          const Vec3 o = scale * (center + Float(0.4) * in_cube(random));
          for (const Float s : {Float(0), Float(0.5), random.uniform<Float>()}) {
            const Ray ray{o, Vec3(a + s * (b - a) - o).normalized()};
            ++rays;
            leaks += !bvh.intersect(ray);
            missed_by_any += !bvh.occluded(ray);
          }
        }
    }
  EXPECT_EQ(leaks, 0) << "of " << rays;
  EXPECT_EQ(missed_by_any, 0) << "of " << rays;
}

// Axis-parallel rays in the planes of boxes: the slab test computes 0 * inf.
TEST(Bvh, AxisParallelRaysThroughVerticesHit) {
  constexpr int n = 24, middle = n / 2;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        Vec3 p = Vec3::Zero();
        p[(axis + 1) % 3] = Float(i - middle);
        p[(axis + 2) % 3] = Float(j - middle);
        positions.push_back(p);
        if (i == n || j == n) continue;
        const auto a = static_cast<std::uint32_t>(i * (n + 1) + j), b = a + n + 1;
        triangles.push_back({a, b, b + 1});
        triangles.push_back({a, b + 1, a + 1});
      }
    const Shape shape = TriangleMesh(positions, triangles);
    const Bvh bvh(std::span(&shape, 1));
    for (const Float zero : {Float(0), Float(-0.0)})
      for (const Float side : {Float(1), Float(-1)})
        for (int i = 0; i <= 2 * n; ++i)
          for (int j = 0; j <= 2 * n; ++j) {
            Ray ray{Vec3::Zero(), Vec3::Constant(zero)};
            ray.o[axis] = side;
            ray.d[axis] = -side;
            ray.o[(axis + 1) % 3] = Float(i - n) / 2;
            ray.o[(axis + 2) % 3] = Float(j - n) / 2;
            const auto hit = bvh.intersect(ray);
            ASSERT_TRUE(hit.has_value()) << "axis " << axis << " from " << ray.o.transpose();
            EXPECT_EQ(hit->t, Float(1));
            EXPECT_TRUE(bvh.occluded(ray));
          }
  }
}

TEST(Bvh, EmptyDegenerateAndRepeatedTriangles) {
  const Ray down{Vec3(Float(0.25), Float(0.25), 1), Vec3(0, 0, -1)};
  EXPECT_EQ(Bvh{}.intersect(down), std::nullopt);
  EXPECT_FALSE(Bvh(std::span<const Shape>{}).occluded(down));

  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {Float(0.5), Float(0.5), 0}};
  const Shape degenerate = TriangleMesh(corners, {{0, 1, 1}, {2, 2, 2}, {1, 2, 3}});
  EXPECT_EQ(Bvh(std::span(&degenerate, 1)).intersect(down), std::nullopt);
  EXPECT_EQ(Bvh(std::span(&degenerate, 1)).intersect({Vec3(0, 0, 1), Vec3(0, 0, -1)}), std::nullopt);

  std::vector<Triangle> many(20000, Triangle{0, 1, 2});
  for (std::size_t i = 0; i < many.size(); i += 10) many[i] = {0, 1, 1};
  const Shape repeated = TriangleMesh(corners, many);
  const Bvh bvh(std::span(&repeated, 1));
  const auto hit = bvh.intersect(down);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->t, Float(1));
  EXPECT_NE(hit->prim % 10, 0) << "a degenerate triangle was hit";
}

TEST(Bvh, SpheresAndCapsAgreeWithTheShapesThemselves) {
  mc::Pcg random(12);
  std::vector<Shape> shapes = {Sphere(Vec3d(0, -1e5 - 1, 0), 1e5),
                               Sphere::cap(Vec3d(0, 601, 0), 600, Vec3d(0, -1, 0), 0.3)};
  for (int i = 0; i < 200; ++i)
    shapes.push_back(Sphere(in_cube(random).cast<double>(), 0.01 + 0.1 * random.uniform<double>(), i % 2 == 0));
  shapes.push_back(soup(100, Float(0.2), 13));
  const Bvh bvh(shapes);
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const Ray ray{2 * in_cube(random), direction(random)};
    double t = mc::infinity<double>;
    for (std::size_t k = 0; k + 1 < shapes.size(); ++k)
      t = std::min(t, std::get<Sphere>(shapes[k]).intersect(ray).value_or(t));
    t = std::min(t, brute_force(std::get<TriangleMesh>(shapes.back()), ray).t);
    const auto hit = bvh.intersect(ray);
    ASSERT_EQ(hit.has_value(), t < mc::infinity<double>) << i;
    EXPECT_EQ(bvh.occluded(ray), hit.has_value()) << i;
    if (!hit) continue;
    ++hits;
    // t is rounded to Float. The two orders of evaluation in double differ by a few ulp of the extent along the normal.
    const Shape& shape = shapes[static_cast<std::size_t>(hit->shape)];
    const SurfacePoint point = shape.surface_point(ray, *hit);
    double extent = double(ray.o.norm() + point.p.norm());
    if (const auto* sphere = std::get_if<Sphere>(&shape)) extent += sphere->radius() + sphere->center().norm();
    const double rounding = 0x1p-50 * extent / double(std::abs(point.ng.dot(ray.d)));
    EXPECT_LE(std::abs(double(hit->t) - t), 1.01 * std::numeric_limits<Float>::epsilon() * t + rounding) << i;
  }
  EXPECT_GE(hits, 1000);
}

TEST(Bvh, BoundsHoldEverything) {
  const std::vector<Shape> shapes = {Sphere(Vec3d(3, 0, 0), 1), soup(10, Float(0.1), 14)};
  const Bounds bounds = Bvh(shapes).bounds();
  EXPECT_GE(bounds.hi.x(), 4);
  EXPECT_LE(bounds.lo.y(), -1);
}

} // namespace
