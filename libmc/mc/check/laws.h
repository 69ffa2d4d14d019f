#pragma once
/// The laws that every warp obeys.

#include <mc/check/check_subject.h>
#include <mc/check/fit/find_breaks.h>
#include <mc/check/laws/law_ledger.h>
#include <mc/check/laws/oracle.h>
#include <mc/check/laws/timing.h>
#include <mc/check/subject/make_subject.h>
#include <mc/stats/ks_test.h>

#include <chrono>
#include <functional>

namespace mc {

/// Bounds are those of the warp's contract, in machine epsilons of its scalar.
struct LawOptions {
  std::string name = "warp";
  std::uint64_t samples = 1'000'000; ///< for the counts; 0 leaves the statistical tests out
  std::uint64_t seed = 1;
  double alpha = 0.001;       ///< see SubjectOptions
  std::uint64_t points = 256; ///< random points of the deterministic laws over the 50-digit oracle
  double invert_eps = 16;     ///< |invert(sample(u)) - u|
  double sample_eps = 16;     ///< |sample(u) - exact|, relative to max(1, |exact|)
  double pdf_eps = 64;        ///< |pdf(x) / exact - 1|
  double mass_eps = 64;       ///< |mass - 1| beyond the bound on the quadrature error
  std::size_t max_evaluations = 12'000'000;
  bool evidence = false; ///< see SubjectOptions
};

/// A sampler that is its own oracle, and one with an inverse.
template <class W>
concept HasOracle = Samplable<W> && requires(const W w) {
  w.template cast<Oracle>();
};
template <class W>
concept Invertible = Samplable<W> && requires(const W w, typename W::Domain::Point x) {
  { w.invert(x) } -> std::convertible_to<typename W::Domain::UnitPoint>;
};

namespace detail {

template <class W> using ScalarOf = typename W::Domain::Scalar;

/// The point of u; nothing where the sampler fails.
template <Samplable W> std::optional<PointOf<W>> point_of(const W& warp, const UnitPointOf<W>& u) {
  const auto drawn = warp.sample(u);
  if (is_empty(drawn)) return {};
  return PointOf<W>(unwrapped(drawn));
}

/// Numbers of any scalar, of which a law uses as many as its domain has dimensions.
template <class S> using Triple = std::array<S, 3>;

template <class W> UnitPointOf<W> unit_point_of(const Triple<ScalarOf<W>>& u) {
  if constexpr (W::Domain::dim == 1) return u[0];
  else {
    UnitPointOf<W> p;
    for (int i = 0; i < W::Domain::dim; ++i) p[i] = u[static_cast<std::size_t>(i)];
    return p;
  }
}

inline Subject::Coordinates law_point(Pcg& random, int dim) {
  Subject::Coordinates u{};
  for (int i = 0; i < dim; ++i) u[static_cast<std::size_t>(i)] = random.uniform<double>();
  return u;
}

template <Real S> S narrowed(double x) {
  const S s = static_cast<S>(x);
  return s < one_minus_epsilon<S> ? s : one_minus_epsilon<S>;
}
template <class W> UnitPointOf<W> narrow(const Subject::Coordinates& u) {
  using S = ScalarOf<W>;
  return unit_point_of<W>({narrowed<S>(u[0]), narrowed<S>(u[1]), narrowed<S>(u[2])});
}

template <class P> double distance(const P& a, const P& b) {
  if constexpr (requires { a.norm(); }) return static_cast<double>((a - b).norm());
  else return std::abs(static_cast<double>(a - b));
}

template <class P> double magnitude(const P& a) {
  if constexpr (requires { a.norm(); }) return static_cast<double>(a.norm());
  else return std::abs(static_cast<double>(a));
}

/// The point of u, of the chart at `start` where the sampler fails.
template <Samplable W>
std::vector<ScalarOf<W>> numbers_at(const W& warp, const Triple<ScalarOf<W>>& u, const Triple<ScalarOf<W>>& start) {
  const auto drawn = point_of(warp, unit_point_of<W>(u));
  const PointOf<W> x = drawn ? *drawn : PointOf<W>(warp.domain().from_unit(unit_point_of<W>(start)));
  if constexpr (requires { x.size(); }) return {x.data(), x.data() + x.size()};
  else return {x};
}

/// Calls probe at the ends, the quarters and the middle of the unit cube, and at the neighbours of every break that is
/// found on lines along each axis, of map(u, start of the line) and, since rounding hides a kink from its own scalar,
/// of `exact`, which may be empty.
template <Real S> struct EdgeWalk {
  template <class T> using Map = std::function<std::vector<T>(const Triple<T>& u, const Triple<T>& start)>;
  int dim;
  std::function<void(const Triple<S>& u)> probe;
  Map<S> map;
  Map<Oracle> exact;
  void operator()(std::uint64_t seed) const;
};
extern template struct EdgeWalk<float>;
extern template struct EdgeWalk<double>;

/// sample and pdf where EdgeWalk goes.
template <Samplable W> void edge_law(const W& warp, std::uint64_t seed, LawLedger& ledger) {
  using S = ScalarOf<W>;
  EdgeWalk<S> walk{
      W::Domain::dim, {}, [&](const Triple<S>& u, const Triple<S>& start) { return numbers_at(warp, u, start); }, {}};
  walk.probe = [&](const Triple<S>& numbers) {
    const auto u = unit_point_of<W>(numbers);
    const auto x = point_of(warp, u);
    if (!x) return;
    const double density = static_cast<double>(warp.pdf(*x));
    const bool finite = all_finite(*x), inside = finite && warp.domain().contains(*x),
               positive = density > 0 && std::isfinite(density);
    ledger.note(finite && inside && positive ? 0 : 1, [&] {
      return fmt::format("{} at u = {}: x = {}, pdf = {:.9g}",
                         !finite   ? "not finite"
                         : !inside ? "outside the domain"
                                   : "pdf not positive and finite",
                         format_point(u), format_point(*x), density);
    });
  };
  if constexpr (HasOracle<W>)
    walk.exact = [oracle = warp.template cast<Oracle>()](const Triple<Oracle>& u, const Triple<Oracle>& start) {
      return numbers_at(oracle, u, start);
    };
  walk(seed);
}

/// invert(sample(u)) = u.
template <Invertible W> void inverse_law(const W& warp, std::uint64_t seed, LawLedger& ledger) {
  using S = ScalarOf<W>;
  constexpr int dim = W::Domain::dim;
  const double eps = static_cast<double>(std::numeric_limits<S>::epsilon());
  Pcg random(seed, 11);
  for (int k = 0; k < 20000; ++k) {
    const auto u = narrow<W>(law_point(random, dim));
    const auto drawn = point_of(warp, u);
    if (!drawn) continue;
    const PointOf<W> x = *drawn;
    const UnitPointOf<W> back = warp.invert(x);
    double worst = 0;
    for (int i = 0; i < dim; ++i) {
      double off = std::abs(component(back, i) - component(u, i));
      // The two sides of an azimuth's seam are one point.
      if (off > 0.5)
        if (const auto again = point_of(warp, back);
            again && distance(*again, x) <= 64 * eps * std::max(1.0, magnitude(x)))
          off = 1 - off;
      worst = off <= worst ? worst : off;
    }
    ledger.note(worst / eps,
                [&] { return fmt::format("u = {}, invert(sample(u)) = {}", format_point(u), format_point(back)); });
  }
}

/// |det d sample / d u| pdf = 1, by central differences over the oracle.
///   chart   : u -> chart coordinates of the sample
///   density : u -> pdf of the sample times the Jacobian of the chart
void jacobian_law(int dim, const std::function<Triple<Oracle>(const Triple<Oracle>&)>& chart,
                  const std::function<Oracle(const Triple<Oracle>&)>& density, std::uint64_t points, std::uint64_t seed,
                  LawLedger& ledger);

template <Invertible W>
void jacobian_law(const W& oracle, std::uint64_t points, std::uint64_t seed, LawLedger& ledger) {
  const auto domain = oracle.domain();
  const auto at = [&](const Triple<Oracle>& u) { return domain.to_unit(oracle.sample(unit_point_of<W>(u))); };
  const auto chart = [&](const Triple<Oracle>& u) {
    const auto v = at(u);
    if constexpr (W::Domain::dim == 1) return Triple<Oracle>{v, 0, 0};
    else {
      Triple<Oracle> t;
      for (int i = 0; i < W::Domain::dim; ++i) t[static_cast<std::size_t>(i)] = v[i];
      return t;
    }
  };
  const auto density = [&](const Triple<Oracle>& u) {
    const auto x = oracle.sample(unit_point_of<W>(u));
    return Oracle(Oracle(oracle.pdf(x)) * Oracle(domain.jacobian(domain.to_unit(x))));
  };
  jacobian_law(W::Domain::dim, chart, density, points, seed, ledger);
}

/// sample and pdf of the warp against the oracle, in epsilons.
template <Samplable W, Samplable O>
void precision_laws(const W& warp, const O& oracle, std::uint64_t points, std::uint64_t seed, LawLedger& sample,
                    LawLedger& pdf) {
  using S = ScalarOf<W>;
  using T = ScalarOf<O>;
  constexpr int dim = W::Domain::dim;
  const double eps = static_cast<double>(std::numeric_limits<S>::epsilon());
  Pcg random(seed, 13);
  for (std::uint64_t k = 0; k < points; ++k) {
    const auto u = narrow<W>(law_point(random, dim));
    const auto drawn = point_of(warp, u);
    const auto truth = point_of(oracle, cast_point<T>(u));
    // Where one fails and the other does not is a matter of rounding; the rate of failures is tested with the mass.
    if (!drawn || !truth) continue;
    const PointOf<W> x = *drawn;
    const PointOf<O> exact = *truth;
    const double off = distance(cast_point<T>(x), exact) / std::max(1.0, magnitude(exact)) / eps;
    sample.note(off,
                [&] { return fmt::format("{:.3g} eps at u = {}: x = {}", off, format_point(u), format_point(x)); });
    const T density = oracle.pdf(cast_point<T>(x));
    // Rounding may carry x across the edge of the support, where the two sides differ and both are right.
    if (!(density > 0)) continue;
    const double ratio = static_cast<double>(T(T(warp.pdf(x)) / density)), wrong = std::abs(ratio - 1) / eps;
    pdf.note(wrong, [&] {
      return fmt::format("{:.3g} eps at x = {}: pdf = {:.9g}", wrong, format_point(x),
                         static_cast<double>(warp.pdf(x)));
    });
  }
}

} // namespace detail

/// Two functions on a domain as one sampler: sample(u) -> x or optional x, pdf(x).
template <Domain D, class Sample, class Pdf> struct FunctionSampler {
  using Domain = D;
  D set;
  Sample draw;
  Pdf density;
  D domain() const { return set; }
  auto sample(const typename D::UnitPoint& u) const { return draw(u); }
  auto pdf(const typename D::Point& x) const { return static_cast<typename D::Scalar>(density(x)); }
};

/// Checks one warp, or any struct with a domain, sample and pdf; each law is one Check of the report.
///   edges     : sample finite and in the domain, pdf positive and finite, for u in the product of the ends, quarters
///               and the middle of [0,1) with their neighbours, and beside the branches that find_breaks sees on lines
///               along each axis
///   invert    : invert(sample(u)) = u at 20000 random u, within invert_eps               (with invert)
///   jacobian  : |det d sample / d u| pdf = 1 to 1e-20 by differences over 50 digits      (with invert and cast)
///   precision : sample and pdf against the 50-digit oracle, within sample_eps and pdf_eps (with cast)
///   and everything that check_subject does: per-sample laws, mass, chi-squares, tails, KS, cells, inverted samples
template <Samplable W> Report check_laws(const W& warp, const LawOptions& options = {}) {
  using S = detail::ScalarOf<W>;
  const double eps = static_cast<double>(std::numeric_limits<S>::epsilon());
  const auto start = std::chrono::steady_clock::now();
  Report report;
  if (options.samples > 0) {
    Subject subject = make_subject(options.name, warp);
    subject.mass_tolerance = options.mass_eps * eps;
    if constexpr (Invertible<W>) {
      subject.invert_error = options.invert_eps * eps;
      subject.invert = [warp, chart = warp.domain().template cast<double>()](const Subject::Coordinates& v) {
        using Chart = std::remove_cvref_t<decltype(chart)>;
        const UnitPointOf<W> u = warp.invert(cast_point<S>(chart.from_unit(detail::unit_point<Chart>(v))));
        Subject::Coordinates c{};
        for (int i = 0; i < W::Domain::dim; ++i) c[static_cast<std::size_t>(i)] = detail::component(u, i);
        return c;
      };
    }
    SubjectOptions o;
    o.samples = options.samples, o.seed = options.seed, o.alpha = options.alpha,
    o.max_evaluations = options.max_evaluations, o.evidence = options.evidence;
    report = check_subject(subject, o);
  } else {
    report.subject = options.name;
    report.alpha = options.alpha;
  }
  std::vector<Check> laws;
  const auto close = [&](LawLedger& ledger) { laws.push_back(ledger.check()); };

  LawLedger edges("edges of the unit cube", 0, Fault::edge);
  detail::edge_law(warp, options.seed, edges);
  close(edges);
  if constexpr (Invertible<W>) {
    LawLedger inverse("invert(sample(u)) = u [eps]", options.invert_eps, Fault::inverse);
    detail::inverse_law(warp, options.seed, inverse);
    close(inverse);
  }
  if constexpr (HasOracle<W>) {
    const auto oracle = warp.template cast<Oracle>();
    if constexpr (Invertible<W>) {
      LawLedger jacobian("|det| pdf = 1", 1e-20, Fault::jacobian);
      detail::jacobian_law(oracle, options.points / 4, options.seed, jacobian);
      close(jacobian);
    }
    LawLedger sample("sample against 50 digits [eps]", options.sample_eps, Fault::precision);
    LawLedger pdf("pdf against 50 digits [eps]", options.pdf_eps, Fault::precision);
    detail::precision_laws(warp, oracle, options.points, options.seed, sample, pdf);
    close(sample);
    close(pdf);
  }

  report.checks.insert(report.checks.begin(), laws.begin(), laws.end());
  std::vector<UnitPointOf<W>> u;
  Pcg random(3);
  for (int i = 0; i < timing_inputs; ++i) u.push_back(random.point<S, W::Domain::dim>());
  report.ns_per_sample = ns_per_sample(u, [&](const UnitPointOf<W>& v) {
    const auto x = warp.sample(v);
    return detail::is_empty(x) ? 0.0 : detail::component(detail::unwrapped(x), 0);
  });
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

/// The same for a pair of functions on a domain: sample(u) -> x or optional x, pdf(x).
template <Domain D, class Sample, class Pdf>
Report check_laws(const D& domain, Sample sample, Pdf pdf, const LawOptions& options = {}) {
  return check_laws(FunctionSampler<D, Sample, Pdf>{domain, sample, pdf}, options);
}

} // namespace mc
