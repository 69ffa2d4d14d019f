#include "arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace bindings {

Array to_array(const py::handle& object, const std::string& what) {
  const py::array any = py::array::ensure(object);
  if (!any) {
    PyErr_Clear();
    throw mc::Error(
        fmt::format("{}: {} is no array of numbers", what, py::repr(py::type::of(object)).cast<std::string>()));
  }
  mc::require(std::string_view("biuf").find(any.dtype().kind()) != std::string_view::npos,
              "{}: an array of {}; real numbers are needed", what, py::str(any.dtype()).cast<std::string>());
  Array doubles = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(any);
  if (!doubles) throw std::bad_alloc();
  return doubles;
}

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")).cast<std::string>(); }

Rows to_rows(const py::handle& object, std::size_t columns, const std::string& what, bool has_axis) {
  Rows rows{to_array(object, what), {}, columns, 0};
  rows.outer.assign(rows.array.shape(), rows.array.shape() + rows.array.ndim());
  if (columns > 1 || has_axis) {
    mc::require(!rows.outer.empty() && rows.outer.back() == static_cast<py::ssize_t>(columns),
                "{}: an array of shape {}; the shape must be (..., {})", what, shape_text(rows.array), columns);
    rows.outer.pop_back();
  }
  rows.count = static_cast<std::size_t>(rows.array.size()) / columns;
  return rows;
}

namespace {
std::vector<py::ssize_t> shape_of(std::vector<py::ssize_t> outer, std::size_t columns) {
  if (columns > 1) outer.push_back(static_cast<py::ssize_t>(columns));
  return outer;
}
} // namespace

Array new_rows(const std::vector<py::ssize_t>& outer, std::size_t columns) { return Array(shape_of(outer, columns)); }

Array rows_for(const py::object& out, const std::vector<py::ssize_t>& outer, std::size_t columns) {
  if (out.is_none()) return new_rows(outer, columns);
  const std::vector<py::ssize_t> shape = shape_of(outer, columns);
  mc::require(py::isinstance<Array>(out), "out: an array of doubles in C order is needed, as numpy.empty makes");
  Array array = out.cast<Array>();
  mc::require(array.writeable(), "out: the array is read-only");
  mc::require(std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim()),
              "out: an array of shape {}; the shape of the results is {}", shape_text(array),
              py::str(py::tuple(py::cast(shape))).cast<std::string>());
  return array;
}

Array new_array(std::span<const double> values, std::vector<py::ssize_t> shape) {
  if (shape.empty()) shape = {static_cast<py::ssize_t>(values.size())};
  Array array(std::move(shape));
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}

void require_unit(const Rows& u, const std::string& what, std::size_t first, std::size_t count) {
  const std::span<const double> values = u.values().subspan(first * u.columns, count * u.columns);
  std::uint64_t inside = 0; // as wide as the numbers, so that the loop vectorizes
  for (const double v : values) inside += std::uint64_t(v >= 0) & std::uint64_t(v < 1);
  if (inside == values.size()) return;
  const auto found = std::find_if(values.begin(), values.end(), [](double v) { return !(v >= 0 && v < 1); });
  if (found == values.end()) return; // another thread of Python has changed it
  const auto bad = static_cast<std::size_t>(found - values.begin());
  throw mc::Error(fmt::format("{}: coordinate {} of point {} is {}; it must lie in [0, 1)", what, bad % u.columns,
                              first + bad / u.columns, values[bad]));
}

} // namespace bindings
