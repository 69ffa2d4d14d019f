#include "array_function.h"
#include "domain.h"
#include "module.h"
#include "report.h"
#include "warp.h"

#include <input/check_rows.h>
#include <input/row_shuffler.h>

#include <mc/check/laws.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace bindings {

namespace {

using py::arg;
using Distribution = mc::AnyDistribution;

// Rows of `columns` numbers from arrays of a fixed length.
template <class Numbers> Array to_rows_array(std::span<const Numbers> points, std::size_t columns) {
  Array rows({points.size(), columns});
  for (std::size_t i = 0; i < points.size(); ++i)
    std::copy_n(points[i].begin(), columns, rows.mutable_data() + i * columns);
  return rows;
}

// An array that begins with these numbers.
template <class To> To widened(std::span<const double> from) {
  To to{};
  std::copy(from.begin(), from.end(), to.begin());
  return to;
}

// A user's sample, pdf and perhaps invert. They are called with arrays of points.
struct Functions {
  std::atomic<bool> stop = true; ///< the first KeyboardInterrupt ends the check
  BoundDomain domain;
  std::size_t uniforms;
  std::optional<ArrayFunction> sample, pdf, invert;
  bool may_fail;

  std::size_t columns() const { return static_cast<std::size_t>(domain.any.point_size); }
  bool is_failed(std::span<const double> x) const {
    return may_fail && std::all_of(x.begin(), x.end(), [](double v) { return std::isnan(v); });
  }

  std::vector<double> densities(std::span<const mc::PointArray> x) const {
    if (x.empty()) return {};
    const py::gil_scoped_acquire lock;
    std::vector<double> values(x.size());
    (*pdf)(to_rows_array(x, columns()), values);
    return values;
  }

  std::vector<std::optional<Distribution::Uniforms>> inverses(std::span<const mc::PointArray> x) const {
    if (x.empty()) return {};
    const py::gil_scoped_acquire lock;
    std::vector<double> u(x.size() * uniforms);
    (*invert)(to_rows_array(x, columns()), u);
    std::vector<std::optional<Distribution::Uniforms>> all;
    for (std::size_t i = 0; i < x.size(); ++i)
      all.emplace_back(widened<Distribution::Uniforms>(std::span<const double>(u).subspan(i * uniforms, uniforms)));
    return all;
  }

  std::vector<std::optional<Distribution::Sample>> samples(std::span<const Distribution::Uniforms> u) const {
    if (u.empty()) return {};
    const py::gil_scoped_acquire lock;
    Array x({u.size(), columns()});
    std::vector<double> densities(u.size());
    (*sample)(to_rows_array(u, uniforms), span_of(x));
    (*pdf)(x, densities);
    std::vector<std::optional<Distribution::Sample>> drawn(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) {
      const std::span<const double> row = span_of(std::as_const(x)).subspan(i * columns(), columns());
      if (is_failed(row)) continue;
      Distribution::Sample& s = drawn[i].emplace();
      std::copy(row.begin(), row.end(), s.x.begin());
      s.pdf = densities[i];
    }
    return drawn;
  }
};

Distribution distribution_of(const std::shared_ptr<const Functions>& f) {
  Distribution d;
  d.domain = f->domain.any;
  d.uniforms = static_cast<int>(f->uniforms);
  d.may_fail = f->may_fail;
  d.sample_many = [f](std::span<const Distribution::Uniforms> u) { return f->samples(u); };
  d.sample = [f](const Distribution::Uniforms& u) { return f->samples({&u, 1}).front(); };
  d.pdf_many = [f](std::span<const mc::PointArray> x) { return f->densities(x); };
  d.pdf = [f](const mc::PointArray& x) { return f->densities({&x, 1}).front(); };
  if (f->invert) {
    d.invert_many = [f](std::span<const mc::PointArray> x) { return f->inverses(x); };
    d.invert = [f](const mc::PointArray& x) { return f->inverses({&x, 1}).front(); };
  }
  return d;
}

// Samples of an array with the claimed density.
struct Samples {
  std::shared_ptr<const Functions> functions;
  std::vector<mc::PointArray> points;
  std::vector<double> densities;
};

mc::Subject::Draw draw_of(const Samples& s, std::size_t row) {
  using Kind = mc::Subject::Draw::Kind;
  mc::Subject::Draw d;
  const mc::PointArray& x = s.points[row];
  const mc::AnyDomain& domain = s.functions->domain.any;
  d.pdf_positive = s.densities[row] > 0 && std::isfinite(s.densities[row]);
  const auto coordinates = std::span(x).first(s.functions->columns());
  if (s.functions->is_failed(coordinates)) {
    d.kind = Kind::failed;
    return d;
  }
  if (!std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); })) d.kind = Kind::not_finite;
  else if (!domain.contains(x)) d.kind = Kind::outside;
  if (d.kind != Kind::point) return d;
  d.v = domain.to_unit(x);
  d.density = s.densities[row] * domain.jacobian(d.v);
  return d;
}

