#pragma once
/// Parts of the extension module libmc._libmc. Each function adds one.

#include <pybind11/pybind11.h>

namespace bindings {

void bind_errors(pybind11::module_& m);
void bind_domain_class(pybind11::module_& m);
void bind_warps(pybind11::module_& m);
void bind_samplers(pybind11::module_& m);
void bind_points(pybind11::module_& m);
void bind_integrate(pybind11::module_& m);
void bind_estimators(pybind11::module_& m);
void bind_check(pybind11::module_& m);
void bind_render(pybind11::module_& m);

} // namespace bindings
