#include "scenes.h"

#include <render/scene/builder.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace render::truth {

namespace {

double uniform(mc::Pcg& random, double lo, double hi) { return lo + (hi - lo) * random.uniform<double>(); }
double log_uniform(mc::Pcg& random, double lo, double hi) {
  return std::exp(uniform(random, std::log(lo), std::log(hi)));
}
std::size_t below(mc::Pcg& random, std::size_t n) {
  return std::min(n - 1, static_cast<std::size_t>(random.uniform<double>() * double(n)));
}
Vec3d direction(mc::Pcg& random) {
  const double z = uniform(random, -1, 1), phi = uniform(random, 0, 2 * mc::pi<double>), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}
Vec3d in_cube(mc::Pcg& random, double half) {
  return {uniform(random, -half, half), uniform(random, -half, half), uniform(random, -half, half)};
}
Transform turn(mc::Pcg& random) { return Transform::rotate(direction(random), uniform(random, 0, 360)); }
Spectrum gray(double v) { return Spectrum::Constant(Float(v)); }

/// A sphere, square or cube of half size 1, transformed by a similarity.
struct Thing {
  enum class Form { sphere, square, cube } form;
  Transform place;
  Bsdf bsdf;
  double radiance = 0;
  bool inward = false; ///< Whether the normals of a sphere point inward.
};

double size_of(const Transform& similarity) { return std::cbrt(std::abs(similarity.linear.determinant())); }

// n x n cells of two triangles each, in the plane z = 0.
TriangleMesh grid(const Transform& place, std::uint32_t n) {
  std::vector<Vec3> points;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      points.push_back(place.point({2.0 * i / n - 1, 2.0 * j / n - 1, 0}).cast<Float>());
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  if (place.mirrors())
    for (auto& t : triangles) std::swap(t[1], t[2]);
  return {std::move(points), triangles};
}

Shape shape_of(const Thing& thing, const Transform& world, std::uint32_t cells) {
  const Transform place = world * thing.place;
  switch (thing.form) {
  case Thing::Form::sphere: return Sphere(place.translation, size_of(place), thing.inward);
  case Thing::Form::square: return cells > 1 ? grid(place, cells) : TriangleMesh::rectangle(place);
  case Thing::Form::cube: return TriangleMesh::box(place);
  }
  return TriangleMesh::box(place);
}

Picture picture(const std::vector<Thing>& things, double sky, const Vec3d& eye, const Vec3d& at, const Transform& world,
                std::uint32_t cells, std::string variant) {
  SceneBuilder builder;
  if (sky > 0) builder.add(Light(ConstantBackground(gray(sky))));
  for (const Thing& t : things) {
    const BsdfId bsdf = builder.add(t.bsdf);
    if (t.radiance > 0) builder.add(shape_of(t, world, cells), {bsdf, Emission{gray(t.radiance)}});
    else builder.add(shape_of(t, world, cells), {bsdf});
  }
  const Vec3d o = world.point(eye), d = world.point(at) - o;
  return {std::make_shared<const Scene>(builder.build()),
          {o.cast<Float>(), d.normalized().cast<Float>()},
          -1,
          std::move(variant)};
}

// Squares that face inward on all sides of the cube of half size 1; y is up.
std::vector<Transform> sides() {
  std::vector<Transform> found;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const Vec3d n = -sign * Vec3d::Unit(axis), x = Vec3d::Unit((axis + 1) % 3);
      found.push_back(Transform::columns(x, mc::cross<double>(n, x), n, -n));
    }
  return found;
}

// Projected solid angle of a polygon divided by pi, by Lambert's formula: (1/2 pi) sum of angle_i cos(normal, edge
// plane i). Clips the part below the horizon. Points are relative to the receiver.
double form_factor(const std::vector<Vec3d>& corners, const Vec3d& n) {
  std::vector<Vec3d> above;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3d &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double ha = a.dot(n), hb = b.dot(n);
    if (ha >= 0) above.push_back(a);
    if ((ha >= 0) != (hb >= 0)) above.push_back(a + ha / (ha - hb) * (b - a));
  }
  double sum = 0;
  for (std::size_t i = 0; i < above.size(); ++i) {
    const Vec3d &a = above[i], &b = above[(i + 1) % above.size()];
    const Vec3d across = mc::cross<double>(a, b);
    const double s = across.norm();
    if (s > 0) sum += std::atan2(s, a.dot(b)) * across.dot(n) / s;
  }
  return std::abs(sum) / (2 * mc::pi<double>);
}

