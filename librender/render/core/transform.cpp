#include <render/core/transform.h>

#include <mc/core/error.h>

#include <Eigen/LU>

namespace render {

Transform Transform::columns(const Vec3d& x, const Vec3d& y, const Vec3d& z, const Vec3d& origin) {
  Transform t;
  t.linear << x, y, z;
  t.translation = origin;
  return t;
}

Transform Transform::translate(const Vec3d& v) { return columns(Vec3d::UnitX(), Vec3d::UnitY(), Vec3d::UnitZ(), v); }

Transform Transform::scale(const Vec3d& s) {
  return columns({s.x(), 0, 0}, {0, s.y(), 0}, {0, 0, s.z()}, Vec3d::Zero());
}

Transform Transform::rotate(const Vec3d& axis, double degrees) {
  mc::require(axis.norm() > 0, "rotate: the axis must not be 0");
  const Vec3d a = axis.normalized();
  const double angle = degrees * mc::pi<double> / 180, s = std::sin(angle), c = std::cos(angle);
  Transform t;
  for (int i = 0; i < 3; ++i)
    t.linear.col(i) = c * Vec3d::Unit(i) + s * mc::cross<double>(a, Vec3d::Unit(i)) + (1 - c) * a[i] * a;
  return t;
}

Transform Transform::look_at(const Vec3d& origin, const Vec3d& target, const Vec3d& up) {
  const Vec3d forward = (target - origin).stableNormalized();
  const Vec3d left = mc::cross<double>(up.stableNormalized(), forward);
  mc::require(left.norm() > 0, "lookAt: target - origin must not be 0 or parallel to up");
  const Vec3d x = left.normalized();
  return columns(x, mc::cross<double>(forward, x), forward, origin);
}

Vec3d Transform::point(const Vec3d& p) const { return linear * p + translation; }

Vec3d Transform::vector(const Vec3d& v) const { return linear * v; }

Vec3d Transform::normal(const Vec3d& n) const { return linear.inverse().transpose() * n; }

bool Transform::mirrors() const { return linear.determinant() < 0; }

Transform Transform::operator*(const Transform& first) const {
  Transform t;
  t.linear = linear * first.linear;
  t.translation = point(first.translation);
  return t;
}

} // namespace render
