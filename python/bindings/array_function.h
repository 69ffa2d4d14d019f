#pragma once
/// Functions of Python that take arrays of points.

#include "arrays.h"

#include <atomic>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace bindings {

/// Calls f() with the interpreter's lock held. The first KeyboardInterrupt sets `cancel`, and f() is called again: the
/// run ends after its current points, none of which is lost. The second is thrown.
template <class F> auto call_interruptible(std::atomic<bool>& cancel, F&& f) {
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return f();
  } catch (py::error_already_set& e) {
    if (!e.matches(PyExc_KeyboardInterrupt) || cancel.exchange(true)) throw;
  }
  return f();
}

/// A function of Python from points to numbers. The interpreter's lock must be held.
class ArrayFunction {
 public:
  /// `what` begins the messages, such as "integrate: f". `is_flat`: points have the shape (n,), not (n, d).
  ArrayFunction(py::function f, std::string what, bool is_flat, std::atomic<bool>& cancel)
      : f_(std::move(f)), what_(std::move(what)), is_flat_(is_flat), cancel_(&cancel) {}

  /// Fills `values` with one row for each point of x.
  ///   throws : Error unless f returns real numbers of shape (n,) or (n, k); a single number stands for all points.
  void operator()(const Array& x, std::span<double> values) const;

  /// The k of a result (n, k); no value for a result (n,).
  std::optional<std::size_t> count_outputs(const Array& x) const;

 private:
  Array call(const Array& x) const;

  py::function f_;
  std::string what_;
  bool is_flat_;
  std::atomic<bool>* cancel_;
};

} // namespace bindings