struct Cone {
  Vec3d axis;
  double angle;
  bool meets(const Cone& other) const {
    return std::acos(std::clamp(axis.dot(other.axis), -1.0, 1.0)) < angle + other.angle;
  }
};

} // namespace

Family furnace(mc::Pcg& random) {
  std::vector<Thing> things;
  const auto lambert = [&] {
    const double albedo = uniform(random, 0, 0.9);
    return std::pair(Bsdf(Lambert(gray(albedo))), 1 - albedo);
  };
  const std::size_t around = below(random, 3);
  const auto [wall, shine] = lambert();
  if (around == 1) things.push_back({Thing::Form::sphere, Transform::scale({4, 4, 4}), wall, shine, true});
  if (around == 2)
    for (const Transform& side : sides())
      things.push_back({Thing::Form::square, Transform::scale({4, 4, 4}) * side, wall, shine, false});
  // Objects are apart from each other and from the eye. Radiance inside glass would be scaled by eta^2, and emission
  // behind a surface would be lost.
  const Vec3d eye = in_cube(random, 1.4);
  std::vector<std::pair<Vec3d, double>> taken = {{eye, 0}};
  for (std::size_t n = 1 + below(random, 5); n > 0; --n) {
    const double size = log_uniform(random, 1e-3, 0.5), reach = 1.8 * size;
    const Vec3d at = in_cube(random, 1.4);
    if (std::any_of(taken.begin(), taken.end(),
                    [&](const auto& t) { return (t.first - at).norm() < t.second + reach; }))
      continue;
    taken.emplace_back(at, reach);
    const auto form = std::array{Thing::Form::sphere, Thing::Form::cube}[below(random, 2)];
    const Transform place = Transform::translate(at) * turn(random) * Transform::scale({size, size, size});
    const auto [bsdf, radiance] = lambert();
    const std::size_t kind = below(random, 4);
    if (kind == 0) things.push_back({form, place, Bsdf(Dielectric(Float(uniform(random, 1.1, 2)))), 0, false});
    else if (kind == 1) things.push_back({form, place, Bsdf(FuzzyMetal(gray(1))), 0, false});
    else things.push_back({form, place, bsdf, radiance, false});
  }
  Family family{"furnace", {}, 1.0};
  const Vec3d at = taken.back().first + 0.1 * taken.back().second * direction(random);
  family.pictures.push_back(
      picture(things, around == 0 ? 1 : 0, eye, at, Transform(), 1, std::array{"sky", "sphere", "cube"}[around]));
  return family;
}

Family direct_light(mc::Pcg& random) {
  const double unit = log_uniform(random, 1e-3, 1e3), sky = below(random, 2) == 0 ? 0 : 1;
  std::vector<Thing> things = {
      {Thing::Form::square, Transform::rotate({1, 0, 0}, -90) * Transform::scale({1e2 * unit, 1e2 * unit, 1e2 * unit}),
       Bsdf(Lambert(gray(1))), 0, false}};
  const Vec3d up(0, 1, 0), eye = Vec3d(0, unit * 1e-3, 0);
  const std::size_t wanted = std::array<std::size_t, 4>{1, 2, 6, 40}[below(random, 4)];
  std::vector<Cone> taken = {{up, 1e-2}}; // position of the eye
  double truth = sky, rarest = 1;
  for (int tries = 0; tries < 2000 && taken.size() <= wanted; ++tries) {
    // Under a sky, lights are large, so that enough samples hit the dark space between them.
    const double distance = unit * log_uniform(random, 1e-1, 1e3),
                 angle = log_uniform(random, sky > 0 ? 0.1 : 1e-4, 0.3);
    Vec3d w = direction(random);
    w.y() = std::abs(w.y());
    const Cone cone{w, angle};
    if (w.y() < std::sin(angle) + 1e-3 ||
        std::any_of(taken.begin(), taken.end(), [&](const Cone& c) { return c.meets(cone); }))
      continue;
    taken.push_back(cone);
    // Either strong enough to matter, or nearly negligible.
    const double radiance = log_uniform(random, 1e-3, 1) / mc::sqr(std::sin(angle)), size = distance * std::sin(angle);
    double share = mc::sqr(std::sin(angle)) * w.y();
    if (below(random, 2) == 0) {
      things.push_back({Thing::Form::sphere, Transform::translate(distance * w) * Transform::scale({size, size, size}),
                        Bsdf(Lambert(gray(0))), radiance, false});
      truth += (radiance - sky) * share;
      rarest = std::min(rarest, share);
      continue;
    }
    const double half = size / std::sqrt(2.0);
    const Transform place = Transform::translate(distance * w) * turn(random) * Transform::scale({half, half, half});
    things.push_back({Thing::Form::square, place, Bsdf(Lambert(gray(0))), radiance, false});
    std::vector<Vec3d> corners;
    for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
      corners.push_back(place.point(Vec3d(x, y, 0)));
    const double lit = place.linear.col(2).dot(w) < 0 ? radiance : 0;
    share = form_factor(corners, up);
    truth += (lit - sky) * share;
    rarest = std::min(rarest, share);
  }
  Family family{"direct light", {}, truth, 1e-4, rarest};
  family.pictures.push_back(picture(things, sky, eye, Vec3d::Zero(), Transform(), 1, sky > 0 ? "sky" : "no sky"));
  family.pictures.back().max_depth = 2;
  return family;
}

