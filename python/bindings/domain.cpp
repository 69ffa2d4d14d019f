#include "domain.h"
#include "module.h"
#include "warp.h"

#include <input/parsed_domain.h>

#include <algorithm>

namespace bindings {

namespace {

mc::AnyDomain::Coordinates coordinates_at(const double* row, std::size_t columns) {
  mc::AnyDomain::Coordinates v{};
  std::copy_n(row, columns, v.begin());
  return v;
}
mc::PointArray point_at(const double* row, std::size_t columns) {
  mc::PointArray x{};
  std::copy_n(row, columns, x.begin());
  return x;
}

Rows unit_rows(const BoundDomain& d, const ArrayLike& v, const std::string& what) {
  Rows rows = to_rows(v, static_cast<std::size_t>(d.any.dim), what + ": v");
  require_unit(rows, what + ": v");
  return rows;
}
Rows point_rows(const BoundDomain& d, const ArrayLike& x, const std::string& what) {
  return to_rows(x, static_cast<std::size_t>(d.any.point_size), what + ": x");
}

Array from_unit(const BoundDomain& d, const ArrayLike& v) {
  const Rows rows = unit_rows(d, v, "from_unit");
  const auto size = static_cast<std::size_t>(d.any.point_size);
  Array x = new_rows(rows.outer, size);
  for (std::size_t i = 0; i < rows.count; ++i) {
    const mc::PointArray point = d.any.from_unit(coordinates_at(&rows.values()[i * rows.columns], rows.columns)).x;
    std::copy_n(point.begin(), size, x.mutable_data() + i * size);
  }
  return x;
}

Array jacobian(const BoundDomain& d, const ArrayLike& v) {
  const Rows rows = unit_rows(d, v, "jacobian");
  Array values = new_rows(rows.outer, 1);
  for (std::size_t i = 0; i < rows.count; ++i)
    values.mutable_data()[i] = d.any.jacobian(coordinates_at(&rows.values()[i * rows.columns], rows.columns));
  return values;
}

py::array_t<bool> contains(const BoundDomain& d, const ArrayLike& x) {
  const Rows rows = point_rows(d, x, "contains");
  py::array_t<bool> inside(rows.outer);
  for (std::size_t i = 0; i < rows.count; ++i)
    inside.mutable_data()[i] = d.any.contains(point_at(&rows.values()[i * rows.columns], rows.columns));
  return inside;
}

Array to_unit(const BoundDomain& d, const ArrayLike& x) {
  const Rows rows = point_rows(d, x, "to_unit");
  const auto dim = static_cast<std::size_t>(d.any.dim);
  Array v = new_rows(rows.outer, dim);
  for (std::size_t i = 0; i < rows.count; ++i) {
    const mc::PointArray point = point_at(&rows.values()[i * rows.columns], rows.columns);
    if (!d.any.contains(point)) detail::refuse_outside(point.data(), rows.columns, i);
    const mc::AnyDomain::Coordinates at = d.any.to_unit(point);
    std::transform(at.begin(), at.begin() + dim, v.mutable_data() + i * dim, mc::clamp_to_unit<double>);
  }
  return v;
}

BoundDomain parse(const std::string& text) {
  const carlo::ParsedDomain parsed = carlo::parse_domain(text, carlo::unknown_quartiles, carlo::Rounding::doubles);
  mc::require(!parsed.outcomes.any(), "Domain: '{}' has discrete outcomes; a set of points is needed", text);
  return {parsed.chart, parsed.text};
}

} // namespace

BoundDomain to_domain(const py::handle& object) {
  if (py::isinstance<BoundDomain>(object)) return object.cast<BoundDomain>();
  if (py::isinstance<AnyWarp>(object)) return object.cast<const AnyWarp&>().domain;
  mc::require(py::isinstance<py::str>(object),
              "domain: {} is neither a Domain, a warp, nor text such as \"hemisphere\" or \"x=0:1,y=-1:2\"",
              py::repr(object).cast<std::string>());
  return parse(object.cast<std::string>());
}

void bind_domain_class(py::module_& m) {
  py::class_<BoundDomain>(m, "Domain", R"(A set of points with a chart from the unit cube.

Made from text, or taken from a warp (`warp.domain`):
  "x=0:1"            an interval; either end may be inf or -inf
  "x=0:1,y=-1:2"     a rectangle; parts separated by commas are factors
  "disk", "annulus=R", "triangle", "ball", "sphere", "hemisphere", "rotation"
Points are arrays of shape (..., point_size), or of any shape if point_size is 1. Chart coordinates v in [0,1) have
shape (..., dim) in the same way.)")
      .def(py::init(&parse), py::arg("text"))
      .def_property_readonly(
          "dim", [](const BoundDomain& d) { return d.any.dim; }, "Number of dimensions of the chart.")
      .def_property_readonly(
          "point_size", [](const BoundDomain& d) { return d.any.point_size; }, "Number of coordinates of a point.")
      .def("from_unit", &from_unit, py::arg("v"),
           "Points of the domain: v (..., dim) -> x (..., point_size). v = 0 may give an infinite end.")
      .def("to_unit", &to_unit, py::arg("x"),
           "Inverse of from_unit: x (..., point_size) -> v (..., dim) in [0,1). Raises Error for points outside.")
      .def("jacobian", &jacobian, py::arg("v"), "|dx/dv| of from_unit: v (..., dim) -> (...).")
      .def("contains", &contains, py::arg("x"),
           "Whether points lie in the domain, to a few eps: x (...) -> bool (...).")
      .def("__repr__", [](const BoundDomain& d) { return "<libmc.Domain: " + d.text + ">"; });
}

} // namespace bindings
