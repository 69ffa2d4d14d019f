#pragma once
/// Arrays of points between NumPy and C++.

#include <mc/core/error.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace bindings {

namespace py = pybind11;

/// Anything that NumPy takes for an array.
class ArrayLike : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(ArrayLike, py::object, [](PyObject*) { return true; })
};

/// The name of a file: text, bytes, or an object with __fspath__.
class PathLike : public py::object {
 public:
  PYBIND11_OBJECT_DEFAULT(PathLike, py::object, [](PyObject*) { return true; })
  std::string text() const { return py::module_::import("os").attr("fsencode")(*this).cast<std::string>(); }
};

/// A contiguous array of doubles.
using Array = py::array_t<double, py::array::c_style>;

/// Converts anything that NumPy takes for an array of real numbers; copies only where type or layout differ.
///   what   : begins the message, such as "sample: u".
///   throws : Error for complex numbers, text and objects.
Array to_array(const py::handle& object, const std::string& what);

/// Points as rows: `columns` numbers each. `outer` is the shape of the array without the coordinates.
struct Rows {
  Array array;
  std::vector<py::ssize_t> outer;
  std::size_t columns, count;

  std::span<const double> values() const { return {array.data(), count * columns}; }
};

/// An array of shape (..., columns), or of any shape if columns is 1 and `has_axis` is false.
///   throws : Error for another shape.
Rows to_rows(const py::handle& object, std::size_t columns, const std::string& what, bool has_axis = false);

/// A new array of shape (*outer, columns), without the last axis if columns is 1.
Array new_rows(const std::vector<py::ssize_t>& outer, std::size_t columns);
/// `out` if it is an array of that shape and of doubles that C++ can write to; a new array if it is None.
///   throws : Error for another array.
Array rows_for(const py::object& out, const std::vector<py::ssize_t>& outer, std::size_t columns);

/// A new array of doubles with the numbers of a span.
Array new_array(std::span<const double> values, std::vector<py::ssize_t> shape = {});

/// "(3, 2)".
std::string shape_text(const py::array& array);

/// The numbers of an array of any shape.
inline std::span<const double> span_of(const Array& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}
/// The numbers of a new array, to write.
inline std::span<double> span_of(Array& array) {
  return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

/// Throws Error with the first coordinate outside [0,1), of all points or of `count` points from `first` on.
void require_unit(const Rows& u, const std::string& what, std::size_t first, std::size_t count);
/// As above.
inline void require_unit(const Rows& u, const std::string& what) { require_unit(u, what, 0, u.count); }

} // namespace bindings

/// The name in signatures.
template <> struct pybind11::detail::handle_type_name<bindings::ArrayLike> {
  static constexpr auto name = const_name("ArrayLike");
};
template <> struct pybind11::detail::handle_type_name<bindings::PathLike> {
  static constexpr auto name = const_name("Union[str, bytes, os.PathLike]");
};
