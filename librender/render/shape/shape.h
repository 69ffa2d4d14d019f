#pragma once
/// The closed set of shapes.

#include <render/shape/sphere.h>
#include <render/shape/triangle_mesh.h>

#include <variant>

namespace render {

/// One of the shapes; itself models ShapeLike.
struct Shape : std::variant<TriangleMesh, Sphere> {
  using variant::variant;

  std::optional<ShapeSample> sample(const Vec3& ref, const Vec2& u) const {
    return visit([&](const auto& s) { return s.sample(ref, u); });
  }
  Float pdf(const Vec3& ref, const Vec3& wi, const SurfacePoint& hit) const {
    return visit([&](const auto& s) { return s.pdf(ref, wi, hit); });
  }
  double area() const {
    return visit([](const auto& s) { return s.area(); });
  }
  SurfacePoint surface_point(const Ray& ray, const Hit& hit) const {
    return visit([&](const auto& s) { return s.surface_point(ray, hit); });
  }

 private:
  template <class F> decltype(auto) visit(F&& f) const { return std::visit(f, static_cast<const variant&>(*this)); }
};

} // namespace render
