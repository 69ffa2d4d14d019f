#include "module.h"
#include "arrays.h"

#include <mc/estimate/integrate.h>

namespace bindings {

namespace {

// The exception of a non-finite integrand with the first such point.
py::handle not_finite;

void raise_not_finite(const mc::NotFinite& e) {
  py::object error = py::reinterpret_borrow<py::object>(not_finite)(e.what());
  error.attr("u") = new_array(e.u);
  error.attr("bad") = e.bad;
  error.attr("points") = e.points;
  PyErr_SetObject(not_finite.ptr(), error.ptr());
}

} // namespace

void bind_errors(py::module_& m) {
  static const py::exception<mc::Error> error(m, "Error", PyExc_ValueError);
  py::exception<mc::NotFinite> of_integrand(m, "NotFiniteError", error.ptr());
  error.attr("__doc__") = "Bad data, file or argument. The message is that of C++: value, place and allowed range.";
  of_integrand.attr("__doc__") = "An integrand that is not finite. `u` is the first such point of the unit cube, `bad` "
                                 "their number among `points`.";
  error.attr("__module__") = "libmc";
  of_integrand.attr("__module__") = "libmc";
  not_finite = of_integrand.release();
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const mc::NotFinite& e) {
      raise_not_finite(e);
    } catch (const mc::Error& e) {
      PyErr_SetString(error.ptr(), e.what());
    }
  });
}

} // namespace bindings

PYBIND11_MODULE(_libmc, m) {
  m.doc() = "The C++ part of libmc; import libmc instead.";
  m.attr("__version__") = MC_VERSION;
  bindings::bind_errors(m);
  bindings::bind_domain_class(m);
  bindings::bind_warps(m);
  bindings::bind_samplers(m);
  bindings::bind_points(m);
  bindings::bind_integrate(m);
  bindings::bind_estimators(m);
  bindings::bind_check(m);
  bindings::bind_render(m);
}
