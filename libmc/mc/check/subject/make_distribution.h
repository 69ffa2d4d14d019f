#pragma once
/// Adapters from warps, discrete distributions and functions to AnyDistribution.

#include <mc/check/subject/any_distribution.h>
#include <mc/check/subject/chart_axes.h>
#include <mc/check/subject/field_count.h>
#include <mc/check/subject/timing.h>
#include <mc/table/concept.h>
#include <mc/warp/concept.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace mc {

/// A type with domain(), sample(u) and pdf(x). In contrast to a Warp it needs no cast to other scalars. sample may
/// return an optional, empty if it fails.
template <class W>
concept ContinuousDistribution = Domain<typename W::Domain> &&
    requires(const W w, typename W::Domain::Point x, typename W::Domain::UnitPoint u) {
  { w.domain() } -> std::convertible_to<typename W::Domain>;
  w.sample(u);
  { w.pdf(x) } -> std::convertible_to<typename W::Domain::Scalar>;
};

namespace detail {
template <class W> constexpr bool has_domain = requires(const W w) {
  typename W::Domain;
  { w.domain() } -> std::convertible_to<typename W::Domain>;
};
template <class W> constexpr bool has_chart = requires { requires Domain<typename W::Domain>; };
template <class W> constexpr bool has_sample = requires(const W w, typename W::Domain::UnitPoint u) { w.sample(u); };
template <class W> constexpr bool has_pdf = requires(const W w, typename W::Domain::Point x) {
  { w.pdf(x) } -> std::convertible_to<typename W::Domain::Scalar>;
};
} // namespace detail

/// A distribution that can be cast to 50 digits and serves as its own oracle.
template <class W>
concept HasOracle = ContinuousDistribution<W> && requires(const W w) {
  w.template cast<Oracle>();
};
/// A distribution with invert(x) -> u.
template <class W>
concept Invertible = ContinuousDistribution<W> && requires(const W w, typename W::Domain::Point x) {
  { w.invert(x) } -> std::convertible_to<typename W::Domain::UnitPoint>;
};

