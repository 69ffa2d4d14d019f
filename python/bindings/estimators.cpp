#include "arrays.h"
#include "contracts.h"
#include "module.h"

#include <mc/estimate/control_variate.h>
#include <mc/estimate/mis.h>

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace bindings {

namespace {

using py::arg;
using Heuristic = mc::Heuristic<double>;

Heuristic heuristic_of(const std::string& name, double beta, double alpha) {
  if (name == "balance") return Heuristic::balance();
  if (name == "power") return Heuristic::power(beta);
  if (name == "cutoff") return Heuristic::cutoff(alpha);
  mc::require(name == "maximum", "weights: heuristic '{}' must be balance, power, cutoff or maximum", name);
  return Heuristic::maximum();
}

// `what` begins the message, as in "a density of".
void require_densities(std::span<const double> values, const std::string& what) {
  for (const double one : values) mc::require(one >= 0, "{} {}; it must be >= 0", what, one);
}
void require_counts(std::span<const double> values, const std::string& what) {
  for (const double one : values)
    mc::require(one >= 0 && std::isfinite(one), "{} {}; it must be finite and >= 0", what, one);
}

Array weights(const ArrayLike& densities, const py::object& counts, const std::string& name, double beta,
              double alpha) {
  const Array p = to_array(densities, "weights: densities");
  mc::require(p.ndim() >= 1 && p.shape(p.ndim() - 1) >= 1,
              "weights: densities of shape {}; the shape must be (..., k) for k techniques", shape_text(p));
  const auto k = static_cast<std::size_t>(p.shape(p.ndim() - 1));
  std::vector<double> n(k, 1.0);
  if (!counts.is_none()) {
    const Array given = to_array(counts, "weights: counts");
    mc::require(static_cast<std::size_t>(given.size()) == k, "weights: {} counts for {} techniques", given.size(), k);
    std::copy_n(given.data(), k, n.begin());
  }
  require_densities(span_of(p), "weights: a density of");
  require_counts(n, "weights: a count of");
  const Heuristic heuristic = heuristic_of(name, beta, alpha);
  Array w(std::vector<py::ssize_t>(p.shape(), p.shape() + p.ndim()));
  for (std::size_t row = 0; row < static_cast<std::size_t>(p.size()); row += k)
    for (std::size_t i = 0; i < k; ++i)
      w.mutable_data()[row + i] = mc::mis_weight<double>(i, span_of(std::as_const(p)).subspan(row, k), n, heuristic);
  return w;
}

template <double (*F)(double, double, double, double)> void bind_heuristic(py::module_& m, const char* name) {
  m.def(
      name,
      [name = std::string(name)](const ArrayLike& f, const ArrayLike& g, const ArrayLike& n_f, const ArrayLike& n_g) {
        const Array of_f = to_array(f, name + ": f"), of_g = to_array(g, name + ": g"),
                    count_f = to_array(n_f, name + ": n_f"), count_g = to_array(n_g, name + ": n_g");
        require_densities(span_of(of_f), name + ": f is");
        require_densities(span_of(of_g), name + ": g is");
        require_counts(span_of(count_f), name + ": n_f is");
        require_counts(span_of(count_g), name + ": n_g is");
        try {
          py::module_::import("numpy").attr("broadcast_shapes")(of_f.attr("shape"), of_g.attr("shape"),
                                                                count_f.attr("shape"), count_g.attr("shape"));
        } catch (const py::error_already_set&) {
          throw mc::Error(fmt::format("{}: arrays of shapes {}, {}, {} and {} cannot be broadcast", name,
                                      shape_text(of_f), shape_text(of_g), shape_text(count_f), shape_text(count_g)));
        }
        using Arg = py::array_t<double>;
        return py::vectorize(F)(Arg(count_f), Arg(of_f), Arg(count_g), Arg(of_g));
      },
      arg("f"), arg("g"), arg("n_f") = 1.0, arg("n_g") = 1.0,
      (contract(name) + "\n\nArrays are broadcast. f, g: densities; n_f, n_g: numbers of samples.").c_str());
}

void bind_mis(py::module_& parent) {
  py::module_ m = parent.def_submodule("mis", "Multiple importance sampling: weights of techniques.");
  bind_heuristic<&mc::balance_heuristic<double>>(m, "balance_heuristic");
  bind_heuristic<&mc::power_heuristic<double>>(m, "power_heuristic");
  m.def("weights", &weights, arg("densities"), arg("counts") = py::none(), arg("heuristic") = "balance",
        arg("beta") = 2.0, arg("alpha") = 0.0,
        R"(Weights of k techniques from their densities at a sample: densities (..., k) -> (..., k).

counts (k,) are the numbers of samples, by default 1. heuristic is balance, power (with beta), cutoff (with alpha) or
maximum. All densities must refer to the same measure. The weights of a sample sum to 1; densities of 0 give 0.)");
}

// An estimate as numbers of Python.
py::tuple to_tuple(const mc::Estimate& e) { return py::make_tuple(e.value, e.std_error); }

void add(mc::ControlVariates& c, std::size_t controls, const ArrayLike& f, const ArrayLike& g) {
  const Array values = to_array(f, "ControlVariates: f");
  const Rows rows = to_rows(g, controls, "ControlVariates: g");
  mc::require(values.ndim() == 1, "ControlVariates: f of shape {}; the shape must be (n,)", shape_text(values));
  mc::require(rows.count == static_cast<std::size_t>(values.size()),
              "ControlVariates: {} values of f and {} of the controls; as many are needed", values.size(), rows.count);
  const std::uint64_t first = c.count() + c.non_finite_count();
  for (std::size_t i = 0; i < rows.count; ++i)
    c.add(values.data()[i], rows.values().subspan(i * controls, controls), first + i);
}

struct Controls {
  mc::ControlVariates moments;
  std::size_t count;
};

void bind_control_variates(py::module_& m) {
  py::class_<Controls>(m, "ControlVariates", contract("ControlVariates").c_str())
      .def(py::init([](const std::vector<double>& means) {
             return Controls{mc::ControlVariates(means), means.size()};
           }),
           arg("means"), "Controls with the known means (k,).")
      .def(
          "add", [](Controls& c, const ArrayLike& f, const ArrayLike& g) { add(c.moments, c.count, f, g); }, arg("f"),
          arg("g"), "Adds samples: values f (n,) and values of the controls g (n, k), or (n,) for one control.")
      .def(
          "merge", [](Controls& c, const Controls& other) { c.moments.merge(other.moments); }, arg("other"),
          "Adds the samples of another object with the same means.")
      .def("__len__", [](const Controls& c) { return c.moments.count(); })
      .def(
          "coefficients", [](const Controls& c) { return new_array(c.moments.coefficients()); },
          "Coefficients (k,) of least variance. Apply them to other samples.")
      .def(
          "estimate",
          [](const Controls& c, const ArrayLike& beta) {
            const Array coefficients = to_array(beta, "ControlVariates: beta");
            return to_tuple(c.moments.estimate(span_of(coefficients)));
          },
          arg("beta"), "(value, std_error) with the coefficients beta (k,).")
      .def(
          "without_controls", [](const Controls& c) { return to_tuple(c.moments.without_controls()); },
          "(value, std_error) without controls.")
      .def("__repr__", [](const Controls& c) {
        return fmt::format("<ControlVariates: {} controls, {} samples>", c.count, c.moments.count());
      });
  m.def(
      "cross_fitted_estimate",
      [](const Controls& a, const Controls& b) { return to_tuple(mc::cross_fitted_estimate(a.moments, b.moments)); },
      arg("a"), arg("b"), (contract("cross_fitted_estimate") + "\n\nReturns (value, std_error).").c_str());
}

} // namespace

void bind_estimators(py::module_& m) {
  bind_mis(m);
  bind_control_variates(m);
}

} // namespace bindings
