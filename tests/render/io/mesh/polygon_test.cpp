#include <render/io/mesh/polygon.h>

#include <mc/core/types.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

using namespace render;
using Points = std::vector<mc::Vec2<double>>;

// Twice the signed area.
double shoelace(const Points& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto &a = p[i], &b = p[(i + 1) % p.size()];
    sum += a.x() * b.y() - b.x() * a.y();
  }
  return sum;
}

// A plane in space; `at` is a point of it.
struct Plane {
  Vec3d origin = Vec3d::Zero(), x = Vec3d::UnitX(), y = Vec3d::UnitY();
  Vec3d at(const mc::Vec2<double>& p) const { return origin + p.x() * x + p.y() * y; }
  Vec3d normal() const { return mc::cross<double>(x, y); }
};

Plane random_plane(mc::Pcg& random, double size, double distance) {
  const auto vector = [&] {
    Vec3d v;
    for (int k = 0; k < 3; ++k) v[k] = 2 * random.uniform<double>() - 1;
    return Vec3d(v.normalized());
  };
  Plane plane{distance * size * vector(), vector(), vector()};
  plane.y = mc::cross<double>(mc::cross<double>(plane.x, plane.y), plane.x).normalized();
  plane.x *= size;
  plane.y *= size;
  return plane;
}

// There are n - 2 triangles of polygon corners. They have the winding and the area of the polygon.
void expect_covers(const Points& polygon, const Plane& plane, double tolerance, const std::string& what) {
  std::vector<Vec3d> corners;
  for (const auto& p : polygon) corners.push_back(plane.at(p));
  const auto triangles = triangulate_polygon(corners);
  ASSERT_EQ(triangles.size(), polygon.size() - 2) << what;
  const Vec3d normal = plane.normal() * (shoelace(polygon) > 0 ? 1 : -1);
  std::vector<int> used(polygon.size());
  double sum = 0, least = 0;
  for (const auto& t : triangles) {
    for (const std::uint32_t i : t) {
      ASSERT_LT(i, polygon.size()) << what;
      used[i] = 1;
    }
    const double area2 = mc::cross<double>(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]).dot(normal) /
                         normal.squaredNorm();
    sum += std::abs(area2);
    least = std::min(least, area2);
  }
  EXPECT_EQ(std::accumulate(used.begin(), used.end(), 0), static_cast<int>(polygon.size())) << what;
  const double area2 = std::abs(shoelace(polygon));
  EXPECT_LE(std::abs(sum - area2), tolerance * area2) << what;
  EXPECT_GE(least, -tolerance * area2) << what << ": one is wound the other way";
}

// Tests the polygon starting at every corner, with both windings, from both sides.
void expect_covers_from_everywhere(Points polygon, const Plane& plane, double tolerance, const std::string& what) {
  for (int turned = 0; turned < 2; ++turned) {
    for (std::size_t first = 0; first < polygon.size(); ++first) {
      expect_covers(polygon, plane, tolerance, what + " from " + std::to_string(first));
      std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
    }
    std::reverse(polygon.begin(), polygon.end());
  }
}

// One corner in every direction from the centre, at random distances: a simple polygon with up to n / 2 concave
// corners.
Points star(mc::Pcg& random, std::size_t n, double roughness) {
  Points p;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * mc::pi<double> * (double(i) + 0.8 * random.uniform<double>()) / double(n);
    const double r = 1 - roughness * random.uniform<double>();
    p.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return p;
}

// A strip of constant width that turns at random: spirals and zigzags, not entirely visible from any corner.
Points street(mc::Pcg& random, std::size_t half) {
  Points left, right;
  double x = 0, angle = 0;
  for (std::size_t i = 0; i < half; ++i) {
    x += 0.2 + random.uniform<double>();
    angle += random.uniform<double>() < 0.5 ? 0.7 : -0.7;
    const double y = 3 * std::sin(angle + double(i)), width = 0.01 + 0.5 * random.uniform<double>();
    left.emplace_back(x, y + width);
    right.emplace_back(x, y - width);
  }
  left.insert(left.end(), right.rbegin(), right.rend());
  return left;
}

// A random simple polygon: random points in random order. While two edges cross, the path between them is reversed.
Points untangled(mc::Pcg& random, std::size_t n) {
  Points p;
  for (std::size_t i = 0; i < n; ++i) p.emplace_back(random.uniform<double>(), random.uniform<double>());
  const auto left = [&](std::size_t a, std::size_t b, std::size_t c) {
    return shoelace({p[a % n], p[b % n], p[c % n]}) > 0;
  };
  for (bool crosses = true; crosses;) {
    crosses = false;
    for (std::size_t i = 0; i + 2 < n; ++i)
      for (std::size_t j = i + 2; j < n - (i == 0); ++j)
        if (left(i, i + 1, j) != left(i, i + 1, j + 1) && left(j, j + 1, i) != left(j, j + 1, i + 1)) {
          std::reverse(p.begin() + static_cast<std::ptrdiff_t>(i) + 1, p.begin() + static_cast<std::ptrdiff_t>(j) + 1);
          crosses = true;
        }
  }
  return p;
}

