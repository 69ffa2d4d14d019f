#include "array_function.h"
#include "contracts.h"
#include "domain.h"
#include "module.h"
#include "warp.h"

#include <integrands/box_map.h>

#include <mc/estimate/adapt/density_file.h>
#include <mc/estimate/integrate.h>
#include <mc/estimate/point_set.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace bindings {

namespace {

using py::arg;

// Points of a domain for points of the unit cube, `count` at a time. `factors` are |dx/du|, or densities to divide by.
struct PointMap {
  std::size_t uniforms, columns;
  bool is_flat = false; ///< arrays of points have the shape (n,)
  bool divides = false; ///< the factors are densities
  std::function<void(std::size_t count, const double* u, double* x, double* factors)> map;
};

PointMap map_of(const AnyWarp& w) {
  return {w.uniforms(), w.coordinates(), w.coordinates() == 1, true,
          [w](std::size_t count, const double* u, double* x, double* factors) {
            w.sample(w.held.get(), count, u, x);
            w.pdf(w.held.get(), count, x, factors);
          }};
}

PointMap map_of(const BoundDomain& d) {
  const auto dim = static_cast<std::size_t>(d.any.dim), size = static_cast<std::size_t>(d.any.point_size);
  return {dim, size, size == 1, false,
          [d = d.any, dim, size](std::size_t count, const double* u, double* x, double* factors) {
            for (std::size_t i = 0; i < count; ++i) {
              mc::AnyDomain::Coordinates v{};
              std::copy_n(u + i * dim, dim, v.begin());
              const mc::AnyDomain::DomainPoint p = d.from_unit(v);
              std::copy_n(p.x.begin(), size, x + i * size);
              factors[i] = p.jacobian;
            }
          }};
}

PointMap map_of(const Array& bounds) {
  const bool is_flat = bounds.ndim() == 1;
  mc::require((is_flat ? bounds.size() == 2 : bounds.ndim() == 2 && bounds.shape(1) == 2) && bounds.size() > 0,
              "domain: bounds of shape {}; (lo, hi), or a list of pairs (lo, hi), is needed", shape_text(bounds));
  std::vector<carlo::VariableBounds> sides;
  for (py::ssize_t i = 0; i < bounds.size() / 2; ++i) {
    const double lo = bounds.data()[2 * i], hi = bounds.data()[2 * i + 1];
    mc::require(lo < hi, "domain: coordinate {} has the bounds {} and {}; lo < hi is needed", i, lo, hi);
    sides.push_back({fmt::format("x{}", i), lo, hi});
  }
  const std::size_t dim = sides.size();
  return {dim, dim, is_flat, false,
          [box = carlo::BoxMap(std::move(sides)), dim](std::size_t count, const double* u, double* x, double* factors) {
            for (std::size_t i = 0; i < count; ++i)
              factors[i] = box.map(std::span(u + i * dim, dim), std::span(x + i * dim, dim));
          }};
}

PointMap map_of(std::int64_t dim) {
  mc::require(dim >= 1, "domain: a unit cube of {} dimensions; one or more are needed", dim);
  const auto d = static_cast<std::size_t>(dim);
  return {d, d, false, false, [d](std::size_t count, const double* u, double* x, double* factors) {
            std::copy_n(u, count * d, x);
            std::fill_n(factors, count, 1.0);
          }};
}

PointMap to_point_map(const py::handle& domain) {
  if (py::isinstance<AnyWarp>(domain)) return map_of(domain.cast<const AnyWarp&>());
  if (py::isinstance<BoundDomain>(domain) || py::isinstance<py::str>(domain)) return map_of(to_domain(domain));
  if (py::isinstance<py::int_>(domain) || py::isinstance(domain, py::module_::import("numpy").attr("integer")))
    return map_of(domain.cast<std::int64_t>());
  return map_of(to_array(domain, "domain"));
}

// A function of Python as an integrand over the unit cube.
class Integrand {
 public:
  Integrand(const py::function& f, PointMap points, std::atomic<bool>& cancel)
      : points_(std::move(points)), f_(f, "integrate: f", points_.is_flat, cancel) {}

  // Calls f at two points to learn the number of its outputs.
  std::optional<std::size_t> count_outputs() const {
    std::vector<double> u(2 * points_.uniforms), factors(2);
    mc::fill_points(mc::Independent{1}, 0, static_cast<int>(points_.uniforms), u);
    Array x({py::ssize_t{2}, static_cast<py::ssize_t>(points_.columns)});
    points_.map(2, u.data(), x.mutable_data(), factors.data());
    return f_.count_outputs(x);
  }

