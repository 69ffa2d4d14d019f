#include <render/shape/triangle_mesh.h>

#include <mc/core/error.h>

#include <Eigen/LU>

#include <algorithm>

namespace render {

namespace {

Vec3d normal_of(const std::array<Vec3, 3>& v) {
  const Vec3d a = v[0].cast<double>();
  return mc::cross<double>(v[1].cast<double>() - a, v[2].cast<double>() - a);
}

/// Where the line o + t d meets the plane of a triangle: barycentric weights of vertices 1 and 2, |cos| of the angle between d
/// and the normal. NaN or infinite where it is parallel. Source: [MoellerTrumbore97]
struct Crossing { double t, b1, b2, cosine; };
Crossing cross_plane(const std::array<Vec3, 3>& v, const Vec3d& o, const Vec3d& d) {
  const Vec3d a = v[0].cast<double>(), e1 = v[1].cast<double>() - a, e2 = v[2].cast<double>() - a, n = mc::cross<double>(e1, e2);
  const double det = -n.dot(d);
  const Vec3d s = o - a, q = mc::cross<double>(s, d);
  return {n.dot(s) / det, e2.dot(q) / det, -e1.dot(q) / det, std::abs(det) / (n.norm() * d.norm())};
}

std::vector<Vec3> transformed(const std::vector<Vec3d>& points, const Transform& to_world) {
  std::vector<Vec3> result;
  for (const Vec3d& p : points) result.push_back((to_world.leftCols<3>() * p + to_world.col(3)).cast<Float>());
  return result;
}

} // namespace

TriangleMesh::TriangleMesh(std::vector<Vec3> positions, std::vector<std::array<std::uint32_t, 3>> triangles,
                           std::vector<Vec3> normals, std::vector<Vec2> uvs)
    : positions_(std::move(positions)), triangles_(std::move(triangles)), normals_(std::move(normals)), uvs_(std::move(uvs)) {
  mc::require(!triangles_.empty(), "mesh: no triangle; at least one is needed");
  for (std::size_t i = 0; i < positions_.size(); ++i)
    mc::require(positions_[i].allFinite(), "mesh: vertex {} = ({}, {}, {}) is not finite", i, positions_[i].x(), positions_[i].y(),
                positions_[i].z());
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    for (const std::uint32_t v : triangles_[i])
      mc::require(v < positions_.size(), "mesh: triangle {} names vertex {}, but there are only {}", i, v, positions_.size());
  mc::require(normals_.empty() || normals_.size() == positions_.size(), "mesh: {} normals for {} vertices; give one each or none",
              normals_.size(), positions_.size());
  mc::require(uvs_.empty() || uvs_.size() == positions_.size(), "mesh: {} texture coordinates for {} vertices; give one each or none",
              uvs_.size(), positions_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Vec3d n = normal_of(vertices(i));
    cumulative_area_.push_back(area_ += n.norm() / 2);
    reciprocal_area_.push_back(2 / n.norm());
    face_normals_.push_back(n.stableNormalized().cast<Float>());
    const auto v = vertices(i);
    const Vec3 center = (v[0] + v[1] + v[2]) / 3;
    around_.push_back({center, std::max({(v[0] - center).squaredNorm(), (v[1] - center).squaredNorm(), (v[2] - center).squaredNorm()})});
  }
  // Points are interpolated in double and rounded once: half an ulp of the largest coordinate, doubled for safety.
  for (const Vec3& p : positions_) error_ = std::max(error_, std::numeric_limits<Float>::epsilon() * p.lpNorm<Eigen::Infinity>());
}

TriangleMesh TriangleMesh::rectangle(const Transform& to_world) {
  const std::vector<Vec3d> corners = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  return {transformed(corners, to_world), {{0, 1, 2}, {0, 2, 3}}, {}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

TriangleMesh TriangleMesh::box(const Transform& to_world) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // Faces as quads, counter-clockwise seen from outside.
  for (const std::array<std::uint32_t, 4>& q :
       {std::array<std::uint32_t, 4>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  // A mirroring transform turns the winding inside out; turn it back.
  if (to_world.leftCols<3>().determinant() < 0)
    for (auto& t : triangles) std::swap(t[1], t[2]);
  return {transformed(corners, to_world), std::move(triangles)};
}

SurfacePoint TriangleMesh::point(std::size_t triangle, double b1, double b2) const {
  const auto v = vertices(triangle);
  const double b0 = 1 - b1 - b2;
  const auto& index = triangles_[triangle];
  SurfacePoint s;
  s.p = (b0 * v[0].cast<double>() + b1 * v[1].cast<double>() + b2 * v[2].cast<double>()).cast<Float>();
  s.error = error_;
  s.ng = face_normals_[triangle];
  s.ns = s.ng;
  if (!normals_.empty()) {
    const Vec3 n = Float(b0) * normals_[index[0]] + Float(b1) * normals_[index[1]] + Float(b2) * normals_[index[2]];
    if (n.squaredNorm() > 0) s.ns = n.normalized();
    if (s.ns.dot(s.ng) < 0) s.ns = -s.ns;
  }
  if (!uvs_.empty()) s.uv = Float(b0) * uvs_[index[0]] + Float(b1) * uvs_[index[1]] + Float(b2) * uvs_[index[2]];
  s.prim = static_cast<int>(triangle);
  return s;
}

SurfacePoint TriangleMesh::surface_point(const Ray&, const Hit& hit) const {
  SurfacePoint s = point(static_cast<std::size_t>(hit.prim), double(hit.b1), double(hit.b2));
  s.shape = hit.shape;
  return s;
}

std::optional<ShapeSample> TriangleMesh::sample(const Vec3& ref, const Vec2& u) const {
  const double target = double(u[0]) * area_;
  std::size_t triangle = 0;
  if (size() <= 8) { // without branches that no predictor could guess
    for (const double a : cumulative_area_) triangle += static_cast<std::size_t>(target >= a);
  } else {
    triangle = static_cast<std::size_t>(std::upper_bound(cumulative_area_.begin(), cumulative_area_.end(), target) - cumulative_area_.begin());
  }
  if (triangle == size()) return {};
  const double below = triangle > 0 ? cumulative_area_[triangle - 1] : 0;
  const double u0 = std::min((target - below) * reciprocal_area_[triangle], 1 - 0x1p-53);
  ShapeSample s;
  if (const auto directions = near_triangle(ref, triangle)) {
    const Vec3d d = directions->sample({u0, double(u[1])});
    const Crossing at = cross_plane(vertices(triangle), ref.cast<double>(), d);
    const double b1 = std::clamp(at.b1, 0.0, 1.0);
    s.point = point(triangle, b1, std::clamp(at.b2, 0.0, 1 - b1));
    s.wi = d.cast<Float>();
    s.pdf = near_pdf(triangle, *directions);
    return s;
  }
  // Uniform barycentrics: sqrt makes strips of equal area parallel to the edge opposite vertex 0.
  const double root = std::sqrt(u0), b1 = root * (1 - double(u[1])), b2 = root * double(u[1]);
  s.point = point(triangle, b1, b2);
  const Vec3 between = s.point.p - ref;
  const Float distance2 = between.squaredNorm();
  if (!(distance2 > 0)) return {};
  s.wi = between * (1 / std::sqrt(distance2));
  s.pdf = area_pdf(std::abs(s.point.ng.dot(s.wi)), distance2);
  if (!(s.pdf > 0) || !std::isfinite(s.pdf)) return {};
  return s;
}

Float TriangleMesh::area_pdf(Float cosine, Float distance2) const { return cosine > 0 ? distance2 / (cosine * Float(area_)) : Float(0); }

std::optional<mc::SphericalTriangle<double>> TriangleMesh::near_triangle(const Vec3& ref, std::size_t triangle) const {
  const auto& [center, radius2] = around_[triangle];
  const Vec3 off = ref - center;
  if (!(off.squaredNorm() < Float(1.2) * radius2 && mc::sqr(off.dot(face_normals_[triangle])) < radius2 / 16)) return {};
  const auto v = vertices(triangle);
  const Vec3d p = v[0].cast<double>(), a = p - ref.cast<double>(), ab = v[1].cast<double>() - p, ac = v[2].cast<double>() - p;
  const double height = std::abs(a.dot(mc::cross<double>(ab, ac))) * reciprocal_area_[triangle] / 2;
  if (!(height * height > 1e-16 * double(radius2))) return {};
  return mc::SphericalTriangle<double>(a, ab, ac);
}

Float TriangleMesh::near_pdf(std::size_t triangle, const mc::SphericalTriangle<double>& directions) const {
  return Float(1 / (reciprocal_area_[triangle] * area_ * directions.solid_angle()));
}

Float TriangleMesh::pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const {
  const auto triangle = static_cast<std::size_t>(hit.prim);
  if (const auto directions = near_triangle(ref, triangle)) return near_pdf(triangle, *directions);
  return area_pdf(std::abs(hit.ng.dot(wi)), (hit.p - ref).squaredNorm());
}

Float TriangleMesh::pdf(const Vec3& ref, const Vec3& wi) const {
  const Vec3d o = ref.cast<double>(), d = wi.cast<double>();
  Float sum = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Crossing at = cross_plane(vertices(i), o, d);
    if (!(at.t > 0 && at.b1 >= 0 && at.b2 >= 0 && at.b1 + at.b2 <= 1)) continue;
    const auto directions = near_triangle(ref, i);
    sum += directions ? near_pdf(i, *directions) : area_pdf(Float(at.cosine), Float(at.t * at.t * d.squaredNorm()));
  }
  return sum;
}

} // namespace render
