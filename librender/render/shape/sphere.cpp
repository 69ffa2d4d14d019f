#include <render/shape/sphere.h>
#include <render/shape/sphere_crossings.h>

#include <mc/core/error.h>
#include <mc/core/frame.h>

#include <cmath>

namespace render {

Sphere::Sphere(const Vec3d& center, double radius, bool inside_out)
    : center_(center), radius_(radius), height_(2 * radius), inside_out_(inside_out),
      extent_(radius + center.lpNorm<Eigen::Infinity>()),
      outside2_(mc::sqr(radius + 4 * double(std::numeric_limits<Float>::epsilon()) * extent_)) {
  mc::require(center.cast<Float>().allFinite(), "sphere: centre ({}, {}, {}) is not finite, or beyond what {} holds",
              center.x(), center.y(), center.z(), sizeof(Float) == sizeof(float) ? "a float" : "a double");
  mc::require(std::isfinite(radius) && radius > 0, "sphere: radius {} must be finite and > 0", radius);
  mc::require(radius <= max_radius, "sphere: radius {} must be at most {}", radius, max_radius);
}

Sphere Sphere::cap(const Vec3d& center, double radius, const Vec3d& axis, double height, bool inside_out) {
  Sphere s(center, radius, inside_out);
  mc::require(axis.allFinite() && axis.norm() > 0, "sphere: cap axis ({}, {}, {}) must be finite and not 0", axis.x(),
              axis.y(), axis.z());
  mc::require(height > 0 && height <= 2 * radius, "sphere: cap height {} must lie in (0, 2 radius]", height);
  s.axis_ = axis.normalized();
  s.height_ = height;
  return s;
}

Sphere Sphere::with_uv_axes(const Eigen::Matrix3d& axes, double min_u) const {
  mc::require((axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 1e-6,
              "sphere: the axes of its texture must be orthonormal");
  Sphere s = *this;
  s.uv_axes_ = axes;
  s.min_u_ = min_u;
  return s;
}

mc::Vec2<double> Sphere::uv(const SurfacePoint& point) const {
  const Vec3d d = uv_axes_.transpose() * (point.p.cast<double>() - center_);
  const double turn = std::atan2(d.y(), d.x()) / (2 * mc::pi<double>);
  // The angle from the pole by its tangent: acos would lose half of the digits there.
  return {turn - std::floor(turn - min_u_), std::atan2(std::hypot(d.x(), d.y()), d.z()) / mc::pi<double>};
}

// du dv = dtheta dphi / (2 pi^2), and the area is r^2 sin theta dtheta dphi.
double Sphere::uv_scale(const Hit&, const SurfacePoint& point) const {
  constexpr double least = 1e-3;
  const Vec3d d = uv_axes_.transpose() * (point.p.cast<double>() - center_);
  const double sine = std::max(std::hypot(d.x(), d.y()) / radius_, least);
  return 1 / (mc::pi<double> * radius_ * std::sqrt(2 * sine));
}

bool Sphere::contains(const Vec3d& offset) const { return !is_cap() || offset.dot(axis_) >= radius_ - height_; }

std::optional<double> Sphere::intersect(const Ray& ray) const {
  const Line line(ray.o.cast<double>(), ray.d.cast<double>());
  const Vec3d o = line.o - center_;
  const auto pass = sphere_quadratic(o.x(), o.y(), o.z(), line, radius_ * radius_);
  if (!pass.crosses()) return {};
  const auto at = sphere_crossings(pass, line);
  for (const double t : {at.t0, at.t1})
    if (t > 0 && t < double(ray.t_max) && contains(o + t * line.d)) return t;
  return {};
}

SurfacePoint Sphere::point(const Vec3d& direction) const {
  SurfacePoint s;
  const Vec3d p = center_ + radius_ * direction;
  s.p = p.cast<Float>();
  // Rounded once from double. Double itself resolves the sphere to 2^-52 of its extent.
  s.error = std::numeric_limits<Float>::epsilon() * s.p.lpNorm<Eigen::Infinity>() + Float(0x1p-50 * extent_);
  s.ng = (inside_out_ ? Vec3d(-direction) : direction).cast<Float>();
  s.ns = s.ng;
  return s;
}

SurfacePoint Sphere::surface_point(const Ray& ray, const Hit& hit) const {
  // Projects onto the sphere: t may be off by more than the error of a surface point. This error matters across the
  // surface, not along it.
  return point((ray.o.cast<double>() + hit.t * ray.d.cast<double>() - center_).normalized());
}

double Sphere::projected_solid_angle_bound(const Vec3& ref) const {
  return mc::pi<double> * std::min(1.0, mc::sqr(radius_) / (center_ - ref.cast<double>()).squaredNorm());
}

double Sphere::area() const { return 2 * mc::pi<double> * radius_ * height_; }

bool Sphere::samples_cone(double d2) const {
  // Points on the sphere round to either side of it. Their cone, if they counted as outside, would contain only
  // themselves. The density in a narrower cone than the limit below overflows a float.
  return !is_cap() && d2 > outside2_ && radius_ * radius_ > 1e-36 * d2;
}

Float Sphere::cone_pdf(double d2) const {
  return Float(mc::UniformCone<double>::pdf_from_sin2(radius_ * radius_ / d2));
}

std::optional<ShapeSample> Sphere::sample(const Vec3& ref, const Vec2& u) const {
  const Vec3d toward = center_ - ref.cast<double>();
  const mc::Vec2<double> v = u.cast<double>();
  ShapeSample s;
  const double d2 = toward.squaredNorm();
  if (samples_cone(d2)) {
    // A direction in the cone, and the near intersection along it. mc::SphereLight is slower because of its care at
    // grazing distances. Where samples_cone() begins, the relative error of this density is at most 2e-13 (5e-9 if
    // Float is double).
    const double d = std::sqrt(d2);
    const Vec3d local = mc::UniformCone<double>::from_sin2(radius_ * radius_ / d2).sample(v),
                wi = mc::Frame<double>::from_z(toward / d).to_world(local);
    const double t = d * local.z() - mc::safe_sqrt<double>(radius_ * radius_ - d2 * local.head<2>().squaredNorm());
    s.point = point((t * wi - toward).normalized());
    s.wi = wi.cast<Float>();
    s.pdf = cone_pdf(d2);
  } else {
    s.point = *sample_area(u);
    const Vec3 between = s.point.p - ref;
    if (!(between.squaredNorm() > 0)) return {};
    s.wi = between.normalized();
    s.pdf = pdf(ref, s.wi, s.point);
  }
  if (!(s.pdf > 0) || !std::isfinite(s.pdf)) return {};
  return s;
}

std::optional<SurfacePoint> Sphere::sample_area(const Vec2& u) const {
  const auto cap = mc::UniformCone<double>::from_one_minus_cos(height_ / radius_);
  return point(mc::Frame<double>::from_z(axis_).to_world(cap.sample(u.cast<double>())).normalized());
}

std::optional<DirectionSample> Sphere::sample_direction(const Vec3& ref, const Vec2& u) const {
  const Vec3d toward = center_ - ref.cast<double>();
  const double d2 = toward.squaredNorm();
  if (samples_cone(d2)) {
    const auto frame = mc::Frame<double>::from_z(toward / std::sqrt(d2));
    const auto cone = mc::UniformCone<double>::from_sin2(radius_ * radius_ / d2);
    return DirectionSample{frame.to_world(cone.sample(u.cast<double>())).cast<Float>(), cone_pdf(d2)};
  }
  return sample_direction_by_point(*this, ref, u);
}

Float Sphere::pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const {
  if (const double d2 = (center_ - ref.cast<double>()).squaredNorm(); samples_cone(d2)) return cone_pdf(d2);
  const Float cosine = std::abs(hit.ng.dot(wi));
  return cosine > 0 ? (hit.p - ref).squaredNorm() / (cosine * Float(area())) : Float(0);
}

Float Sphere::pdf(const Vec3& ref, const Vec3& wi) const {
  const Line line(ref.cast<double>(), wi.cast<double>());
  const Vec3d o = line.o - center_;
  const auto pass = sphere_quadratic(o.x(), o.y(), o.z(), line, radius_ * radius_);
  if (!pass.crosses()) return 0;
  if (const double d2 = o.squaredNorm(); samples_cone(d2)) return pass.b > 0 ? cone_pdf(d2) : Float(0);
  const auto at = sphere_crossings(pass, line);
  Float sum = 0;
  for (const double t : {at.t0, at.t1}) {
    const Vec3d offset = o + t * line.d;
    if (t > 0 && contains(offset)) sum += pdf(ref, wi, point(offset.normalized()));
  }
  return sum;
}

} // namespace render