namespace detail {

template <class T> struct Unwrapped { using type = T; };
template <class T> struct Unwrapped<std::optional<T>> { using type = T; };
/// Whether a result of sample is optional, and the type that it contains.
template <class R>
constexpr bool may_be_empty = !std::same_as<typename Unwrapped<std::remove_cvref_t<R>>::type, std::remove_cvref_t<R>>;
template <class R> const auto& unwrapped(const R& r) {
  if constexpr (may_be_empty<R>) return *r;
  else return r;
}
template <class R> bool is_empty(const R& r) {
  if constexpr (may_be_empty<R>) return !r.has_value();
  else return false;
}

/// Returns the largest |a / b - 1| over the channels; 0 for a channel where a = b.
template <class F> double relative_difference(const F& a, const F& b) {
  double worst = 0;
  for (int i = 0; i < components(a); ++i) {
    const double x = component(a, i), y = component(b, i);
    if (x == y) continue;
    const double off = y != 0 ? std::abs(x / y - 1) : HUGE_VAL;
    worst = off <= worst ? worst : off;
  }
  return worst;
}

/// Sets `function` to f(*held, arguments) for a lambda f without captures.
template <class R, class... Args, class T, class F>
void set_shared(std::function<R(Args...)>& function, const std::shared_ptr<const T>& held, F) {
  function = SharedCall<R(Args...)>{held, [](const void* t, Args... args) -> R {
                                      return F()(*static_cast<const T*>(t), std::forward<Args>(args)...);
                                    }};
}

template <class W> double ns_per_point(const W& warp) {
  Pcg random(3);
  std::vector<UnitPointOf<W>> inputs(timing_inputs);
  for (auto& u : inputs) u = random.point<typename W::Domain::Scalar, W::Domain::dim>();
  return mc::ns_per_sample(inputs, [&](const UnitPointOf<W>& u) { return warp.sample(u); });
}

template <DiscreteDistribution D> double ns_per_outcome(const D& distribution) {
  using S = typename D::Scalar;
  Pcg random(3);
  std::vector<S> inputs(timing_inputs);
  for (S& u : inputs) u = random.uniform<S>();
  return mc::ns_per_sample(inputs, [&](S u) { return distribution.sample_index(u); });
}

/// Returns a chart over double as functions of numbers; domains over float and double share it. The functions that
/// build a distribution run once, so [[gnu::cold]] has them compiled for size, which shortens the compilation.
template <Domain Chart> [[gnu::cold]] AnyDomain domain_of(const Chart& chart) {
  using Point = typename Chart::Point;
  using UnitPoint = typename Chart::UnitPoint;
  AnyDomain d;
  d.dim = Chart::dim;
  d.point_size = point_size<Point>();
  d.axes = chart_axes(chart);
  const auto shared = std::make_shared<const Chart>(chart);
  set_shared(d.to_unit, shared, [](const Chart& c, const PointArray& x) {
    return to_array<double, max_chart_dim>(UnitPoint(c.to_unit(to_point<Point>(x))));
  });
  set_shared(d.from_unit, shared, [](const Chart& c, const AnyDomain::Coordinates& v) {
    const auto p = to_point<UnitPoint>(v);
    return AnyDomain::DomainPoint{to_array<double>(Point(c.from_unit(p))), c.jacobian(p)};
  });
  set_shared(d.jacobian, shared,
             [](const Chart& c, const AnyDomain::Coordinates& v) { return c.jacobian(to_point<UnitPoint>(v)); });
  return d;
}

/// Returns a distribution on the domain without sample and pdf.
template <Domain D> [[gnu::cold]] AnyDistribution distribution_on(std::string name, const D& domain) {
  AnyDistribution s;
  s.name = std::move(name);
  s.is_float = std::same_as<typename D::Scalar, float>;
  s.domain = domain_of(domain.template cast<double>());
  set_shared(s.domain.contains, std::make_shared<const D>(domain),
             [](const D& d, const PointArray& x) { return d.contains(to_point<typename D::Point>(x)); });
  return s;
}

/// A warp with its domain, cached so that it is not rebuilt for each point.
template <class W> struct WarpOnDomain {
  W warp;
  typename W::Domain domain;
};

/// Returns a warp over 50 digits as an oracle. It is compiled once for the float and the double form of the warp.
template <ContinuousDistribution O> [[gnu::cold]] OracleDistribution oracle_distribution(const O& warp) {
  using Point = PointOf<O>;
  using UnitPoint = UnitPointOf<O>;
  using Held = WarpOnDomain<O>;
  const auto oracle = std::make_shared<const Held>(Held{warp, warp.domain()});
  OracleDistribution e;
  set_shared(e.sample, oracle,
             [](const Held& o, const OracleDistribution::Point& u) -> std::optional<OracleDistribution::Point> {
               const auto drawn = o.warp.sample(to_point<UnitPoint>(u));
               if (is_empty(drawn)) return {};
               return to_array<Oracle, max_chart_dim>(Point(unwrapped(drawn)));
             });
  set_shared(e.pdf, oracle,
             [](const Held& o, const OracleDistribution::Point& x) { return Oracle(o.warp.pdf(to_point<Point>(x))); });
  set_shared(e.to_chart, oracle, [](const Held& o, const OracleDistribution::Point& x) {
    const UnitPoint v = o.domain.to_unit(to_point<Point>(x));
    return OracleDistribution::ChartPoint{to_array<Oracle, max_chart_dim>(v), Oracle(o.domain.jacobian(v))};
  });
  return e;
}

/// Returns the channel of a weight that differs most from f / pdf.
template <class Value> AnyDistribution::Stated stated_weight(const Value& weight, const Value& f, double pdf) {
  AnyDistribution::Stated stated;
  double worst = -1;
  for (int i = 0; i < components(weight); ++i) {
    const double value = component(weight, i), expected = component(f, i) / pdf;
    const double off = std::abs(value - expected) / std::max(std::abs(expected), 1e-300);
    if (off <= worst) continue;
    worst = off;
    stated.value = value;
    stated.expected = expected;
  }
  return stated;
}

/// Whether a result of sample is a struct with a point x; else it is a point.
template <class D, class Held>
constexpr bool is_struct = !std::convertible_to<Held, typename D::Point> && requires(const Held& held) {
  held.x;
};
template <class Held> constexpr bool states_weight = requires(const Held& held) { held.weight; };
template <class Held> constexpr bool states_pdf = requires(const Held& held) { held.pdf; };
/// Whether a struct has no members but x, weight and pdf, as far as they can be counted.
template <class Held> constexpr bool is_known_struct() {
  return field_count<Held>() <= 1 + int(states_weight<Held>) + int(states_pdf<Held>);
}

/// Converts a result of sample to AnyDistribution::Sample. The result is a point, or a struct of x and perhaps weight
/// and pdf.
template <Domain D, class Held, class Pdf, class F>
AnyDistribution::Sample make_sample(const Held& held, const D& domain, const Pdf& pdf, const F& f) {
  AnyDistribution::Sample d;
  if constexpr (is_struct<D, Held>) {
    const typename D::Point x = held.x;
    d.x = to_array<double>(x);
    if (!all_finite(x) || !domain.contains(x)) return d;
    const auto density = static_cast<typename D::Scalar>(pdf(x));
    d.pdf = static_cast<double>(density);
    double off = 0;
    if constexpr (states_weight<Held>) {
      using Value = std::remove_cvref_t<decltype(held.weight)>;
      const auto value = Value(f(x));
      off = relative_difference(Value(held.weight * density), value);
      d.stated = stated_weight(Value(held.weight), value, d.pdf);
    }
    if constexpr (states_pdf<Held>) {
      const double of_pdf = relative_difference(static_cast<double>(held.pdf), d.pdf);
      if (of_pdf > off) d.stated = {"pdf", static_cast<double>(held.pdf), d.pdf, ""};
      off = std::max(off, of_pdf);
    }
    d.weight = 1 + off;
  } else {
    d.x = to_array<double>(typename D::Point(held));
  }
  return d;
}

/// The functions that make_distribution combines.
template <Domain D, class Draw, class Pdf, class F> struct DistributionFunctions {
  using Chart = decltype(std::declval<const D&>().template cast<double>());
  D domain;
  Draw draw;
  Pdf pdf;
  F f;
  Chart chart = domain.template cast<double>();
  template <class Result> std::optional<AnyDistribution::Sample> to_sample(const Result& result) const {
    using Held = typename Unwrapped<Result>::type;
    static_assert(!states_weight<Held> || !std::same_as<F, std::nullptr_t>,
                  "make_distribution: a sample with a weight needs f, since weight = f / pdf");
    static_assert(
        !is_struct<D, Held> || is_known_struct<Held>(),
        "make_distribution: the sample has a member that is not checked; the members are x, pdf, and weight = "
        "f / pdf");
    if (is_empty(result)) return {};
    return make_sample(unwrapped(result), domain, pdf, f);
  }
  /// Returns the draw of to_chart() for a point.
  template <class Result> Subject::Draw to_draw(const Result& result) const {
    using Kind = Subject::Draw::Kind;
    Subject::Draw d;
    if (is_empty(result)) {
      d.kind = Kind::failed;
      return d;
    }
    const typename D::Point x = unwrapped(result);
    if (!all_finite(x) || !domain.contains(x)) {
      d.kind = all_finite(x) ? Kind::outside : Kind::not_finite;
      return d;
    }
    const typename Chart::UnitPoint v = chart.to_unit(to_point<typename Chart::Point>(to_array<double>(x)));
    const auto density = static_cast<double>(static_cast<typename D::Scalar>(pdf(x)));
    d.v = to_array<double, max_chart_dim>(v);
    d.density = density * chart.jacobian(v);
    d.pdf_positive = density > 0 && std::isfinite(density);
    return d;
  }
};

} // namespace detail

