#include "array_function.h"

#include <algorithm>

namespace bindings {

Array ArrayFunction::call(const Array& x) const {
  py::array argument = x;
  if (is_flat_) argument = argument.reshape({x.size()});
  const py::object result = call_interruptible(*cancel_, [&]() -> py::object { return f_(argument); });
  const Array values = to_array(result, what_ + " returned");
  const py::ssize_t n = x.shape(0);
  mc::require(values.ndim() == 0 || (values.ndim() <= 2 && values.shape(0) == n && values.size() > 0),
              "{} returned an array of shape {} for points of shape {}; ({},) or ({}, k) is needed", what_,
              shape_text(values), shape_text(argument), n, n);
  return values;
}

void ArrayFunction::operator()(const Array& x, std::span<double> values) const {
  const Array result = call(x);
  if (result.ndim() == 0) return std::fill(values.begin(), values.end(), *result.data());
  mc::require(static_cast<std::size_t>(result.size()) == values.size(),
              "{} returned an array of shape {}; {} numbers for each of the {} points are needed", what_,
              shape_text(result), values.size() / static_cast<std::size_t>(x.shape(0)), x.shape(0));
  std::copy_n(result.data(), values.size(), values.begin());
}

std::optional<std::size_t> ArrayFunction::count_outputs(const Array& x) const {
  const Array result = call(x);
  if (result.ndim() < 2) return {};
  return static_cast<std::size_t>(result.shape(1));
}

} // namespace bindings
