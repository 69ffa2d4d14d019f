#pragma once
/// Subjects of warps, of discrete distributions and of functions.

#include <mc/check/subject/chart_axes.h>
#include <mc/check/subject/subject.h>
#include <mc/random/pcg.h>
#include <mc/table/concept.h>
#include <mc/warp/concept.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace mc {

/// What the checkers ask of a sampler: a Warp without its change of scalar. sample may return an optional, empty where
/// it fails.
template <class W>
concept Samplable = Domain<typename W::Domain> &&
    requires(const W w, typename W::Domain::Point x, typename W::Domain::UnitPoint u) {
  { w.domain() } -> std::convertible_to<typename W::Domain>;
  w.sample(u);
  { w.pdf(x) } -> std::convertible_to<typename W::Domain::Scalar>;
};

namespace detail {

template <class T> struct Unwrapped { using type = T; };
template <class T> struct Unwrapped<std::optional<T>> { using type = T; };
/// Whether a sampler's result is optional, and what it holds.
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

/// The largest |a / b - 1| over the channels, 0 where both are 0.
template <class F> double disagreement(const F& a, const F& b) {
  const auto one = [](double x, double y) { return x == y ? 0.0 : y != 0 ? std::abs(x / y - 1) : HUGE_VAL; };
  if constexpr (requires { a.size(); }) {
    double worst = 0;
    for (int i = 0; i < a.size(); ++i) {
      const double off = one(static_cast<double>(a[i]), static_cast<double>(b[i]));
      worst = off <= worst ? worst : off;
    }
    return worst;
  } else {
    return one(static_cast<double>(a), static_cast<double>(b));
  }
}

template <class P> bool all_finite(const P& x) {
  if constexpr (requires { x.size(); }) {
    for (int i = 0; i < x.size(); ++i)
      if (!std::isfinite(static_cast<double>(x[i]))) return false;
    return true;
  } else {
    return std::isfinite(static_cast<double>(x));
  }
}

template <class P> double component(const P& x, int i) {
  if constexpr (requires { x.size(); }) return static_cast<double>(x[i]);
  else return static_cast<double>(x);
}

template <class P> int components(const P& x) {
  if constexpr (requires { x.size(); }) return static_cast<int>(x.size());
  else return 1;
}

/// "(0.25, 0.5)" with as many digits as tell the point from its neighbours.
template <class P> std::string format_point(const P& x) {
  if constexpr (requires { x.size(); }) {
    std::string text = "(";
    for (int i = 0; i < x.size(); ++i)
      text += fmt::format("{}{:.{}g}", i ? ", " : "", static_cast<double>(x[i]),
                          std::numeric_limits<typename P::Scalar>::max_digits10);
    return text + ")";
  } else {
    return fmt::format("{:.{}g}", static_cast<double>(x), std::numeric_limits<P>::max_digits10);
  }
}

/// "u = (0.25, 0.5), ": the uniform numbers that a draw took from the stream.
template <Real S> std::string format_uniforms(Pcg before, const Pcg& after) {
  int words = 0;
  for (Pcg probe = before; words < 64 && !(probe == after); ++words) probe.next32();
  if (words == 0 || words == 64) return {};
  const bool wide = !std::same_as<S, float> && words % 2 == 0;
  const int count = wide ? words / 2 : words;
  std::string text = count > 1 ? "u = (" : "u = ";
  for (int i = 0; i < count; ++i)
    text += (i ? ", " : "") + (wide ? format_point(before.uniform<double>()) : format_point(before.uniform<float>()));
  return text + (count > 1 ? "), " : ", ");
}

template <class D> typename D::UnitPoint unit_point(const Subject::Coordinates& v) {
  if constexpr (D::dim == 1) return v[0];
  else {
    typename D::UnitPoint p;
    for (int i = 0; i < D::dim; ++i) p[i] = v[static_cast<std::size_t>(i)];
    return p;
  }
}

/// The subject of a draw and a density on a domain. draw(random, x) fills x and returns its stated weight times pdf /
/// f, 1 where it states none; nothing where it fails.
template <Domain D, class Draw, class Pdf> Subject subject_on(std::string name, const D& domain, Draw draw, Pdf pdf) {
  using S = typename D::Scalar;
  using Point = typename D::Point;
  const auto chart = domain.template cast<double>();
  using Chart = decltype(chart);
  Subject s;
  s.name = std::move(name);
  s.dim = D::dim;
  s.axes = chart_axes(domain);
  s.mass_tolerance = 64 * static_cast<double>(std::numeric_limits<S>::epsilon());
  s.epsilon = static_cast<double>(std::numeric_limits<S>::epsilon());
  s.resolution = [chart](const Subject::Coordinates& v, int axis) {
    const auto p = unit_point<std::remove_cvref_t<Chart>>(v);
    const auto x = chart.from_unit(p);
    const double eps = static_cast<double>(std::numeric_limits<S>::epsilon());
    double worst = eps * v[static_cast<std::size_t>(axis)];
    for (int i = 0; i < components(x); ++i) {
      auto y = x;
      if constexpr (requires { y.size(); }) y[i] *= 1 + eps;
      else y *= 1 + eps;
      worst = std::max(worst, std::abs(component(chart.to_unit(y), axis) - component(p, axis)));
    }
    return worst;
  };
  s.draw = [domain, chart, draw, pdf](std::uint64_t seed, std::size_t n, std::vector<Subject::Draw>& out) {
    Pcg random(seed);
    for (std::size_t i = 0; i < n; ++i) {
      Subject::Draw& d = out.emplace_back();
      Point x;
      const std::optional<double> weight = draw(random, x);
      if (!weight) {
        d.kind = Subject::Draw::Kind::failed;
      } else if (!all_finite(x)) {
        d.kind = Subject::Draw::Kind::not_finite;
      } else if (!domain.contains(x)) {
        d.kind = Subject::Draw::Kind::outside;
      } else {
        const double density = static_cast<double>(pdf(x));
        d.pdf_positive = density > 0 && std::isfinite(density);
        d.weight = *weight;
        const auto v = chart.to_unit(cast_point<double>(x));
        for (int k = 0; k < D::dim; ++k) d.v[static_cast<std::size_t>(k)] = component(v, k);
      }
    }
  };
  s.density = [chart, pdf](const Subject::Coordinates& v) {
    const auto p = unit_point<std::remove_cvref_t<Chart>>(v);
    return static_cast<double>(pdf(cast_point<S>(chart.from_unit(p)))) * chart.jacobian(p);
  };
  s.describe_draw = [draw, pdf](std::uint64_t seed, std::uint64_t index) {
    Pcg random(seed), before(seed);
    Point x;
    std::optional<double> weight;
    for (std::uint64_t i = 0; i <= index; ++i) before = random, weight = draw(random, x);
    const std::string u = format_uniforms<S>(before, random), where = fmt::format("draw {} of Pcg({})", index, seed);
    if (!weight) return u + where;
    return fmt::format("{}x = {}, pdf = {:.9g}{}, {}", u, format_point(x), static_cast<double>(pdf(x)),
                       *weight == 1 ? "" : fmt::format(", stated weight = {:.9g} f / pdf", *weight), where);
  };
  s.describe_point = [chart](const Subject::Coordinates& v) {
    return format_point(cast_point<float>(chart.from_unit(unit_point<std::remove_cvref_t<Chart>>(v))));
  };
  return s;
}

} // namespace detail