/// Returns a distribution on a domain from functions.
///   sample : takes u, a point of the unit cube with the domain's dimension, or mc::Pcg& to draw any number of random
///            numbers. Returns a point x; or a struct of x and perhaps weight and pdf; or an optional of either, empty
///            if it fails. The weight must be f / pdf, for example radiance over density for a light.
///   pdf, f : functions of x; f may return several channels as an Eigen array.
template <Domain D, class Draw, class Pdf, class F = std::nullptr_t>
[[gnu::cold]] AnyDistribution make_distribution(std::string name, const D& domain, Draw draw, Pdf pdf, F f = nullptr) {
  constexpr bool streams = std::invocable<const Draw&, Pcg&>;
  constexpr bool takes_u = std::invocable<const Draw&, typename D::UnitPoint>;
  static_assert(streams || takes_u, "sample must take u, a point of the unit cube, or mc::Pcg&");
  using Functions = detail::DistributionFunctions<D, Draw, Pdf, F>;
  AnyDistribution s = detail::distribution_on(std::move(name), domain);
  const auto shared =
      std::make_shared<const Functions>(Functions{domain, std::move(draw), std::move(pdf), std::move(f)});
  if constexpr (streams) {
    using Result = std::invoke_result_t<const Draw&, Pcg&>;
    s.may_fail = detail::may_be_empty<Result>;
    s.states_weight = detail::is_struct<D, typename detail::Unwrapped<Result>::type>;
    detail::set_shared(s.sample_stream, shared,
                       [](const Functions& g, Pcg& random) { return g.to_sample(g.draw(random)); });
  } else if constexpr (takes_u) {
    using Result = std::invoke_result_t<const Draw&, typename D::UnitPoint>;
    using Held = typename detail::Unwrapped<Result>::type;
    s.may_fail = detail::may_be_empty<Result>;
    s.states_weight = detail::is_struct<D, Held>;
    s.uniforms = D::dim;
    detail::set_shared(s.sample, shared, [](const Functions& g, const AnyDistribution::Uniforms& u) {
      return g.to_sample(g.draw(detail::to_point<typename D::UnitPoint>(u)));
    });
    if constexpr (!detail::is_struct<D, Held>)
      detail::set_shared(
          s.draw_many, shared,
          [](const Functions& g, std::span<const AnyDistribution::Uniforms> u, std::span<Subject::Draw> draws) {
            // One step for all points at a time: processors overlap short loops better than long loops.
            std::vector<Result> results;
            results.reserve(u.size());
            for (const AnyDistribution::Uniforms& one : u)
              results.push_back(g.draw(detail::to_point<typename D::UnitPoint>(one)));
            for (std::size_t i = 0; i < u.size(); ++i) draws[i] = g.to_draw(results[i]);
          });
  }
  detail::set_shared(s.pdf, shared, [](const Functions& g, const PointArray& x) {
    return static_cast<double>(static_cast<typename D::Scalar>(g.pdf(detail::to_point<typename D::Point>(x))));
  });
  return s;
}

