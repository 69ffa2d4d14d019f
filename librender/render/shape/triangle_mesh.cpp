#include <render/shape/triangle_mesh.h>

#include <mc/core/error.h>
#include <mc/warp/triangle.h>

#include <algorithm>

namespace render {

namespace {

// A vector along the normal; its length is twice the area of the triangle.
Vec3d area_normal(const std::array<Vec3, 3>& v) {
  const Vec3d a = v[0].cast<double>();
  return mc::cross<double>(v[1].cast<double>() - a, v[2].cast<double>() - a);
}
double area_of(const std::array<Vec3, 3>& v) { return area_normal(v).norm() / 2; }
Vec3 center_of(const std::array<Vec3, 3>& v) { return (v[0] + v[1] + v[2]) * Float(1.0 / 3); }
// Squared radius of the ball about the centre that contains the triangle.
Float radius2_of(const std::array<Vec3, 3>& v, const Vec3& center) {
  return std::max({(v[0] - center).squaredNorm(), (v[1] - center).squaredNorm(), (v[2] - center).squaredNorm()});
}

/// Crossing of the line o + t d with the plane of a triangle: t, the barycentric weights of vertices 1 and 2, and |cos|
/// of the angle between d and the normal. NaN or infinite for a parallel line. Source: [MoellerTrumbore97].
struct Crossing {
  double t, b1, b2, cosine;
};
Crossing cross_plane(const std::array<Vec3, 3>& v, const Vec3d& o, const Vec3d& d) {
  const Vec3d a = v[0].cast<double>(), e1 = v[1].cast<double>() - a, e2 = v[2].cast<double>() - a,
              n = mc::cross<double>(e1, e2);
  const double det = -n.dot(d);
  const Vec3d s = o - a, q = mc::cross<double>(s, d);
  return {n.dot(s) / det, e2.dot(q) / det, -e1.dot(q) / det, std::abs(det) / (n.norm() * d.norm())};
}

std::vector<Vec3> transformed(const std::vector<Vec3d>& points, const Transform& to_world) {
  std::vector<Vec3> result(points.size());
  std::transform(points.begin(), points.end(), result.begin(),
                 [&](const Vec3d& p) { return Vec3(to_world.point(p).cast<Float>()); });
  return result;
}

// Triangles with the transformed geometric normal. A mirroring transform reverses the winding, so it is swapped back.
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
Triangles wound(Triangles triangles, const Transform& to_world) {
  if (to_world.mirrors())
    for (auto& t : triangles) std::swap(t[1], t[2]);
  return triangles;
}

} // namespace

TriangleMesh::TriangleMesh(std::vector<Vec3> positions, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                           std::vector<Vec3> normals, std::vector<mc::Vec2<float>> uvs)
    : positions_(std::move(positions)), normals_(std::move(normals)), uvs_(std::move(uvs)) {
  mc::require(!triangles.empty(), "mesh: no triangle; at least one is needed");
  for (std::size_t i = 0; i < positions_.size(); ++i)
    mc::require(positions_[i].allFinite(), "mesh: vertex {} = ({}, {}, {}) is not finite", i, positions_[i].x(),
                positions_[i].y(), positions_[i].z());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const std::uint32_t v : triangles[i])
      mc::require(v < positions_.size(), "mesh: triangle {} names vertex {}, but there are only {}", i, v,
                  positions_.size());
  mc::require(uvs_.empty() || uvs_.size() == positions_.size(),
              "mesh: {} texture coordinates for {} vertices; give one each or none", uvs_.size(), positions_.size());
  for (std::size_t i = 0; i < uvs_.size(); ++i)
    mc::require(uvs_[i].allFinite(), "mesh: texture coordinate {} = ({}, {}) is not finite", i, uvs_[i].x(),
                uvs_[i].y());
  mc::require(normals_.empty() || normals_.size() == positions_.size(),
              "mesh: {} normals for {} vertices; give one each or none", normals_.size(), positions_.size());
  std::vector<double> areas;
  faces_.reserve(triangles.size());
  for (const auto& [i, j, k] : triangles) {
    const std::array<Vec3, 3> v = {positions_[i], positions_[j], positions_[k]};
    const Vec3d n = area_normal(v);
    faces_.push_back({{i, j, k}, n.stableNormalized().cast<Float>()});
    areas.push_back(n.norm() / 2);
    area_ += areas.back();
    largest_radius2_ = std::max(largest_radius2_, radius2_of(v, center_of(v)));
    for (const Vec3& p : v) bounds_.add(p);
  }
  if (area_ > 0) triangle_distribution_.emplace(areas);
  constexpr Float straight = Float(2e-6); // rounding of files with six digits
  const auto is_flat = [&](const Face& f) {
    for (const std::uint32_t v : f.vertices)
      if (!((normals_[v].normalized() - f.normal).norm() < straight)) return false;
    return true;
  };
  if (!normals_.empty() && std::all_of(faces_.begin(), faces_.end(), is_flat))
    normals_ = decltype(normals_)(); // frees their memory, which assigning {} would keep
  for (const Vec3& p : positions_) error_ = std::max(error_, Float(0x1p-49) * p.lpNorm<Eigen::Infinity>());
}

