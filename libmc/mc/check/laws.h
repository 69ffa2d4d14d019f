#pragma once
/// The laws that every warp obeys.

#include <mc/check/check_subject.h>
#include <mc/check/ks_test.h>
#include <mc/check/law_ledger.h>
#include <mc/check/make_subject.h>
#include <mc/check/oracle.h>
#include <mc/check/timing.h>

#include <chrono>

namespace mc {

/// Bounds are those of the warp's contract, in machine epsilons of its scalar.
struct LawOptions {
  std::string name = "warp";
  std::uint64_t samples = 1'000'000; ///< for the counts; 0 leaves the statistical tests out
  std::uint64_t seed = 1;
  double alpha = 0.001;              ///< see SubjectOptions
  std::uint64_t points = 256;        ///< random points of the deterministic laws over the 50-digit oracle
  double invert_eps = 16;            ///< |invert(sample(u)) - u|
  double sample_eps = 16;            ///< |sample(u) - exact|, relative to max(1, |exact|)
  double pdf_eps = 64;               ///< |pdf(x) / exact - 1|
  double mass_eps = 64;              ///< |mass - 1| beyond the bound on the quadrature error
  std::size_t max_evaluations = 12'000'000;
  bool evidence = false;             ///< see SubjectOptions
};

namespace detail {

template <int N> Subject::Coordinates law_point(Pcg& random) {
  Subject::Coordinates u{};
  for (int i = 0; i < N; ++i) u[static_cast<std::size_t>(i)] = random.uniform<double>();
  return u;
}

template <class W> UnitPointOf<W> narrow(const Subject::Coordinates& u) {
  using S = typename W::Scalar;
  const auto one = [](double x) {
    const S s = static_cast<S>(x);
    return s < one_minus_epsilon<S> ? s : one_minus_epsilon<S>;
  };
  if constexpr (W::Domain::dim == 1) return one(u[0]);
  else {
    UnitPointOf<W> p;
    for (int i = 0; i < W::Domain::dim; ++i) p[i] = one(u[static_cast<std::size_t>(i)]);
    return p;
  }
}

template <class P> double distance(const P& a, const P& b) {
  if constexpr (requires { a.norm(); }) return static_cast<double>((a - b).norm());
  else return std::abs(static_cast<double>(a - b));
}

template <class P> double magnitude(const P& a) {
  if constexpr (requires { a.norm(); }) return static_cast<double>(a.norm());
  else return std::abs(static_cast<double>(a));
}

/// sample and pdf at the ends and the middle of the unit cube.
template <Warp W> void edge_law(const W& warp, LawLedger& ledger) {
  constexpr int dim = W::Domain::dim;
  const double last = static_cast<double>(one_minus_epsilon<typename W::Scalar>);
  const std::array<double, 5> places{0, 0x1p-24, 0.5, 1 - 0x1p-24, last};
  int total = 1;
  for (int i = 0; i < dim; ++i) total *= static_cast<int>(places.size());
  for (int k = 0; k < total; ++k) {
    Subject::Coordinates c{};
    for (int i = 0, rest = k; i < dim; ++i, rest /= 5) c[static_cast<std::size_t>(i)] = places[static_cast<std::size_t>(rest % 5)];
    const auto u = narrow<W>(c);
    const auto x = warp.sample(u);
    const double density = static_cast<double>(warp.pdf(x));
    const bool finite = all_finite(x), inside = finite && warp.domain().contains(x), positive = density > 0 && std::isfinite(density);
    ledger.note(finite && inside && positive ? 0 : 1, [&] {
      return fmt::format("{} at u = {}: x = {}, pdf = {:.9g}", !finite ? "not finite" : !inside ? "outside the domain" : "pdf not positive and finite",
                         format_point(u), format_point(x), density);
    });
  }
}

/// invert(sample(u)) = u.
template <InvertibleWarp W> void inverse_law(const W& warp, std::uint64_t seed, LawLedger& ledger) {
  using S = typename W::Scalar;
  constexpr int dim = W::Domain::dim;
  const double eps = static_cast<double>(std::numeric_limits<S>::epsilon());
  Pcg random(seed, 11);
  for (int k = 0; k < 20000; ++k) {
    const auto u = narrow<W>(law_point<dim>(random));
    const auto x = warp.sample(u);
    const auto back = warp.invert(x);
    double worst = 0;
    for (int i = 0; i < dim; ++i) {
      double off = std::abs(component(back, i) - component(u, i));
      // The two sides of an azimuth's seam are one point.
      if (off > 0.5 && distance(warp.sample(back), x) <= 64 * eps * std::max(1.0, magnitude(x))) off = 1 - off;
      worst = off <= worst ? worst : off;
    }
    ledger.note(worst / eps, [&] { return fmt::format("u = {}, invert(sample(u)) = {}", format_point(u), format_point(back)); });
  }
}

/// |det d sample / d u| pdf = 1, by central differences over the oracle.
template <InvertibleWarp W> void jacobian_law(const W& oracle, std::uint64_t points, std::uint64_t seed, LawLedger& ledger) {
  using S = typename W::Scalar;
  constexpr int dim = W::Domain::dim;
  const auto domain = oracle.domain();
  const S h(1e-20);
  Pcg random(seed, 12);
  for (std::uint64_t k = 0; k < points; ++k) {
    const Subject::Coordinates c = law_point<dim>(random);
    const auto u = narrow<W>(c);
    const auto chart = [&](int axis, const S& step) {
      auto shifted = u;
      if constexpr (dim == 1) shifted = u + step;
      else shifted[axis] += step;
      return domain.to_unit(oracle.sample(shifted));
    };
    S determinant;
    if constexpr (dim == 1) {
      determinant = (chart(0, h) - chart(0, S(-h))) / (2 * h);
    } else {
      Eigen::Matrix<S, dim, dim> jacobian;
      for (int axis = 0; axis < dim; ++axis) {
        const auto ahead = chart(axis, h), behind = chart(axis, S(-h));
        for (int i = 0; i < dim; ++i) jacobian(i, axis) = (ahead[i] - behind[i]) / (2 * h);
      }
      if constexpr (dim == 2) determinant = jacobian(0, 0) * jacobian(1, 1) - jacobian(0, 1) * jacobian(1, 0);
      else
        determinant = jacobian(0, 0) * (jacobian(1, 1) * jacobian(2, 2) - jacobian(1, 2) * jacobian(2, 1)) -
                      jacobian(0, 1) * (jacobian(1, 0) * jacobian(2, 2) - jacobian(1, 2) * jacobian(2, 0)) +
                      jacobian(0, 2) * (jacobian(1, 0) * jacobian(2, 1) - jacobian(1, 1) * jacobian(2, 0));
    }
    const auto x = oracle.sample(u);
    const S product = determinant * S(oracle.pdf(x)) * S(domain.jacobian(domain.to_unit(x)));
    const double off = std::abs(static_cast<double>(S((product < 0 ? S(-product) : product) - 1)));
    ledger.note(off, [&] { return fmt::format("|det| pdf - 1 = {:.3g} at u = ({:.17g}, {:.17g}, {:.17g})", off, c[0], c[1], c[2]); });
  }
}

/// sample and pdf of the warp against the oracle, in epsilons.
template <Warp W, Warp O> void precision_laws(const W& warp, const O& oracle, std::uint64_t points, std::uint64_t seed, LawLedger& sample, LawLedger& pdf) {
  using S = typename W::Scalar;
  using T = typename O::Scalar;
  constexpr int dim = W::Domain::dim;
  const double eps = static_cast<double>(std::numeric_limits<S>::epsilon());
  Pcg random(seed, 13);
  for (std::uint64_t k = 0; k < points; ++k) {
    const auto u = narrow<W>(law_point<dim>(random));
    const auto x = warp.sample(u);
    const auto exact = oracle.sample(cast_point<T>(u));
    const double off = distance(cast_point<T>(x), exact) / std::max(1.0, magnitude(exact)) / eps;
    sample.note(off, [&] { return fmt::format("{:.3g} eps at u = {}: x = {}", off, format_point(u), format_point(x)); });
    const T density = oracle.pdf(cast_point<T>(x));
    // Rounding may carry x across the edge of the support, where the two sides differ and both are right.
    if (!(density > 0)) continue;
    const double ratio = static_cast<double>(T(T(warp.pdf(x)) / density)), wrong = std::abs(ratio - 1) / eps;
    pdf.note(wrong, [&] { return fmt::format("{:.3g} eps at x = {}: pdf = {:.9g}", wrong, format_point(x), static_cast<double>(warp.pdf(x))); });
  }
}

} // namespace detail

/// Checks one warp; each law is one Check of the report.
///   edges     : at u in {0, 2^-24, 1/2, 1 - 2^-24, 1 - ulp}^d: sample finite and in the domain, pdf positive and finite
///   invert    : invert(sample(u)) = u at 20000 random u, within invert_eps         (InvertibleWarp)
///   jacobian  : |det d sample / d u| pdf = 1 to 1e-20 over 50 digits               (InvertibleWarp)
///   precision : sample and pdf against the 50-digit oracle, within sample_eps and pdf_eps
///   and everything that check_subject does: per-sample laws, mass, chi-squares, tails, KS, cells
template <Warp W> Report check_laws(const W& warp, const LawOptions& options = {}) {
  const auto start = std::chrono::steady_clock::now();
  Report report;
  if (options.samples > 0) {
    Subject subject = make_subject(options.name, warp);
    subject.mass_tolerance = options.mass_eps * static_cast<double>(std::numeric_limits<typename W::Scalar>::epsilon());
    SubjectOptions o;
    o.samples = options.samples, o.seed = options.seed, o.alpha = options.alpha, o.max_evaluations = options.max_evaluations, o.evidence = options.evidence;
    report = check_subject(subject, o);
  } else {
    report.subject = options.name;
    report.alpha = options.alpha;
  }
  std::vector<Check> laws;
  const auto close = [&](LawLedger& ledger) { laws.push_back(ledger.check()); };

  LawLedger edges("edges of the unit cube", 0, Fault::edge);
  detail::edge_law(warp, edges);
  close(edges);
  const auto oracle = warp.template cast<Oracle>();
  if constexpr (InvertibleWarp<W>) {
    LawLedger inverse("invert(sample(u)) = u [eps]", options.invert_eps, Fault::inverse);
    detail::inverse_law(warp, options.seed, inverse);
    close(inverse);
    LawLedger jacobian("|det| pdf = 1", 1e-20, Fault::jacobian);
    detail::jacobian_law(oracle, options.points / 4, options.seed, jacobian);
    close(jacobian);
  }
  LawLedger sample("sample against 50 digits [eps]", options.sample_eps, Fault::precision);
  LawLedger pdf("pdf against 50 digits [eps]", options.pdf_eps, Fault::precision);
  detail::precision_laws(warp, oracle, options.points, options.seed, sample, pdf);
  close(sample);
  close(pdf);

  report.checks.insert(report.checks.begin(), laws.begin(), laws.end());
  std::vector<UnitPointOf<W>> u;
  Pcg random(3);
  for (int i = 0; i < timing_inputs; ++i) u.push_back(random.point<typename W::Scalar, W::Domain::dim>());
  report.ns_per_sample = ns_per_sample(u, [&](const UnitPointOf<W>& v) { return detail::component(warp.sample(v), 0); });
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

} // namespace mc