mc::Subject subject_of(const std::shared_ptr<const Samples>& s, std::uint64_t seed) {
  mc::Subject subject;
  const mc::AnyDomain& domain = s->functions->domain.any;
  subject.dim = domain.dim;
  subject.axes = domain.axes;
  subject.may_fail = s->functions->may_fail;
  const auto shuffler = std::make_shared<carlo::RowShuffler>(static_cast<std::uint32_t>(s->points.size()), seed);
  subject.draw = [s, shuffler](std::uint64_t stream, std::size_t n, std::vector<mc::Subject::Draw>& out) {
    const std::uint64_t first = shuffler->open(stream, n);
    for (std::size_t k = 0; k < n; ++k) out.push_back(draw_of(*s, shuffler->row(first + k)));
  };
  subject.densities = [s](std::span<const mc::Subject::Coordinates> v, std::span<double> densities) {
    const mc::AnyDomain& on = s->functions->domain.any;
    std::vector<mc::PointArray> x(v.size());
    std::vector<double> jacobians(v.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
      const mc::AnyDomain::DomainPoint p = on.from_unit(v[i]);
      x[i] = p.x;
      jacobians[i] = p.jacobian;
    }
    const std::vector<double> values = s->functions->densities(x);
    for (std::size_t i = 0; i < v.size(); ++i) densities[i] = values[i] * jacobians[i];
  };
  subject.density = [many = subject.densities](const mc::Subject::Coordinates& v) {
    double density = 0;
    many({&v, 1}, {&density, 1});
    return density;
  };
  subject.resolution = [s, epsilon = subject.epsilon](const mc::Subject::Coordinates& v, int axis) {
    return mc::resolution(s->functions->domain.any, epsilon, v, static_cast<std::size_t>(axis));
  };
  subject.describe_draw = [s, shuffler](std::uint64_t stream, std::uint64_t index) {
    const std::uint32_t row = shuffler->row(shuffler->open(stream, 0) + index);
    return fmt::format("row {}: {}, pdf = {:.9g}", row,
                       mc::format_numbers(std::span(s->points[row]).first(s->functions->columns()), 17),
                       s->densities[row]);
  };
  subject.describe_point = [s](const mc::Subject::Coordinates& v) {
    const mc::PointArray x = s->functions->domain.any.from_unit(v).x;
    return mc::format_numbers(std::span(x).first(s->functions->columns()), 6);
  };
  return subject;
}

mc::Report check_array(const std::shared_ptr<const Functions>& f, const py::handle& samples, bool dependent,
                       mc::SubjectOptions options, const std::string& name) {
  const Rows rows = to_rows(samples, f->columns(), "check: samples");
  constexpr std::size_t least = 2000;
  mc::require(rows.count >= least, "check: {} samples; {} or more are needed", rows.count, least);
  mc::require(rows.count < (std::size_t{1} << 32), "check: {} samples; fewer than 2^32 are needed", rows.count);
  const auto all = std::make_shared<Samples>(Samples{f, {}, {}});
  for (std::size_t i = 0; i < rows.count; ++i)
    all->points.push_back(widened<mc::PointArray>(rows.values().subspan(i * rows.columns, rows.columns)));
  all->densities = f->densities(all->points);
  options.samples = rows.count - mc::pilot_samples(rows.count - rows.count / 9);
  mc::Subject subject = subject_of(all, options.seed);
  subject.name = name;
  carlo::OrderedSamples ordered{{}, f->domain.any.axes, f->domain.any.dim};
  for (std::size_t i = 0; i < rows.count; ++i)
    if (const mc::Subject::Draw d = draw_of(*all, i); d.kind == mc::Subject::Draw::Kind::point)
      ordered.points.push_back(d.v);
  const py::gil_scoped_release release;
  return carlo::check_rows(subject, ordered, dependent, options,
                           {"dependent=True", "every n-th row of a Markov chain may be independent, dependent=True "
                                              "accepts a point set"});
}

struct Settings {
  mc::LawOptions laws;
  int uniforms = 0;
  bool may_fail = false, dependent = false;
};

std::string name_of(const py::handle& f) {
  if (!py::hasattr(f, "__name__")) return py::repr(py::type::of(f)).cast<std::string>();
  return py::str(f.attr("__name__")).cast<std::string>();
}

