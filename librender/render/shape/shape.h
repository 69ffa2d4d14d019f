#pragma once
/// The closed set of shapes.

#include <render/core/dispatch.h>
#include <render/shape/cylinder.h>
#include <render/shape/disk.h>
#include <render/shape/sphere.h>
#include <render/shape/triangle_mesh.h>

namespace render {

/// One of the shapes. Models ShapeLike, where the operations are documented.
struct Shape : std::variant<TriangleMesh, Sphere, Disk, Cylinder> {
  using variant::variant;

  std::optional<ShapeSample> sample(const Vec3& ref, const Vec2& u) const {
    return dispatch(*this, [&](const auto& s) { return s.sample(ref, u); });
  }
  std::optional<DirectionSample> sample_direction(const Vec3& ref, const Vec2& u) const {
    return dispatch(*this, [&](const auto& s) { return s.sample_direction(ref, u); });
  }
  std::optional<SurfacePoint> sample_area(const Vec2& u) const {
    return dispatch(*this, [&](const auto& s) { return s.sample_area(u); });
  }
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const {
    return dispatch(*this, [&](const auto& s) { return s.pdf(ref, wi, hit); });
  }
  Float pdf(const Vec3& ref, const Vec3& wi) const {
    return dispatch(*this, [&](const auto& s) { return s.pdf(ref, wi); });
  }
  double area() const {
    return dispatch(*this, [](const auto& s) { return s.area(); });
  }
  Eigen::AlignedBox3d box() const {
    return dispatch(*this, [](const auto& s) { return s.box(); });
  }
  Ball bounding_ball() const {
    return dispatch(*this, [](const auto& s) { return s.bounding_ball(); });
  }
  bool is_spherical() const {
    return dispatch(*this, [](const auto& s) { return s.is_spherical(); });
  }
  double projected_solid_angle_bound(const Vec3& ref) const {
    return dispatch(*this, [&](const auto& s) { return s.projected_solid_angle_bound(ref); });
  }
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const {
    return dispatch(*this, [&](const auto& s) { return s.surface_point(ray, hit); });
  }
  bool has_uv() const {
    return dispatch(*this, [](const auto& s) { return s.has_uv(); });
  }
  mc::Vec2<double> uv(const Hit& hit, const SurfacePoint& point) const {
    return dispatch(*this, [&](const auto& s) { return s.uv(hit, point); });
  }
  mc::Vec2<double> uv(const SurfacePoint& point) const {
    return dispatch(*this, [&](const auto& s) { return s.uv(point); });
  }
  double uv_scale(const Hit& hit, const SurfacePoint& point) const {
    return dispatch(*this, [&](const auto& s) { return s.uv_scale(hit, point); });
  }
  void discard_uvs() {
    std::visit([](auto& s) { s.discard_uvs(); }, static_cast<variant&>(*this));
  }
  void discard_sampling_table() {
    std::visit([](auto& s) { s.discard_sampling_table(); }, static_cast<variant&>(*this));
  }
};

} // namespace render