/// A sampler on a domain, its claimed density and perhaps the f it is for.
///   sampler : takes u, a point of the unit cube of the domain's dimension, or mc::Pcg& to draw from as it likes.
///             Returns a point x; or a struct of x, weight and perhaps pdf, whose weight must be f / pdf (a light's
///             radiance over its density, say); or an optional of either, empty where it fails
///   pdf, f  : functions of x; f may return several channels as an Eigen array
template <Domain D, class Sampler, class Pdf, class F = std::nullptr_t>
Subject make_subject(std::string name, const D& domain, Sampler sampler, Pdf pdf, [[maybe_unused]] F f = nullptr) {
  using S = typename D::Scalar;
  const auto call = [sampler](Pcg& random) {
    if constexpr (std::invocable<const Sampler&, Pcg&>) return sampler(random);
    else return sampler(random.point<S, D::dim>());
  };
  using Result = std::invoke_result_t<decltype(call), Pcg&>;
  using Held = typename detail::Unwrapped<Result>::type;
  constexpr bool weighted = requires(const Held& held) { held.x, held.weight; };
  static_assert(!weighted || !std::same_as<F, std::nullptr_t>,
                "make_subject: a sampler that states weights needs the f they are for");
  Subject s = detail::subject_on(
      std::move(name), domain,
      [=](Pcg& random, typename D::Point& x) -> std::optional<double> {
        const Result drawn = call(random);
        if (detail::is_empty(drawn)) return {};
        const Held& held = detail::unwrapped(drawn);
        if constexpr (weighted) {
          x = held.x;
          const S density = static_cast<S>(pdf(x));
          using Value = std::remove_cvref_t<decltype(held.weight)>;
          double off = detail::disagreement(Value(held.weight * density), Value(f(x)));
          if constexpr (requires { held.pdf; })
            off = std::max(off, detail::disagreement(static_cast<double>(held.pdf), static_cast<double>(density)));
          return 1 + off;
        } else {
          x = held;
          return 1.0;
        }
      },
      pdf);
  s.may_fail = detail::may_be_empty<Result>;
  return s;
}