mc::Report run_laws(Distribution d, const mc::LawOptions& laws) {
  d = mc::with_tolerances(std::move(d), laws);
  mc::LawOptions options = laws;
  const std::function<void(std::uint64_t)> check_signals = [](std::uint64_t) {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
  options.statistics.before_draws = &check_signals;
  const py::gil_scoped_release release;
  return mc::check_laws(d, options);
}

mc::Report check(const py::object& sampler, const py::object& pdf, const py::object& domain, const py::object& invert,
                 const Settings& s) {
  mc::require(s.laws.statistics.samples > 0, "check: 0 samples; 1000 or more are needed");
  mc::require(s.uniforms >= 0, "check: uniforms {}; a positive number, or 0 for that of the domain, is needed",
              s.uniforms);
  if (py::isinstance<AnyWarp>(sampler)) {
    mc::require(
        pdf.is_none() && domain.is_none() && invert.is_none(),
        "check: a warp has a pdf, domain and inverse of its own; leave out these arguments, or pass its sample");
    Distribution d = to_distribution(sampler.cast<const AnyWarp&>());
    if (!s.laws.name.empty()) d.name = s.laws.name;
    return run_laws(std::move(d), s.laws);
  }
  mc::require(PyCallable_Check(pdf.ptr()), "check: pdf is {}; a function of an array of points is needed",
              py::repr(pdf).cast<std::string>());
  const auto f = std::make_shared<Functions>();
  f->domain = to_domain(domain);
  f->uniforms = static_cast<std::size_t>(s.uniforms > 0 ? s.uniforms : f->domain.any.dim);
  mc::require(f->uniforms <= Distribution::max_uniforms, "check: uniforms {}; at most {} are supported", f->uniforms,
              Distribution::max_uniforms);
  f->may_fail = s.may_fail;
  f->pdf.emplace(pdf.cast<py::function>(), "check: pdf", f->columns() == 1, f->stop);
  const bool draws = PyCallable_Check(sampler.ptr()) != 0;
  std::string name = s.laws.name;
  if (name.empty()) name = draws ? name_of(sampler) : "samples";
  mc::require(draws || (invert.is_none() && s.uniforms == 0),
              "check: invert and uniforms belong to a function, and the samples are an array; leave them out");
  if (!draws) return check_array(f, sampler, s.dependent, s.laws.statistics, name);
  f->sample.emplace(sampler.cast<py::function>(), "check: sample", f->uniforms == 1, f->stop);
  if (!invert.is_none()) f->invert.emplace(invert.cast<py::function>(), "check: invert", f->columns() == 1, f->stop);
  Distribution d = distribution_of(f);
  d.name = name;
  return run_laws(std::move(d), s.laws);
}

constexpr const char* check_doc = R"(Checks that samples follow the density that they claim.

  check(warp) : a warp of libmc.warps
  check(sample, pdf, domain, invert) : functions of arrays. sample: u (n, d) in [0,1) -> x (n, k); pdf: x (n, k) ->
                (n,); invert, optional: x (n, k) -> u (n, d). With d = 1 or k = 1: (n,).
  check(x, pdf, domain) : an array of samples x (n, k), at least 2000, in the order in which they were drawn
domain is a Domain, its text, or a warp on the same domain: "hemisphere", "x=0:1,y=-1:2".
Options:
  samples = 1000000  : counted samples, where a function draws them
  seed = 1, alpha = 0.001 : alpha is the probability that a right sampler fails, over all tests
  invert_eps = 16    : bound on |invert(sample(u)) - u|, in machine epsilons
  mass_eps = 64      : bound on |mass - 1| beyond the error of quadrature, in machine epsilons
  uniforms = 0       : numbers u for one sample; 0: the dimension of the domain
  may_fail = False   : rows of NaN are failed draws, with the probability 1 - mass
  open_interval = False : accept faults of measure zero
  dependent = False  : an array need not have independent rows
  max_evaluations = 12000000, evidence = True, name
Returns a Report: the verdict, p, the finding and the likely fault, all checks, and the counts as arrays.)";

} // namespace

void bind_check(py::module_& m) {
  bind_report(m);
  const mc::LawOptions usual;
  m.def(
      "check",
      [](const py::object& sampler, const py::object& pdf, const py::object& domain, const py::object& invert,
         std::uint64_t samples, std::uint64_t seed, double alpha, double invert_eps, double mass_eps, int uniforms,
         bool may_fail, bool open_interval, bool dependent, std::size_t max_evaluations, bool evidence,
         const std::string& name) {
        mc::LawOptions laws;
        laws.name = name;
        laws.statistics = {.samples = samples,
                           .seed = seed,
                           .alpha = alpha,
                           .max_evaluations = max_evaluations,
                           .evidence = evidence,
                           .open_interval = open_interval};
        laws.invert_eps = invert_eps;
        laws.mass_eps = mass_eps;
        return check(sampler, pdf, domain, invert, {laws, uniforms, may_fail, dependent});
      },
      arg("sampler"), arg("pdf") = py::none(), arg("domain") = py::none(), arg("invert") = py::none(), py::kw_only(),
      arg("samples") = usual.statistics.samples, arg("seed") = usual.statistics.seed,
      arg("alpha") = usual.statistics.alpha, arg("invert_eps") = usual.invert_eps, arg("mass_eps") = usual.mass_eps,
      arg("uniforms") = 0, arg("may_fail") = false, arg("open_interval") = false, arg("dependent") = false,
      arg("max_evaluations") = usual.statistics.max_evaluations, arg("evidence") = true, arg("name") = "", check_doc);
}

} // namespace bindings