  void operator()(std::span<const double> u, std::span<double> values) const {
    const std::size_t count = u.size() / points_.uniforms, outputs = values.size() / count;
    std::vector<double> factors(count);
    const py::gil_scoped_acquire lock;
    Array x({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(points_.columns)});
    points_.map(count, u.data(), x.mutable_data(), factors.data());
    f_(x, values);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double factor = factors[i / outputs];
      if (!points_.divides) values[i] *= factor;
      else if (values[i] != 0) values[i] /= factor;
    }
  }

  int dim() const { return static_cast<int>(points_.uniforms); }

 private:
  PointMap points_;
  ArrayFunction f_;
};

// Calls progress(value, std_error, calls, seconds).
std::function<void(const mc::IntegrateProgress&)> progress_of(const py::object& progress, std::atomic<bool>& cancel) {
  if (progress.is_none()) return {};
  return [&progress, &cancel](const mc::IntegrateProgress& p) {
    const py::gil_scoped_acquire lock;
    call_interruptible(cancel, [&] { progress(p.estimate.value, p.estimate.std_error, p.calls, p.seconds); });
  };
}

py::object integrate(const py::function& f, const py::handle& domain, mc::IntegrateOptions options,
                     const py::object& progress) {
  std::atomic<bool> cancel = false;
  options.cancel = &cancel;
  options.progress = progress_of(progress, cancel);
  const Integrand integrand(f, to_point_map(domain), cancel);
  const std::optional<std::size_t> outputs = integrand.count_outputs();
  // Many points, for a call of Python is dear; fewer in many dimensions, for memory.
  constexpr std::size_t most_points = 4096, most_coordinates = 1 << 20;
  const mc::BatchIntegrand batch{[&](std::span<const double> u, std::span<double> v) { integrand(u, v); },
                                 std::min(most_points, most_coordinates / static_cast<std::size_t>(integrand.dim()))};
  try {
    mc::VectorIntegral several;
    mc::Integral one;
    {
      const py::gil_scoped_release release;
      if (outputs) several = mc::integrate_unit(batch, static_cast<int>(*outputs), integrand.dim(), options);
      else one = mc::integrate_unit(batch, integrand.dim(), options);
    }
    return outputs ? py::cast(std::move(several)) : py::cast(std::move(one));
  } catch (const mc::Error&) {
    if (!cancel) throw;
    PyErr_SetString(PyExc_KeyboardInterrupt, "integrate: interrupted before the first estimate");
    throw py::error_already_set();
  }
}

constexpr const char* integrate_doc = R"(Integral of f over a domain, with a confidence interval.

  integrate(lambda x: numpy.exp(-x[:, 0]**2) * numpy.cos(x[:, 1]), [(0, 1), (-1, 2)])

f      : a function of an array x of points: (n, d) -> (n,), or (n, k) for k integrals of the same evaluations. It is
         called with up to 4096 points at a time, and with two points first.
domain : a list of d pairs (lo, hi), which may be infinite; an integer d for the unit cube; a Domain, or its text; a
         warp, which then draws the points: the integral over its domain, importance-sampled; f must be 0 where
         the density of the warp is 0. With a single pair (lo, hi), or a domain or warp of scalars, x has the shape
         (n,).
Options, with the defaults of C++:
  rel_error = 1e-3, abs_error = 0 : stop when std_error <= rel_error |value|, or <= abs_error
  max_calls = 1000000, min_calls = 10000 : limits of the number of points
  method = "auto" : plain, stratified, rqmc, vegas or tree; auto selects during the run
  seed = 1, confidence = 0.95, replicates = 16, call_ns = 20 (time of f for one point [ns])
  threads = 1     : threads that call f; more pay only where f releases the interpreter's lock
  density = None  : the density of an earlier Integral, to go on from
  auxiliary_outputs = 0 : the last outputs that affect neither stopping nor adaptation
  progress = None : called with (value, std_error, calls, seconds) after each round
Returns an Integral, or a VectorIntegral if f returns (n, k). Ctrl-C ends the run and returns what is known, with
stop = "cancelled"; before the first estimate it raises KeyboardInterrupt. Raises NotFiniteError where f is NaN.)";

std::string name_of(const mc::Integral& r) { return r.to_string(); }