/// A warp, or any struct with domain, sample and pdf. Float points are mapped to the chart in double, so the bins lose
/// no precision.
template <Samplable W> Subject make_subject(std::string name, const W& warp) {
  return make_subject(
      std::move(name), typename W::Domain(warp.domain()), [warp](const UnitPointOf<W>& u) { return warp.sample(u); },
      [warp](const PointOf<W>& x) { return warp.pdf(x); });
}

/// A discrete distribution: its outcomes are atoms, its weight the ratio of stated and tabulated probability. An
/// u_remapped outside [0,1) counts as not finite.
template <DiscreteDistribution D> Subject make_discrete_subject(std::string name, const D& distribution) {
  using S = typename D::Scalar;
  Subject s;
  s.name = std::move(name);
  s.mass_tolerance = 64 * static_cast<double>(std::numeric_limits<S>::epsilon());
  for (std::size_t i = 0; i < distribution.size(); ++i) s.atoms.push_back(static_cast<double>(distribution.pmf(i)));
  s.draw = [distribution](std::uint64_t seed, std::size_t n, std::vector<Subject::Draw>& out) {
    using Kind = Subject::Draw::Kind;
    Pcg random(seed);
    for (std::size_t i = 0; i < n; ++i) {
      Subject::Draw& d = out.emplace_back();
      const auto drawn = distribution.sample_index(random.uniform<S>());
      d.kind = drawn.u_remapped >= 0 && drawn.u_remapped < 1 ? Kind::atom : Kind::not_finite;
      d.atom = static_cast<int>(drawn.index);
      d.pdf_positive = drawn.pmf > 0;
      d.weight = static_cast<double>(drawn.pmf / distribution.pmf(drawn.index));
    }
  };
  s.describe_draw = [distribution](std::uint64_t seed, std::uint64_t index) {
    Pcg random(seed);
    random.advance(index * (std::same_as<S, float> ? 1 : 2));
    const S u = random.uniform<S>();
    const auto drawn = distribution.sample_index(u);
    return fmt::format("u = {}, outcome {}, pmf = {:.9g}, u_remapped = {}", detail::format_point(u), drawn.index,
                       static_cast<double>(drawn.pmf), detail::format_point(drawn.u_remapped));
  };
  return s;
}

} // namespace mc
