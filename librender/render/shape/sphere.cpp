#include <render/shape/sphere.h>

#include <mc/core/error.h>
#include <mc/core/frame.h>

#include <cmath>

namespace render {

namespace {

Float cone_pdf(double one_minus_cos) { return Float(1 / (2 * mc::pi<double> * one_minus_cos)); }

} // namespace

Sphere::Sphere(const Vec3d& center, double radius, bool inside_out)
    : center_(center), radius_(radius), height_(2 * radius), inside_out_(inside_out) {
  mc::require(center.allFinite(), "sphere: centre ({}, {}, {}) is not finite", center.x(), center.y(), center.z());
  mc::require(std::isfinite(radius) && radius > 0, "sphere: radius {} must be finite and > 0", radius);
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

std::optional<double> Sphere::intersect(const Ray& ray) const {
  const Vec3d o = ray.o.cast<double>() - center_, d = ray.d.cast<double>();
  const double a = d.squaredNorm(), b = -o.dot(d);
  // Squared distance of the centre from the line, without the cancellation of b^2 - 4 a c
  // [HainesGuntherAkenineMoller19].
  const double discriminant = radius_ * radius_ - (o + d * (b / a)).squaredNorm();
  if (!(discriminant >= 0)) return {};
  const double q = b + std::copysign(std::sqrt(a * discriminant), b);
  const double c = o.squaredNorm() - radius_ * radius_;
  double t0 = q / a, t1 = q != 0 ? c / q : -1;
  if (t0 > t1) std::swap(t0, t1);
  for (const double t : {t0, t1})
    if (t > 0 && t < double(ray.t_max) && (!is_cap() || (o + t * d).dot(axis_) >= radius_ - height_)) return t;
  return {};
}

SurfacePoint Sphere::point(const Vec3d& direction) const {
  SurfacePoint s;
  const Vec3d p = center_ + radius_ * direction;
  s.p = p.cast<Float>();
  // Rounded once from double; double itself resolves the sphere to 2^-52 of its extent.
  s.error = std::numeric_limits<Float>::epsilon() * s.p.lpNorm<Eigen::Infinity>() +
            Float(0x1p-50 * (radius_ + center_.lpNorm<Eigen::Infinity>()));
  s.ng = (inside_out_ ? Vec3d(-direction) : direction).cast<Float>();
  s.ns = s.ng;
  s.prim = 0;
  return s;
}

SurfacePoint Sphere::surface_point(const Ray& ray, const Hit& hit) const {
  // In double and projected: the float t moves the point along the surface by an ulp of the distance, but not off it.
  SurfacePoint s = point((ray.o.cast<double>() + double(hit.t) * ray.d.cast<double>() - center_).normalized());
  s.shape = hit.shape;
  return s;
}

double Sphere::area() const { return 2 * mc::pi<double> * radius_ * height_; }

std::optional<double> Sphere::cone(double d2) const {
  // Points of the sphere itself round to either side of it. Taken for outside, their cone would hold nothing but
  // themselves.
  const double rounding =
      4 * double(std::numeric_limits<Float>::epsilon()) * (radius_ + center_.lpNorm<Eigen::Infinity>());
  if (is_cap() || !(d2 > mc::sqr(radius_ + rounding))) return {};
  const double sin2 = radius_ * radius_ / d2;
  return sin2 / (1 + std::sqrt(1 - sin2));
}

std::optional<ShapeSample> Sphere::sample(const Vec3& ref, const Vec2& u) const {
  const Vec3d toward = center_ - ref.cast<double>();
  const double d2 = toward.squaredNorm();
  // Any point of the circle of latitude will do, so its azimuth may be rounded to float.
  const Float phi = 2 * mc::pi<Float> * u[1];
  const auto direction = [c = double(std::cos(phi)), s = double(std::sin(phi))](double sine, double cosine) {
    return Vec3d(sine * c, sine * s, cosine);
  };
  ShapeSample s;
  if (const auto one_minus_cos = cone(d2)) {
    // A direction of the cone, and the near point of the sphere along it.
    const double v = double(u[0]) * *one_minus_cos, cosine = 1 - v, sin2 = v * (2 - v), d = std::sqrt(d2);
    const auto frame = mc::Frame<double>::from_z(toward / d);
    const Vec3d wi = frame.to_world(direction(std::sqrt(sin2), cosine));
    const double t = d * cosine - mc::safe_sqrt<double>(radius_ * radius_ - d2 * sin2);
    s.point = point((t * wi - toward).normalized());
    s.wi = wi.cast<Float>();
    s.pdf = cone_pdf(*one_minus_cos);
  } else {
    const double v = double(u[0]) * height_ / radius_; // 1 - cos of the angle from the axis
    const auto frame = mc::Frame<double>::from_z(axis_);
    s.point = point(frame.to_world(direction(mc::safe_sqrt<double>(v * (2 - v)), 1 - v)).normalized());
    const Vec3 between = s.point.p - ref;
    if (!(between.squaredNorm() > 0)) return {};
    s.wi = between.normalized();
    s.pdf = pdf(ref, s.wi, s.point);
  }
  if (!(s.pdf > 0) || !std::isfinite(s.pdf)) return {};
  return s;
}

Float Sphere::pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const {
  if (const auto one_minus_cos = cone((center_ - ref.cast<double>()).squaredNorm())) return cone_pdf(*one_minus_cos);
  const Float cosine = std::abs(hit.ng.dot(wi));
  return cosine > 0 ? (hit.p - ref).squaredNorm() / (cosine * Float(area())) : Float(0);
}

Float Sphere::pdf(const Vec3& ref, const Vec3& wi) const {
  const Vec3d oc = ref.cast<double>() - center_, d = wi.cast<double>();
  const double b = -oc.dot(d), discriminant = radius_ * radius_ - (oc + d * b).squaredNorm();
  if (!(discriminant >= 0)) return 0;
  if (const auto one_minus_cos = cone(oc.squaredNorm())) return b > 0 ? cone_pdf(*one_minus_cos) : Float(0);
  Float sum = 0;
  const double half = std::sqrt(discriminant);
  for (const double t : {b - half, b + half}) {
    const Vec3d direction = (oc + t * d) / radius_;
    if (t > 0 && (!is_cap() || direction.dot(axis_) * radius_ >= radius_ - height_))
      sum += pdf(ref, wi, point(direction));
  }
  return sum;
}

} // namespace render
