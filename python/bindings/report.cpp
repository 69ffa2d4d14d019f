#include "report.h"
#include "arrays.h"

#include <report/report_json.h>
#include <report/validate_output.h>

#include <mc/core/file.h>

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

#include <array>

namespace bindings {

namespace {

using py::arg;

// The member of every cell, as an array of shape (cells, dim).
Array corners(const mc::Report& r, mc::PerAxis<double> mc::CellCount::*member) {
  const auto& cells = r.evidence->cells;
  const std::size_t dim = r.axes.size();
  Array array({cells.size(), dim});
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t k = 0; k < dim; ++k) array.mutable_data()[i * dim + k] = (cells[i].*member)[k];
  return array;
}

Array counts(const std::vector<mc::CellCount>& cells, double mc::CellCount::*member) {
  Array array(static_cast<py::ssize_t>(cells.size()));
  for (std::size_t i = 0; i < cells.size(); ++i) array.mutable_data()[i] = cells[i].*member;
  return array;
}

// Corners in coordinates of the domain: degrees for angles.
Array in_units(const mc::Report& r, Array chart) {
  const std::size_t dim = r.axes.size();
  for (std::size_t i = 0; i < static_cast<std::size_t>(chart.size()); ++i) {
    double& v = chart.mutable_data()[i];
    v = r.axes[i % dim].value(v);
  }
  return chart;
}

py::dict cells(const mc::Report& r) {
  py::dict d;
  if (!r.evidence) return d;
  const bool is_discrete = r.evidence->cells.empty();
  const auto& all = is_discrete ? r.evidence->outcomes : r.evidence->cells;
  if (!is_discrete) {
    d["lo"] = corners(r, &mc::CellCount::lo);
    d["hi"] = corners(r, &mc::CellCount::hi);
    d["x_lo"] = in_units(r, corners(r, &mc::CellCount::lo));
    d["x_hi"] = in_units(r, corners(r, &mc::CellCount::hi));
  }
  d["observed"] = counts(all, &mc::CellCount::observed);
  d["expected"] = counts(all, &mc::CellCount::expected);
  return d;
}

py::tuple p_after(const mc::Report& r) {
  std::vector<double> samples, p;
  if (r.evidence)
    for (const mc::PlotData::PValueAfter& one : r.evidence->p_after) {
      samples.push_back(static_cast<double>(one.samples));
      p.push_back(one.p);
    }
  return py::make_tuple(new_array(samples), new_array(p));
}

// The page of carlo validate with this report alone.
std::string page_of(const mc::Report& r) {
  const carlo::Case one{r.subject, "", "double", {}};
  const std::vector<const carlo::Case*> cases = {&one};
  const std::vector<mc::Report> reports = {r};
  carlo::ValidationSettings settings;
  settings.command = "libmc.check";
  settings.samples = r.samples;
  settings.alpha = r.alpha;
  return carlo::validation_page({settings, cases, reports});
}

void bind_parts(py::module_& m) {
  py::class_<mc::Check>(m, "Check", "One law or test applied to one subject.")
      .def_readonly("name", &mc::Check::name, "For example 'chi-square, 16 to 63 cells' or 'mass'.")
      .def_property_readonly(
          "verdict", [](const mc::Check& c) { return mc::name(c.verdict); },
          "'pass', 'fail', 'inconclusive' or 'warning'.")
      .def_readonly("p", &mc::Check::p, "p-value of a statistical test; None for a deterministic law.")
      .def_readonly("share", &mc::Check::share, "Share of alpha that a statistical test spends.")
      .def_readonly("statistic", &mc::Check::statistic, "Test statistic, or largest error of a deterministic law.")
      .def_readonly("limit", &mc::Check::limit, "Largest error that a deterministic law allows.")
      .def_property_readonly(
          "fault", [](const mc::Check& c) { return mc::name(c.fault); }, "Likely cause of a failure.")
      .def_readonly("detail", &mc::Check::detail, "One line; empty for a pass.")
      .def("__repr__", [](const mc::Check& c) {
        return fmt::format("<Check {}: {}{}>", c.name, mc::name(c.verdict),
                           c.p ? fmt::format(", p = {:.3g}", *c.p) : std::string());
      });
  py::class_<mc::WorstCell>(m, "WorstCell", "A cell with a count far from the expected count.")
      .def_readonly("lo", &mc::WorstCell::lo, "Lower corner in chart coordinates.")
      .def_readonly("hi", &mc::WorstCell::hi, "Upper corner in chart coordinates.")
      .def_readonly("observed", &mc::WorstCell::observed, "Observed number of samples.")
      .def_readonly("expected", &mc::WorstCell::expected, "Expected number of samples.")
      .def_readonly("z", &mc::WorstCell::z, "(observed - expected) / sqrt(expected).")
      .def_readonly("where", &mc::WorstCell::where, "Centre of the cell as a point of the domain.")
      .def("__repr__", [](const mc::WorstCell& c) {
        return fmt::format("<WorstCell at {}: {} observed, {:.1f} expected>", c.where, c.observed, c.expected);
      });
  py::class_<mc::ReportedValue>(m, "ReportedValue", "A measured quantity without a verdict of its own.")
      .def_readonly("name", &mc::ReportedValue::name, "Name of the quantity.")
      .def_readonly("value", &mc::ReportedValue::value, "Estimate.")
      .def_readonly("std_error", &mc::ReportedValue::std_error, "Its standard error.")
      .def_readonly("where", &mc::ReportedValue::where, "Place or direction; may be empty.")
      .def("__repr__", [](const mc::ReportedValue& v) {
        return fmt::format("<{} {:.6g} +- {:.2g} {}>", v.name, v.value, v.std_error, v.where);
      });
}

} // namespace

