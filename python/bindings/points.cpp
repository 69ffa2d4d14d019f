#include "arrays.h"
#include "contracts.h"
#include "module.h"

#include <mc/points/discrepancy.h>
#include <mc/points/net.h>
#include <mc/points/spectrum.h>
#include <mc/points/star_discrepancy.h>

#include <pybind11/stl.h>

namespace bindings {

namespace {

using py::arg;

// Calls f(points) with an array of shape (n, d), without the interpreter's lock.
template <class F> auto with_points(const ArrayLike& points, const char* name, F f) {
  const Array array = to_array(points, name);
  mc::require(array.ndim() == 2 && array.shape(1) > 0, "{}: points of shape {}; the shape must be (n, d)", name,
              shape_text(array));
  const mc::PointList list{span_of(array), static_cast<std::size_t>(array.shape(1))};
  const py::gil_scoped_release release;
  mc::require_unit_points(list);
  return f(list);
}

void bind_number(py::module_& m, const char* name, double (*f)(mc::PointList)) {
  m.def(
      name, [=](const ArrayLike& points) { return with_points(points, name, f); }, arg("points"),
      contract(name).c_str());
}

} // namespace

void bind_points(py::module_& parent) {
  py::module_ m = parent.def_submodule("points", "Quality of point sets of shape (n, d) in the unit cube.");
  py::class_<mc::StarDiscrepancy>(m, "StarDiscrepancy", contract("StarDiscrepancy").c_str())
      .def_readonly("lower", &mc::StarDiscrepancy::lower, "Lower bound.")
      .def_readonly("upper", &mc::StarDiscrepancy::upper, "Upper bound; the lower bound if the value is exact.")
      .def_property_readonly("exact", &mc::StarDiscrepancy::exact, "Whether the value was found exactly.")
      .def("__repr__", [](const mc::StarDiscrepancy& s) {
        return s.exact() ? fmt::format("StarDiscrepancy({:g})", s.lower)
                         : fmt::format("StarDiscrepancy([{:g}, {:g}])", s.lower, s.upper);
      });
  m.def(
      "star_discrepancy",
      [](const ArrayLike& points, std::uint64_t work) {
        return with_points(points, "star_discrepancy", [&](mc::PointList p) { return mc::star_discrepancy(p, work); });
      },
      arg("points"), arg("work") = 1'000'000'000, contract("star_discrepancy").c_str());
  bind_number(m, "l2_star_discrepancy", &mc::l2_star_discrepancy);
  bind_number(m, "periodic_l2_discrepancy", &mc::periodic_l2_discrepancy);
  bind_number(m, "centered_discrepancy", &mc::centered_discrepancy);
  bind_number(m, "wraparound_discrepancy", &mc::wraparound_discrepancy);
  bind_number(m, "mixture_discrepancy", &mc::mixture_discrepancy);
  m.def(
      "smallest_distance",
      [](const ArrayLike& points, bool periodic) {
        const mc::SmallestDistance d = with_points(points, "smallest_distance", &mc::smallest_distance);
        return periodic ? d.periodic : d.plain;
      },
      arg("points"), arg("periodic") = false,
      (contract("smallest_distance") + "\n\nReturns the distance in the cube, or with `periodic` that with wrapping; "
                                       "infinity for a single point.")
          .c_str());
  m.def(
      "net_quality",
      [](const ArrayLike& points) {
        return with_points(points, "net_quality", [](mc::PointList p) { return mc::net_quality(p); });
      },
      arg("points"), (contract("net_quality") + "\n\nReturns None for nullopt. `work` is 1e9.").c_str());
  m.def(
      "radial_power_spectrum",
      [](const ArrayLike& points, int rings) {
        return new_array(with_points(points, "radial_power_spectrum",
                                     [&](mc::PointList p) { return mc::radial_power_spectrum(p, rings); }));
      },
      arg("points"), arg("rings"), contract("radial_power_spectrum").c_str());
}

} // namespace bindings