const std::vector<std::pair<const char*, Points>>& known_shapes() {
  static const std::vector<std::pair<const char*, Points>> shapes = {
      {"square", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}},
      {"dart", {{0, 0}, {4, 0}, {1, 1}, {0, 4}}},
      {"sharp dart", {{0, 0}, {1, 1e-3}, {2, 0}, {1, 1}}},
      {"L", {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}},
      {"U", {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}},
      {"comb", {{0, 0}, {5, 0}, {5, 2}, {4, 1}, {3, 2}, {2.5, 0.1}, {2, 2}, {1, 1}, {0, 2}}},
      {"corners in line", {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}}},
      {"a triangle of six corners", {{0, 0}, {1, 0}, {2, 0}, {1, 1}, {0, 2}, {0, 1}}},
      {"repeated corners", {{0, 0}, {0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 2}, {0, 2}}},
      {"a spike without an area", {{0, 0}, {2, 0}, {2, 1}, {3, 1}, {2, 1}, {2, 2}, {1, 0.5}, {0, 2}}},
      {"a window at the end of a slit",
       {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}},
      {"two windows",
       {{0, 0},
        {7, 0},
        {7, 4},
        {0, 4},
        {0, 0},
        {1, 1},
        {1, 3},
        {3, 3},
        {3, 2},
        {4, 2},
        {4, 3},
        {6, 3},
        {6, 1},
        {4, 1},
        {4, 2},
        {3, 2},
        {3, 1},
        {1, 1}}},
      {"touching itself", {{0, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 1}, {1, 1}, {0, 0.5}}},
  };
  return shapes;
}

TEST(Polygon, KnownShapesFromEveryCorner) {
  mc::Pcg random(1);
  for (const auto& [name, polygon] : known_shapes()) {
    expect_covers_from_everywhere(polygon, {}, 1e-12, name);
    for (int trial = 0; trial < 50; ++trial)
      expect_covers_from_everywhere(polygon, random_plane(random, std::pow(10, 24 * random.uniform<double>() - 12), 1),
                                    1e-9, name);
  }
}

TEST(Polygon, RandomShapesOfAllSizes) {
  mc::Pcg random(2);
  for (int trial = 0; trial < 3000; ++trial) {
    const auto n = 3 + static_cast<std::size_t>(30 * random.uniform<double>());
    const Plane plane = random_plane(random, std::pow(10, 24 * random.uniform<double>() - 12), trial % 3);
    const std::string name = " of trial " + std::to_string(trial);
    expect_covers(star(random, n, 0.95), plane, 1e-9, "star" + name);
    expect_covers(star(random, n, 0), plane, 1e-9, "convex" + name);
    expect_covers(untangled(random, n), plane, 1e-9, "untangled" + name);
    expect_covers(street(random, 2 + n / 2), plane, 1e-9, "street" + name);
  }
  expect_covers(star(random, 2000, 0.9), random_plane(random, 1, 1), 1e-9, "large star");
}

// Convex polygons become fans, so quadrilaterals are split as PLY readers usually split them.
TEST(Polygon, ConvexOnesAreFans) {
  mc::Pcg random(3);
  for (std::size_t n = 3; n < 12; ++n) {
    const Plane plane = random_plane(random, 1, 1);
    std::vector<Vec3d> corners;
    for (const auto& p : star(random, n, 0)) corners.push_back(plane.at(p));
    std::vector<std::array<std::uint32_t, 3>> fan;
    for (std::uint32_t i = 2; i < n; ++i) fan.push_back({0, i - 1, i});
    EXPECT_EQ(triangulate_polygon(corners), fan);
  }
}

TEST(Polygon, AppendsVertices) {
  const std::vector<Vec3d> positions = {{9, 9, 9}, {0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
  std::vector<std::array<std::uint32_t, 3>> triangles = {{1, 2, 3}};
  append_triangulated(positions, std::vector<std::uint32_t>{4, 3, 2}, triangles);
  append_triangulated(positions, std::vector<std::uint32_t>{2, 3, 4, 1}, triangles);
  const std::vector<std::array<std::uint32_t, 3>> expected = {{1, 2, 3}, {4, 3, 2}, {1, 2, 3}, {1, 3, 4}};
  ASSERT_EQ(triangles.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<std::uint32_t, 3> turned = triangles[i];
    for (int k = 0; k < 2 && turned != expected[i]; ++k) std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    EXPECT_EQ(turned, expected[i]) << i;
  }
}

// Polygons without area, self-intersecting, overflowing or not finite still give n - 2 triangles with valid indices.
TEST(Polygon, WhatIsNoneKeepsItsCount) {
  mc::Pcg random(4);
  for (int trial = 0; trial < 3000; ++trial) {
    const auto n = 3 + static_cast<std::size_t>(12 * random.uniform<double>());
    std::vector<Vec3d> corners;
    for (std::size_t i = 0; i < n; ++i) {
      Vec3d p;
      for (int k = 0; k < 3; ++k)
        p[k] = trial % 2 ? std::floor(3 * random.uniform<double>()) : random.uniform<double>();
      if (trial % 5 == 0) p[1] = p[2] = 0;
      if (trial % 7 == 0) p *= 1e308;
      if (trial % 11 == 0) p *= 1e-320;
      if (trial % 13 == 0 && i % 3 == 0) p[0] = trial % 2 ? HUGE_VAL : std::nan("");
      corners.push_back(p);
    }
    const auto triangles = triangulate_polygon(corners);
    ASSERT_EQ(triangles.size(), n - 2);
    for (const auto& t : triangles)
      for (const std::uint32_t i : t) ASSERT_LT(i, n);
  }
}

} // namespace