void bind_round(py::module_& m) {
  py::class_<mc::IntegrateRound>(m, "Round", "Diagnostics of one round of a run.")
      .def_property_readonly(
          "method", [](const mc::IntegrateRound& r) { return mc::name(r.method); }, "Its method.")
      .def_readonly("learning", &mc::IntegrateRound::learning, "Whether a density was learned or tested with it.")
      .def_readonly("calls", &mc::IntegrateRound::calls, "Evaluations of the whole run so far.")
      .def_property_readonly(
          "value", [](const mc::IntegrateRound& r) { return r.estimate.value; }, "Estimate after it.")
      .def_property_readonly(
          "std_error", [](const mc::IntegrateRound& r) { return r.estimate.std_error; }, "Standard error after it.")
      .def_property_readonly(
          "error_bar", [](const mc::IntegrateRound& r) { return mc::name(r.error_bar); }, "Error bar after it.")
      .def_readonly("chi2", &mc::IntegrateRound::chi2, "Its part of Integral.chi2.")
      .def("__repr__", [](const mc::IntegrateRound& r) {
        return fmt::format("<Round: {} calls by {}, {:.6g} +- {:.2g}>", r.calls, mc::name(r.method), r.estimate.value,
                           r.estimate.std_error);
      });
}

void bind_integral(py::module_& m) {
  py::class_<mc::Integral>(m, "Integral",
                           "Integral with its error bar and the history of the run. float() is its value.")
      .def_property_readonly(
          "value", [](const mc::Integral& r) { return r.estimate.value; }, "Estimate.")
      .def_property_readonly(
          "std_error", [](const mc::Integral& r) { return r.estimate.std_error; },
          "Standard error: half the width of the 68.27 % interval; infinite unless error_bar is 'known'.")
      .def_property_readonly(
          "dof", [](const mc::Integral& r) { return r.estimate.dof; },
          "Degrees of freedom of std_error, or 0 if it is exact.")
      .def_property_readonly(
          "interval", [](const mc::Integral& r) { return std::pair(r.interval.lo, r.interval.hi); },
          "Two-sided confidence interval (lo, hi) at `confidence`.")
      .def_readonly("confidence", &mc::Integral::confidence, "Confidence level of the interval.")
      .def_property_readonly(
          "error_bar", [](const mc::Integral& r) { return mc::name(r.error_bar); },
          "'known' if std_error is valid; else the reason: all_zero, undersampled, too_few_points, infinite_variance "
          "or "
          "not_integrable.")
      .def_property_readonly(
          "stop", [](const mc::Integral& r) { return mc::name(r.stop); },
          "Reason for the end: converged, max_calls or cancelled.")
      .def_property_readonly(
          "converged", [](const mc::Integral& r) { return r.stop == mc::StopReason::converged; },
          "Whether a tolerance was reached.")
      .def_property_readonly(
          "method", [](const mc::Integral& r) { return mc::name(r.method); }, "Method.")
      .def_readonly("calls", &mc::Integral::calls, "Number of points.")
      .def_readonly("seconds", &mc::Integral::seconds, "Wall time [s].")
      .def_readonly("constant", &mc::Integral::constant, "All values of f were equal.")
      .def_readonly("tail_index", &mc::Integral::tail_index, "Tail index of the values; infinite unless it is heavy.")
      .def_readonly("infinite_points", &mc::Integral::infinite_points, "Points where f was infinite; they count as 0.")
      .def_readonly("chi2", &mc::Integral::chi2, "Agreement of independent rounds; near chi2_dof if they agree.")
      .def_readonly("chi2_dof", &mc::Integral::chi2_dof, "Degrees of freedom of chi2.")
      .def_readonly("consistent", &mc::Integral::consistent,
                    "Whether the rounds agree; if not, distrust the error bar.")
      .def_readonly("rounds", &mc::Integral::rounds, "List of Rounds.")
      .def_property_readonly(
          "density",
          [](const mc::Integral& r) { return std::optional(std::const_pointer_cast<mc::AdaptedDensity>(r.density)); },
          "Density that was learned, or None.")
      .def("__float__", [](const mc::Integral& r) { return r.estimate.value; })
      .def("__repr__", &name_of);
}

void bind_vector_integral(py::module_& m) {
  py::class_<mc::VectorIntegral>(m, "VectorIntegral", "Several integrals from the same evaluations.")
      .def_readonly("outputs", &mc::VectorIntegral::outputs, "List of Integrals.")
      .def_property_readonly(
          "correlation",
          [](const mc::VectorIntegral& r) {
            const auto k = static_cast<py::ssize_t>(r.outputs.size());
            return new_array(r.correlations, {k, k});
          },
          "Correlation matrix of the errors (k, k).")
      .def_property_readonly(
          "covariance",
          [](const mc::VectorIntegral& r) {
            const std::size_t k = r.outputs.size();
            Array c({k, k});
            for (std::size_t i = 0; i < k; ++i)
              for (std::size_t j = 0; j < k; ++j) c.mutable_data()[i * k + j] = r.covariance(i, j);
            return c;
          },
          "Covariance matrix of the errors (k, k); not finite where an error is unknown.")
      .def("__len__", [](const mc::VectorIntegral& r) { return r.outputs.size(); })
      .def("__getitem__",
           [](const mc::VectorIntegral& r, std::size_t i) {
             if (i >= r.outputs.size()) throw py::index_error();
             return r.outputs[i];
           })
      .def("__repr__", [](const mc::VectorIntegral& r) {
        std::string text;
        for (const mc::Integral& one : r.outputs) text += (text.empty() ? "" : "\n") + name_of(one);
        return text;
      });
}

