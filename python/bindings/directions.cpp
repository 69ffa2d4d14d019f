#include "warp.h"

#include <mc/warp/cone.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/sphere.h>
#include <mc/warp/sphere_light.h>
#include <mc/warp/spherical_rectangle.h>
#include <mc/warp/spherical_triangle.h>

#include <algorithm>

namespace bindings {

namespace {

using Numbers3 = std::array<double, 3>;
mc::Vec3<double> vector(const Numbers3& v) { return {v[0], v[1], v[2]}; }

// The class of a patch that a corner and two edges define.
template <class W>
void bind_patch(py::module_& m, const char* name, const char* corner, const char* e1, const char* e2) {
  warp_class<W>(m, name).def(
      py::init([=](const Numbers3& c, const Numbers3& a, const Numbers3& b) {
        return BoundWarp<W>(any_warp(fmt::format("{}({}=({:g}), {}=({:g}), {}=({:g}))", name, corner,
                                                 fmt::join(c, ", "), e1, fmt::join(a, ", "), e2, fmt::join(b, ", ")),
                                     W(vector(c), vector(a), vector(b))));
      }),
      py::arg(corner), py::arg(e1), py::arg(e2));
}

} // namespace

void bind_directions(py::module_& m) {
  using py::arg;
  using Cone = mc::UniformCone<double>;
  warp_class<mc::UniformSphere<double>>(m, "UniformSphere").def(py::init([] {
    return make_warp("UniformSphere()", mc::UniformSphere<double>());
  }));
  warp_class<mc::UniformHemisphere<double>>(m, "UniformHemisphere").def(py::init([] {
    return make_warp("UniformHemisphere()", mc::UniformHemisphere<double>());
  }));
  warp_class<mc::CosineHemisphere<double>>(m, "CosineHemisphere").def(py::init([] {
    return make_warp("CosineHemisphere()", mc::CosineHemisphere<double>());
  }));
  warp_class<Cone>(m, "UniformCone")
      .def(py::init([](double angle) { return make_warp("UniformCone(angle={:g})", Cone::from_angle(angle), angle); }),
           arg("angle"), "Cone of directions within `angle` [rad] of +z.")
      .def_static(
          "from_cos",
          [](double cosine) { return make_warp("UniformCone.from_cos({:g})", Cone::from_cos(cosine), cosine); },
          arg("cosine"), "Cone from the cosine of its angle.")
      .def_static(
          "from_one_minus_cos",
          [](double h) { return make_warp("UniformCone.from_one_minus_cos({:g})", Cone::from_one_minus_cos(h), h); },
          arg("h"), "Cone from 1 - cosine, which keeps the precision of narrow cones.")
      .def_static(
          "from_sin2",
          [](double sin2) { return make_warp("UniformCone.from_sin2({:g})", Cone::from_sin2(sin2), sin2); },
          arg("sin2"), "Cone from the squared sine of an angle of at most pi / 2.");
  warp_class<mc::SphereLight<double>>(m, "SphereLight")
      .def(py::init([](const Numbers3& center, double radius) {
             return make_warp("SphereLight(center=({:g}), radius={:g})",
                              mc::SphereLight<double>(vector(center), radius), fmt::join(center, ", "), radius);
           }),
           arg("center"), arg("radius"))
      .def_property_readonly(
          "frame",
          [](const BoundWarp<mc::SphereLight<double>>& w) {
            const mc::Frame<double>& f = w.get().frame();
            Array rows({3, 3});
            double* to = rows.mutable_data();
            for (const auto& axis : {f.x, f.y, f.z}) to = std::copy_n(axis.data(), 3, to);
            return rows;
          },
          "Axes of the directions, one per row (3, 3): directions @ frame are in the world.");
  bind_patch<mc::SphericalRectangle<double>>(m, "SphericalRectangle", "corner", "edge1", "edge2");
  bind_patch<mc::SphericalTriangle<double>>(m, "SphericalTriangle", "a", "ab", "ac");
}

} // namespace bindings