Family room(mc::Pcg& random) {
  std::vector<Thing> things;
  for (const Transform& side : sides())
    things.push_back({Thing::Form::square, side, Bsdf(Lambert(gray(uniform(random, 0, 0.8)))), 0, false});
  for (std::size_t n = 1 + below(random, 3); n > 0; --n) {
    const double size = uniform(random, 0.1, 0.4);
    Vec3d at = in_cube(random, 0.5);
    at.y() = 0.98 - 0.02 * double(n); // at different heights, so no two are coplanar
    things.push_back(
        {Thing::Form::square,
         Transform::translate(at) * Transform::rotate({1, 0, 0}, 90) * Transform::scale({size, size, size}),
         Bsdf(Lambert(gray(0.5))), log_uniform(random, 0.1, 10), false});
  }
  for (std::size_t n = 1 + below(random, 4); n > 0; --n) {
    const double size = uniform(random, 0.1, 0.25);
    const auto form = std::array{Thing::Form::sphere, Thing::Form::cube}[below(random, 2)];
    const Float alpha = Float(uniform(random, 0.3, 0.8));
    const Bsdf all[] = {Lambert(gray(uniform(random, 0, 1))),
                        FuzzyMetal(gray(0.9), Float(uniform(random, 0.3, 0.9))),
                        FuzzyMetal(gray(0.8)),
                        RoughPlastic(Float(1.5), alpha, gray(0.5), gray(1)),
                        RoughDielectric(Float(1.5), alpha),
                        Dielectric(Float(1.5))};
    Vec3d at = in_cube(random, 0.7);
    at.y() = uniform(random, -0.7, 0.5);
    things.push_back({form, Transform::translate(at) * turn(random) * Transform::scale({size, size, size}),
                      all[below(random, std::size(all))], 0, false});
  }
  const Vec3d eye(0.9, uniform(random, -0.9, 0.9), 0.9), at = in_cube(random, 0.7);
  const double scale = log_uniform(random, 1e-3, 1e3);
  const Transform turned = turn(random), moved = Transform::translate(20 * direction(random)),
                  scaled = Transform::scale({scale, scale, scale}), mirrored = Transform::scale({-1, 1, 1});
  Family family{"room", {}, {}};
  const auto show = [&](const Transform& world, std::uint32_t cells, const char* variant) {
    family.pictures.push_back(picture(things, 0, eye, at, world, cells, variant));
  };
  show(Transform(), 1, "as it is");
  show(turned, 1, "turned");
  show(mirrored, 1, "mirrored");
  show(scaled, 1, "scaled");
  show(moved, 1, "moved");
  show(Transform(), 7, "subdivided");
  show(moved * turned * mirrored, 3, "all at once");
  return family;
}

Family any(mc::Pcg& random) {
  const std::size_t kind = below(random, 5);
  if (kind < 2) return furnace(random);
  return kind < 4 ? direct_light(random) : room(random);
}

} // namespace render::truth
