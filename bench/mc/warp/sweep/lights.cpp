// Planar lights for random viewers: inside and outside the outline, near the plane, far away, slivers.
#include "sweep.h"

#include <mc/core/frame.h>

#include <mc/warp/spherical_rectangle.h>
#include <mc/warp/spherical_triangle.h>

namespace sweep {
namespace {

using Vec3d = mc::Vec3<double>;

// A corner and two edges relative to the viewer.
template <class S> struct RandomPatch {
  mc::Vec3<S> corner, edge1, edge2;

  explicit RandomPatch(Draw& r) {
    const double size = r.log(1e-3, 1e3), height = size * r.log(1e-6, 1e3);
    // First in the plane: a random angle, a ratio of edges up to 1e3, and a random foot point of the viewer.
    const double length = size * r.log(1e-3, 1), angle = r.often(0.3) ? std::numbers::pi / 2 : 0.05 + 3 * r.u();
    const Vec3d e1(size, 0, 0), e2(length * std::cos(angle), length * std::sin(angle), 0);
    double s = 3 * r.u() - 1, t = 3 * r.u() - 1;
    if (r.often(0.2)) s = r.sign() * r.log(1e-8, 1);
    if (r.often(0.2)) t = 1 - s + r.sign() * r.log(1e-8, 1);
    if (r.often(0.2)) t = s;
    const Vec3d o = Vec3d(0, 0, height) - s * e1 - t * e2;
    const bool turned = r.often(0.5);
    const Vec3d z = r.direction<double>();
    const auto frame = mc::Frame<double>::from_z(z);
    const auto place = [&](const Vec3d& v) {
      return mc::Vec3<S>((turned ? frame.to_world(v) : v).eval().template cast<S>());
    };
    corner = place(o);
    edge1 = place(e1);
    edge2 = place(e2);
  }
  std::string text() const {
    return fmt::format("{} {} {}", detail::text(corner), detail::text(edge1), detail::text(edge2));
  }
  /// Flatness as in spherical_triangle.h: farthest corner divided by the height of the viewer above the plane, plus
  /// longest edge divided by the height of the patch on it.
  double flatness() const {
    const mc::Vec3<mc::Oracle> o = mc::cast_point<mc::Oracle>(corner), e1 = mc::cast_point<mc::Oracle>(edge1),
                               e2 = mc::cast_point<mc::Oracle>(edge2);
    const mc::Vec3<mc::Oracle> n = mc::cross<mc::Oracle>(e1, e2);
    const double height = std::abs(static_cast<double>(mc::Oracle(o.dot(n) / n.norm())));
    const double far = static_cast<double>(o.norm() + e1.norm() + e2.norm());
    const double edge = std::max(static_cast<double>(e1.norm()), static_cast<double>(e2.norm()));
    return far / height + edge * edge / static_cast<double>(n.norm());
  }
};

template <class S, template <class> class W> Row patch(const std::string& name, const Effort& effort) {
  double flat = 0;
  return run(
      name, effort,
      [&flat](Draw& r, std::string& p) {
        const RandomPatch<S> patch(r);
        p = patch.text();
        flat = patch.flatness();
        p += fmt::format(" flatness {:.3g}", flat);
        return W<S>(patch.corner, patch.edge1, patch.edge2);
      },
      [&flat](const W<S>&) {
        const double loss = std::same_as<S, float> ? 1 + 1e-9 * flat * flat : flat;
        // The inverse is tested separately: its conditioning depends on the shape.
        return
            [=](const auto&, const auto&) { return Bounds{.sample = 32 * loss, .pdf = 16 * loss, .invert = HUGE_VAL}; };
      });
}

} // namespace

std::vector<Row> lights(const Effort& effort) {
  return {patch<float, mc::SphericalTriangle>("SphericalTriangle float", effort),
          patch<double, mc::SphericalTriangle>("SphericalTriangle double", effort),
          patch<float, mc::SphericalRectangle>("SphericalRectangle float", effort),
          patch<double, mc::SphericalRectangle>("SphericalRectangle double", effort)};
}

} // namespace sweep
