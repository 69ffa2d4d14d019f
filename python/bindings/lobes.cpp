#include "warp.h"

#include <mc/warp/beckmann.h>
#include <mc/warp/blinn_phong.h>
#include <mc/warp/cone.h>
#include <mc/warp/half_vector.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/rotated.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/von_mises_fisher.h>

namespace bindings {

namespace {

using Numbers3 = std::array<double, 3>;
mc::Vec3<double> vector(const Numbers3& v) { return {v[0], v[1], v[2]}; }
std::string text(const Numbers3& v) { return fmt::format("({:g})", fmt::join(v, ", ")); }

using Beckmann = mc::BeckmannNormals<double>;
using Trowbridge = mc::TrowbridgeReitzNormals<double>;
using Visible = mc::TrowbridgeReitzVisibleNormals<double>;
using BeckmannVisible = mc::BeckmannVisibleNormals<double>;

// Normals of a surface with one roughness or two.
template <class N> void bind_normals(py::module_& m, const char* name) {
  warp_class<N>(m, name).def(
      py::init([name](double alpha_x, std::optional<double> alpha_y) {
        const double ay = alpha_y.value_or(alpha_x);
        return BoundWarp<N>(any_warp(fmt::format("{}(alpha_x={:g}, alpha_y={:g})", name, alpha_x, ay), N(alpha_x, ay)));
      }),
      py::arg("alpha_x"), py::arg("alpha_y") = py::none());
}

struct Reflected {};
struct RefractedIn {};
struct RefractedOut {};
struct Rotated {};

// Normals visible from wo.
template <class N> void bind_visible_normals(py::module_& m, const char* name) {
  warp_class<N>(m, name).def(
      py::init([name](const Numbers3& wo, double alpha_x, std::optional<double> alpha_y) {
        const double ay = alpha_y.value_or(alpha_x);
        return BoundWarp<N>(any_warp(fmt::format("{}(wo={}, alpha_x={:g}, alpha_y={:g})", name, text(wo), alpha_x, ay),
                                     N(vector(wo), alpha_x, ay)));
      }),
      py::arg("wo"), py::arg("alpha_x"), py::arg("alpha_y") = py::none());
}

// Reflected and refracted lobes of the three kinds of normals. Visible normals contain wo.
void bind_half_vectors(py::module_& m) {
  using py::arg;
  const auto bind_reflected = [](auto& lobe, auto normals) {
    using N = decltype(normals);
    using W = typename N::type;
    lobe.def(py::init([](const BoundWarp<W>& n, const Numbers3& wo) {
               return BoundWarp<Reflected>(
                   any_warp("Reflected(" + n.name + ", wo=" + text(wo) + ")", mc::Reflected(vector(wo), n.get())));
             }),
             arg("normals"), arg("wo"));
  };
  py::class_<BoundWarp<Reflected>, AnyWarp> reflected(m, "Reflected", contract("Reflected").c_str());
  const auto bind_visible = [&](auto normals) {
    using W = typename decltype(normals)::type;
    reflected.def(py::init([](const BoundWarp<W>& n) {
                    return BoundWarp<Reflected>(any_warp("Reflected(" + n.name + ")", mc::Reflected(n.get())));
                  }),
                  arg("normals"), "Reflection about visible normals, which contain wo.");
  };
  bind_visible(std::type_identity<Visible>());
  bind_visible(std::type_identity<BeckmannVisible>());
  bind_reflected(reflected, std::type_identity<Beckmann>());
  bind_reflected(reflected, std::type_identity<Trowbridge>());

  const auto bind_refracted = [&](auto& lobe, const char* name, auto make) {
    using Class = typename std::remove_reference_t<decltype(lobe)>::type;
    const auto visible = [&](auto normals) {
      using W = typename decltype(normals)::type;
      lobe.def(py::init([name, make](const BoundWarp<W>& n, double eta) {
                 return Class(any_warp(fmt::format("{}({}, eta={:g})", name, n.name, eta), make(n.get(), eta)));
               }),
               arg("normals"), arg("eta"), "Refraction through visible normals, which contain wo.");
    };
    visible(std::type_identity<Visible>());
    visible(std::type_identity<BeckmannVisible>());
    const auto with_wo = [&](auto normals) {
      using W = typename decltype(normals)::type;
      lobe.def(py::init([name, make](const BoundWarp<W>& n, const Numbers3& wo, double eta) {
                 return Class(any_warp(fmt::format("{}({}, wo={}, eta={:g})", name, n.name, text(wo), eta),
                                       make(vector(wo), n.get(), eta)));
               }),
               arg("normals"), arg("wo"), arg("eta"));
    };
    with_wo(std::type_identity<Beckmann>());
    with_wo(std::type_identity<Trowbridge>());
  };
  py::class_<BoundWarp<RefractedIn>, AnyWarp> in(m, "RefractedIn", contract("RefractedIn").c_str());
  py::class_<BoundWarp<RefractedOut>, AnyWarp> out(m, "RefractedOut", contract("RefractedOut").c_str());
  bind_refracted(in, "RefractedIn", [](const auto&... arguments) { return mc::RefractedIn(arguments...); });
  bind_refracted(out, "RefractedOut", [](const auto&... arguments) { return mc::RefractedOut(arguments...); });
}

template <class... W> void bind_rotated(py::module_& m) {
  py::class_<BoundWarp<Rotated>, AnyWarp> rotated(m, "Rotated", contract("Rotated").c_str());
  (rotated.def(py::init([](const BoundWarp<W>& w, const Numbers3& axis) {
                 return BoundWarp<Rotated>(any_warp("Rotated(" + w.name + ", axis=" + text(axis) + ")",
                                                    mc::Rotated<W>(w.get(), vector(axis))));
               }),
               py::arg("warp"), py::arg("axis")),
   ...);
}

} // namespace

void bind_lobes(py::module_& m) {
  using py::arg;
  warp_class<mc::BlinnPhong<double>>(m, "BlinnPhong")
      .def(py::init([](double n) { return make_warp("BlinnPhong(n={:g})", mc::BlinnPhong<double>(n), n); }), arg("n"));
  warp_class<mc::HenyeyGreenstein<double>>(m, "HenyeyGreenstein")
      .def(py::init([](double g) { return make_warp("HenyeyGreenstein(g={:g})", mc::HenyeyGreenstein<double>(g), g); }),
           arg("g"));
  warp_class<mc::VonMisesFisher<double>>(m, "VonMisesFisher")
      .def(py::init([](double kappa) {
             return make_warp("VonMisesFisher(kappa={:g})", mc::VonMisesFisher<double>(kappa), kappa);
           }),
           arg("kappa"));
  bind_normals<Beckmann>(m, "BeckmannNormals");
  bind_normals<Trowbridge>(m, "TrowbridgeReitzNormals");
  bind_visible_normals<Visible>(m, "TrowbridgeReitzVisibleNormals");
  bind_visible_normals<BeckmannVisible>(m, "BeckmannVisibleNormals");
  bind_half_vectors(m);
  bind_rotated<mc::UniformHemisphere<double>, mc::CosineHemisphere<double>, mc::UniformCone<double>,
               mc::BlinnPhong<double>, mc::HenyeyGreenstein<double>, mc::VonMisesFisher<double>, Beckmann, Trowbridge,
               Visible, BeckmannVisible>(m);
}

} // namespace bindings