void bind_report(py::module_& m) {
  bind_parts(m);
  py::class_<mc::Report>(m, "Report", "All checks of one subject. It is true if the verdict is a pass.")
      .def_readonly("subject", &mc::Report::subject, "Name of the subject.")
      .def_property_readonly(
          "verdict", [](const mc::Report& r) { return mc::name(r.verdict()); }, "'pass', 'fail' or 'inconclusive'.")
      .def_property_readonly("passed", &mc::Report::passed, "Whether the verdict is a pass.")
      .def("__bool__", &mc::Report::passed)
      .def_property_readonly("p", &mc::Report::p, "Adjusted p-value of all statistical tests together.")
      .def_property_readonly(
          "fault", [](const mc::Report& r) { return mc::name(r.fault()); },
          "Likely cause, one word and an explanation.")
      .def_property_readonly("finding", &mc::Report::finding,
                             "Observed value, expected value and place; empty for a pass.")
      .def_readonly("alpha", &mc::Report::alpha, "Family-wise level of the statistical tests.")
      .def_readonly("samples", &mc::Report::samples, "Number of counted samples.")
      .def_readonly("mass", &mc::Report::mass, "Integral of the claimed density.")
      .def_readonly("mass_error", &mc::Report::mass_error, "Error bound of mass.")
      .def_readonly("detectable", &mc::Report::detectable,
                    "Relative error of the density, of random sign from patch to patch, that is detected in 99 of 100 "
                    "runs.")
      .def_readonly("detectable_cell", &mc::Report::detectable_cell, "The same for an error in a single patch.")
      .def_readonly("seconds", &mc::Report::seconds, "Duration of the check [s].")
      .def_readonly("checks", &mc::Report::checks, "List of Checks, in the order of their execution.")
      .def_readonly("worst", &mc::Report::worst, "The five worst cells, worst first.")
      .def_readonly("figures", &mc::Report::figures, "Quantities without a verdict.")
      .def_property_readonly("untried", &mc::Report::untried_text, "Laws that were not tried, with the reasons.")
      .def_property_readonly(
          "axes",
          [](const mc::Report& r) {
            std::vector<std::pair<std::string, std::string>> axes;
            for (const mc::Axis& a : r.axes) axes.emplace_back(a.name, a.unit());
            return axes;
          },
          "Name and unit of each chart coordinate.")
      .def_property_readonly(
          "cells", &cells,
          "Counts as a dict of arrays: observed (m,) and expected (m,) of m cells, with the corners lo and hi (m, dim) "
          "in chart coordinates, and x_lo and x_hi in those of `axes`. Outcomes have no corners.")
      .def_property_readonly("p_after", &p_after, "(samples, p): the p-value after 1024, 2048, ... samples, as arrays.")
      .def(
          "text", [](const mc::Report& r) { return r.to_string(mc::ReportText::full); },
          "Every check that does not pass, the worst cells, and the laws that were not tried.")
      .def(
          "to_json", [](const mc::Report& r) { return carlo::json_text(carlo::to_json(r)); }, "The report as JSON.")
      .def(
          "save_page", [](const mc::Report& r, const PathLike& path) { mc::write_file(path.text(), page_of(r)); },
          arg("path"), "Writes the page of carlo validate, one HTML file with maps of the counts.")
      .def("__repr__", [](const mc::Report& r) { return r.to_string(mc::ReportText::brief, "; text() shows them"); });
}

} // namespace bindings