Array density_at(const mc::AdaptedDensity& d, const ArrayLike& x) {
  const Rows rows = to_rows(x, static_cast<std::size_t>(d.dim()), "pdf: x", true);
  require_unit(rows, "pdf: x");
  Array density = new_rows(rows.outer, 1);
  std::vector<double> scratch(rows.columns);
  for (std::size_t i = 0; i < rows.count; ++i)
    density.mutable_data()[i] = d.density(rows.values().subspan(i * rows.columns, rows.columns), scratch);
  return density;
}

py::tuple sample_density(const mc::AdaptedDensity& d, const ArrayLike& u) {
  const Rows rows = to_rows(u, static_cast<std::size_t>(d.dim()), "sample: u", true);
  require_unit(rows, "sample: u");
  Array x = new_array(rows.values(), {rows.array.shape(), rows.array.shape() + rows.array.ndim()});
  Array density = new_rows(rows.outer, 1);
  for (std::size_t i = 0; i < rows.count; ++i)
    density.mutable_data()[i] = 1 / d.map(span_of(x).subspan(i * rows.columns, rows.columns));
  return py::make_tuple(x, density);
}

void bind_density(py::module_& m) {
  py::class_<mc::AdaptedDensity, std::shared_ptr<mc::AdaptedDensity>>(
      m, "AdaptedDensity", "Density on the unit cube that a run learned. It can be pickled.")
      .def_property_readonly("dim", &mc::AdaptedDensity::dim, "Number of dimensions.")
      .def("sample", &sample_density, arg("u"), "u (..., dim) -> points x (..., dim) and their densities (...).")
      .def("pdf", &density_at, arg("x"), "Density at points of the unit cube: x (..., dim) -> (...).")
      .def(
          "save", [](const mc::AdaptedDensity& d, const PathLike& path) { mc::save_density(path.text(), d); },
          arg("path"), "Writes it to a file, for load_density and carlo integrate --load-density.")
      .def(py::pickle(
          [](const mc::AdaptedDensity& d) { return mc::to_text(d); },
          [](const std::string& text) { return std::make_shared<mc::AdaptedDensity>(mc::density_from_text(text)); }))
      .def("__repr__", [](const mc::AdaptedDensity& d) {
        return fmt::format("<AdaptedDensity: {} dimensions{}>", d.dim(), d.tree ? ", with a tree" : "");
      });
  m.def(
      "load_density",
      [](const PathLike& path) { return std::make_shared<mc::AdaptedDensity>(mc::load_density(path.text())); },
      arg("path"), "Reads a density that AdaptedDensity.save or carlo integrate --save-density wrote.");
}

} // namespace

void bind_integrate(py::module_& m) {
  bind_density(m);
  bind_round(m);
  bind_integral(m);
  bind_vector_integral(m);
  const mc::IntegrateOptions usual;
  m.def(
      "integrate",
      [](const py::function& f, const py::object& domain, double rel_error, double abs_error, std::uint64_t max_calls,
         std::uint64_t min_calls, const std::string& method, std::uint64_t seed, int threads, double confidence,
         std::uint32_t replicates, double call_ns, const std::shared_ptr<mc::AdaptedDensity>& density,
         std::size_t auxiliary_outputs, const py::object& progress) {
        mc::IntegrateOptions o;
        o.rel_error = rel_error;
        o.abs_error = abs_error;
        o.max_calls = max_calls;
        o.min_calls = min_calls;
        o.method = mc::parse_method(method);
        o.seed = seed;
        o.threads = threads;
        o.confidence = confidence;
        o.replicates = replicates;
        o.call_ns = call_ns;
        o.density = density;
        o.auxiliary_outputs = auxiliary_outputs;
        return integrate(f, domain, o, progress);
      },
      arg("f"), arg("domain"), py::kw_only(), arg("rel_error") = usual.rel_error, arg("abs_error") = usual.abs_error,
      arg("max_calls") = usual.max_calls, arg("min_calls") = usual.min_calls, arg("method") = mc::name(usual.method),
      arg("seed") = usual.seed, arg("threads") = 1, arg("confidence") = usual.confidence,
      arg("replicates") = usual.replicates, arg("call_ns") = usual.call_ns, arg("density") = py::none(),
      arg("auxiliary_outputs") = 0, arg("progress") = py::none(), integrate_doc);
}

} // namespace bindings
