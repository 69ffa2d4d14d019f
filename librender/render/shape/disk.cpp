#include <render/shape/disk.h>

#include <mc/core/error.h>
#include <mc/warp/disk.h>

namespace render {

Disk::Disk(const Transform& to_world, bool flipped)
    : center_(to_world.translation), x_(to_world.linear.col(0)), y_(to_world.linear.col(1)) {
  const Vec3d normal = mc::cross<double>(x_, y_);
  area_ = mc::pi<double> * normal.norm();
  mc::require(center_.cast<Float>().allFinite() && std::isfinite(area_),
              "disk: its centre ({}, {}, {}) and axes must be finite", center_.x(), center_.y(), center_.z());
  mc::require(area_ > 0, "disk: toWorld makes a line of the disk, or a point; nothing would be seen");
  // The vectors of the dual basis have the product 1 with their own axis and 0 with the other axis.
  const Vec3d n = normal.normalized(), dual_x = mc::cross<double>(y_, n) / normal.norm(),
              dual_y = mc::cross<double>(n, x_) / normal.norm();
  for (int a = 0; a < 3; ++a) {
    plane_.normal[a] = n[a];
    plane_.x[a] = dual_x[a];
    plane_.y[a] = dual_y[a];
  }
  normal_ = (to_world.mirrors() != flipped ? Vec3d(-n) : n).cast<Float>();
  error_ = Float(0x1p-49 * (center_.cwiseAbs() + x_.cwiseAbs() + y_.cwiseAbs()).maxCoeff());
}

// Computed in double and rounded once.
SurfacePoint Disk::point(const Vec3d& p) const {
  SurfacePoint s;
  s.p = p.cast<Float>();
  s.error = std::numeric_limits<Float>::epsilon() * s.p.lpNorm<Eigen::Infinity>() + error_;
  s.ng = s.ns = normal_;
  return s;
}

std::optional<double> Disk::intersect(const Ray& ray) const {
  const auto at = crossing(ray.o.cast<double>(), ray.d.cast<double>());
  if (!(at.t > 0 && at.t < double(ray.t_max) && at.radius2 <= 1)) return {};
  return at.t;
}

std::optional<SurfacePoint> Disk::sample_area(const Vec2& u) const {
  const mc::Vec2<double> p = mc::UniformDisk<double>{}.sample(u.cast<double>());
  return point(center_ + p[0] * x_ + p[1] * y_);
}

std::optional<ShapeSample> Disk::sample(const Vec3& ref, const Vec2& u) const {
  ShapeSample s;
  s.point = *sample_area(u);
  const Vec3 between = s.point.p - ref;
  const Float distance2 = between.squaredNorm();
  if (!(distance2 > 0)) return {};
  s.wi = between / std::sqrt(distance2);
  s.pdf = area_pdf(std::abs(normal_.dot(s.wi)), distance2);
  if (!(s.pdf > 0) || !std::isfinite(s.pdf)) return {};
  return s;
}

std::optional<DirectionSample> Disk::sample_direction(const Vec3& ref, const Vec2& u) const {
  return sample_direction_by_point(*this, ref, u);
}

Float Disk::pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const {
  return area_pdf(std::abs(normal_.dot(wi)), (hit.p - ref).squaredNorm());
}

Float Disk::pdf(const Vec3& ref, const Vec3& wi) const {
  const Vec3d d = wi.cast<double>();
  const auto at = crossing(ref.cast<double>(), d);
  if (!(at.t > 0 && at.radius2 <= 1)) return 0;
  return area_pdf(std::abs(normal_.dot(wi)), Float(at.t * at.t * d.squaredNorm()));
}

Eigen::AlignedBox3d Disk::box() const {
  const Vec3d half = (x_.array().square() + y_.array().square()).sqrt().matrix();
  return {center_ - half, center_ + half};
}

// The radius is the larger half axis of the ellipse: the root of the larger eigenvalue of the Gram matrix of x and y.
Ball Disk::bounding_ball() const {
  const double xx = x_.squaredNorm(), yy = y_.squaredNorm();
  return {center_, std::sqrt((xx + yy) / 2 + std::hypot((xx - yy) / 2, x_.dot(y_)))};
}

double Disk::projected_solid_angle_bound(const Vec3& ref) const {
  return std::min(mc::pi<double>, area_ / box().squaredExteriorDistance(ref.cast<double>()));
}

SurfacePoint Disk::surface_point(const Ray& ray, const Hit& hit) const {
  return point(ray.o.cast<double>() + hit.t * ray.d.cast<double>());
}

mc::Vec2<double> Disk::uv(const SurfacePoint& point) const {
  const Vec3d p = point.p.cast<double>() - center_;
  const double x = plane_.x[0] * p.x() + plane_.x[1] * p.y() + plane_.x[2] * p.z();
  const double y = plane_.y[0] * p.x() + plane_.y[1] * p.y() + plane_.y[2] * p.z();
  const double turn = std::atan2(y, x) / (2 * mc::pi<double>);
  return {std::min(std::hypot(x, y), 1.0), turn < 0 ? turn + 1 : turn};
}

// du dv = dr dphi / (2 pi), and the area is proportional to r dr dphi.
double Disk::uv_scale(const Hit&, const SurfacePoint& point) const {
  constexpr double least = 1e-3; // of the radius
  return 1 / std::sqrt(2 * area_ * std::max(uv(point)[0], least));
}

} // namespace render