TriangleMesh TriangleMesh::rectangle(const Transform& to_world) {
  const std::vector<Vec3d> corners = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  return {
      transformed(corners, to_world), wound({{0, 1, 2}, {0, 2, 3}}, to_world), {}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

TriangleMesh TriangleMesh::box(const Transform& to_world) {
  std::vector<Vec3d> corners;
  Triangles triangles;
  std::vector<mc::Vec2<float>> uvs;
  // Faces as quads, counter-clockwise from outside. A quad starts at the corner with u = 0 and v = 1 in the cube of
  // Mitsuba. Bit k of a corner is the sign of coordinate k.
  for (const std::array<int, 4>& q :
       {std::array{4, 6, 2, 0}, {1, 3, 7, 5}, {1, 5, 4, 0}, {3, 2, 6, 7}, {3, 1, 0, 2}, {5, 7, 6, 4}}) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    for (const int i : q) corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    uvs.insert(uvs.end(), {{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
  return {transformed(corners, to_world), wound(std::move(triangles), to_world), {}, std::move(uvs)};
}

// Computed in double and rounded once: half an ulp of the point, doubled for safety.
SurfacePoint TriangleMesh::at(const Vec3d& p, std::size_t triangle, Float b1, Float b2) const {
  const Face& face = faces_[triangle];
  SurfacePoint s;
  s.p = p.cast<Float>();
  s.error = std::numeric_limits<Float>::epsilon() * s.p.lpNorm<Eigen::Infinity>() + error_;
  s.ng = s.ns = face.normal;
  if (!normals_.empty()) {
    const auto& [i, j, k] = face.vertices;
    const Vec3 n = (1 - b1 - b2) * normals_[i] + b1 * normals_[j] + b2 * normals_[k];
    if (n.squaredNorm() > 0) s.ns = n.normalized();
    if (s.ns.dot(s.ng) < 0) s.ns = -s.ns;
  }
  s.prim = static_cast<int>(triangle);
  return s;
}

SurfacePoint TriangleMesh::point(std::size_t triangle, double b1, double b2) const {
  const auto v = vertices(triangle);
  return at((1 - b1 - b2) * v[0].cast<double>() + b1 * v[1].cast<double>() + b2 * v[2].cast<double>(), triangle,
            Float(b1), Float(b2));
}

mc::Vec2<double> TriangleMesh::uv(const Hit& hit, const SurfacePoint&) const {
  const auto& [i, j, k] = faces_[static_cast<std::size_t>(hit.prim)].vertices;
  const double b1 = double(hit.b1), b2 = double(hit.b2);
  return (1 - b1 - b2) * uvs_[i].cast<double>() + b1 * uvs_[j].cast<double>() + b2 * uvs_[k].cast<double>();
}

mc::Vec2<double> TriangleMesh::uv(const SurfacePoint& point) const {
  const auto corners = vertices(static_cast<std::size_t>(point.prim));
  const Vec3d a = corners[0].cast<double>(), e = corners[1].cast<double>() - a, f = corners[2].cast<double>() - a,
              d = point.p.cast<double>() - a, n = mc::cross<double>(e, f);
  const double b1 = mc::cross<double>(d, f).dot(n) / n.squaredNorm(),
               b2 = mc::cross<double>(e, d).dot(n) / n.squaredNorm();
  return uv({0, 0, point.prim, Float(b1), Float(b2)}, point);
}

double TriangleMesh::uv_scale(const Hit& hit, const SurfacePoint&) const {
  const auto triangle = static_cast<std::size_t>(hit.prim);
  const auto& [i, j, k] = faces_[triangle].vertices;
  const auto [a, b, c] = vertices(triangle);
  const double area = mc::cross<Float>(b - a, c - a).template cast<double>().norm();
  const mc::Vec2<double> p = (uvs_[j] - uvs_[i]).cast<double>(), q = (uvs_[k] - uvs_[i]).cast<double>();
  return std::sqrt(std::abs(p[0] * q[1] - p[1] * q[0]) / area);
}

// The point comes from t, not from the float weights of the hit, which would move it along a large triangle. Rounding
// could move a point near an edge behind the adjacent triangle. A step of a few errors towards the centre keeps it in
// front of both.
SurfacePoint TriangleMesh::surface_point(const Ray& ray, const Hit& hit) const {
  const auto triangle = static_cast<std::size_t>(hit.prim);
  const Vec3d p = ray.o.cast<double>() + hit.t * ray.d.cast<double>(),
              inward = center_of(vertices(triangle)).cast<double>() - p;
  const double error = double(std::numeric_limits<Float>::epsilon()) * p.lpNorm<Eigen::Infinity>() + double(error_);
  const double step = std::min(0.5, 4 * error / inward.lpNorm<Eigen::Infinity>());
  return at(p + step * inward, triangle, hit.b1, hit.b2);
}

Float TriangleMesh::area_pdf(Float cosine, Float distance2) const {
  return cosine > 0 ? distance2 / (cosine * Float(area_)) : Float(0);
}

std::optional<ShapeSample> TriangleMesh::sample(const Vec3& ref, const Vec2& u) const {
  if (!triangle_distribution_) return {};
  const auto [triangle, pmf, u0] = triangle_distribution_->sample_index(double(u[0]));
  const mc::Vec2<double> inner(u0, double(u[1]));
  if (const auto directions = near_triangle(ref, triangle)) [[unlikely]]
    return sample_near(ref, triangle, *directions, inner);
  ShapeSample s;
  const mc::Vec2<double> b = mc::UniformTriangle<double>{}.sample(inner);
  s.point = point(triangle, b[0], b[1]);
  const Vec3 between = s.point.p - ref;
  const Float distance2 = between.squaredNorm();
  if (!(distance2 > 0)) return {};
  s.wi = between * (1 / std::sqrt(distance2));
  s.pdf = area_pdf(std::abs(s.point.ng.dot(s.wi)), distance2);
  if (!(s.pdf > 0) || !std::isfinite(s.pdf)) return {};
  return s;
}

std::optional<SurfacePoint> TriangleMesh::sample_area(const Vec2& u) const {
  if (!triangle_distribution_) return {};
  const auto [triangle, pmf, u0] = triangle_distribution_->sample_index(double(u[0]));
  const mc::Vec2<double> b = mc::UniformTriangle<double>{}.sample({u0, double(u[1])});
  return point(triangle, b[0], b[1]);
}

std::optional<DirectionSample> TriangleMesh::sample_direction(const Vec3& ref, const Vec2& u) const {
  return sample_direction_by_point(*this, ref, u);
}

ShapeSample TriangleMesh::sample_near(const Vec3& ref, std::size_t triangle,
                                      const mc::SphericalTriangle<double>& directions,
                                      const mc::Vec2<double>& u) const {
  const Vec3d d = directions.sample(u);
  const Crossing at = cross_plane(vertices(triangle), ref.cast<double>(), d);
  const double b1 = std::clamp(at.b1, 0.0, 1.0);
  return {point(triangle, b1, std::clamp(at.b2, 0.0, 1 - b1)), d.cast<Float>(), near_pdf(triangle, directions)};
}

Ball TriangleMesh::bounding_ball() const {
  const Vec3d center = box().center();
  double radius2 = 0;
  for (const Face& face : faces_)
    for (const std::uint32_t v : face.vertices)
      radius2 = std::max(radius2, (positions_[v].cast<double>() - center).squaredNorm());
  return {center, std::sqrt(radius2)};
}

double TriangleMesh::projected_solid_angle_bound(const Vec3& ref) const {
  const Vec3d away = (bounds_.lo - ref).cwiseMax(ref - bounds_.hi).cwiseMax(Float(0)).cast<double>();
  return std::min(mc::pi<double>, area_ / away.squaredNorm());
}

std::optional<mc::SphericalTriangle<double>> TriangleMesh::near_triangle(const Vec3& ref, std::size_t triangle) const {
  const auto v = vertices(triangle);
  const Vec3 center = center_of(v), off = ref - center;
  const auto near = [&](Float radius2) { return off.squaredNorm() < Float(1.2) * radius2; };
  if (!near(largest_radius2_)) return {}; // usually decides, and costs less than the radius of this triangle
  const Float radius2 = radius2_of(v, center);
  if (!(near(radius2) && mc::sqr(off.dot(faces_[triangle].normal)) < radius2 / 16)) return {};
  const Vec3d p = v[0].cast<double>(), a = p - ref.cast<double>(), ab = v[1].cast<double>() - p,
              ac = v[2].cast<double>() - p;
  const double height = std::abs(a.dot(mc::cross<double>(ab, ac))) / (2 * area_of(v));
  if (!(height * height > 1e-16 * double(radius2))) return {};
  return mc::SphericalTriangle<double>(a, ab, ac);
}

Float TriangleMesh::near_pdf(std::size_t triangle, const mc::SphericalTriangle<double>& directions) const {
  return Float(area_of(vertices(triangle)) / (area_ * directions.solid_angle()));
}

Float TriangleMesh::pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const {
  const auto triangle = static_cast<std::size_t>(hit.prim);
  if (const auto directions = near_triangle(ref, triangle)) return near_pdf(triangle, *directions);
  return area_pdf(std::abs(hit.ng.dot(wi)), (hit.p - ref).squaredNorm());
}

Float TriangleMesh::pdf(const Vec3& ref, const Vec3& wi) const {
  const Vec3d o = ref.cast<double>(), d = wi.cast<double>();
  Float sum = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const Crossing at = cross_plane(vertices(i), o, d);
    if (!(at.t > 0 && at.b1 >= 0 && at.b2 >= 0 && at.b1 + at.b2 <= 1)) continue;
    const auto directions = near_triangle(ref, i);
    sum += directions ? near_pdf(i, *directions) : area_pdf(Float(at.cosine), Float(at.t * at.t * d.squaredNorm()));
  }
  return sum;
}

} // namespace render
