#pragma once
/// Reports of checks for Python.

#include <mc/check/report/report.h>

#include <pybind11/pybind11.h>

namespace bindings {

/// Adds the class Report and its parts.
void bind_report(pybind11::module_& m);

} // namespace bindings