/// Returns a warp, or any struct with domain, sample and pdf, as an AnyDistribution. The result includes invert, oracle
/// and breaks if the warp has them. breaks()[axis] lists the chart coordinates where the density jumps, ascending.
template <ContinuousDistribution W> [[gnu::cold]] AnyDistribution make_distribution(std::string name, const W& warp) {
  const auto shared = std::make_shared<const W>(warp);
  AnyDistribution s = make_distribution(
      std::move(name), typename W::Domain(warp.domain()),
      [shared](const UnitPointOf<W>& u) { return shared->sample(u); },
      [shared](const PointOf<W>& x) { return shared->pdf(x); });
  if constexpr (Invertible<W>)
    detail::set_shared(s.invert, shared,
                       [](const W& w, const PointArray& x) -> std::optional<AnyDistribution::Uniforms> {
                         return detail::to_array<double>(UnitPointOf<W>(w.invert(detail::to_point<PointOf<W>>(x))));
                       });
  if constexpr (requires { warp.breaks(); }) {
    std::size_t axis = 0;
    for (std::vector<double>& places : warp.breaks()) s.breaks[axis++] = std::move(places);
  }
  if constexpr (HasOracle<W>) s.oracle = detail::oracle_distribution(warp.template cast<Oracle>());
  detail::set_shared(s.ns_per_sample, shared, [](const W& w) { return detail::ns_per_point(w); });
  return s;
}

/// Returns a discrete distribution. Its outcomes are atoms. Its weight is the ratio of stated and tabulated
/// probability. A u_remapped outside [0,1) counts as not finite.
template <DiscreteDistribution D> AnyDistribution make_discrete_distribution(std::string name, const D& distribution) {
  using S = typename D::Scalar;
  AnyDistribution s;
  s.name = std::move(name);
  s.is_float = std::same_as<S, float>;
  s.uniforms = 1;
  s.states_weight = true;
  for (std::size_t i = 0; i < distribution.size(); ++i) s.atoms.push_back(static_cast<double>(distribution.pmf(i)));
  const auto shared = std::make_shared<const D>(distribution);
  s.sample = [shared](const AnyDistribution::Uniforms& u) -> std::optional<AnyDistribution::Sample> {
    const auto drawn = shared->sample_index(static_cast<S>(u[0]));
    AnyDistribution::Sample d;
    d.atom = static_cast<int>(drawn.index);
    d.pdf = static_cast<double>(drawn.pmf);
    if (!(drawn.u_remapped >= 0 && drawn.u_remapped < 1)) d.x[0] = std::numeric_limits<double>::quiet_NaN();
    d.weight = static_cast<double>(drawn.pmf / shared->pmf(drawn.index));
    d.stated = {"stated probability", d.pdf, static_cast<double>(shared->pmf(drawn.index)), ""};
    return d;
  };
  s.ns_per_sample = [shared] { return detail::ns_per_outcome(*shared); };
  return s;
}

} // namespace mc
