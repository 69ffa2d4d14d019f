#pragma once
/// Subjects of warps, of discrete distributions and of pairs of functions.

#include <mc/check/chart_axes.h>
#include <mc/check/subject.h>
#include <mc/random/pcg.h>
#include <mc/table/concept.h>
#include <mc/warp/concept.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mc {

namespace detail {

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
    for (int i = 0; i < x.size(); ++i) text += fmt::format("{}{:.{}g}", i ? ", " : "", static_cast<double>(x[i]), std::numeric_limits<typename P::Scalar>::max_digits10);
    return text + ")";
  } else {
    return fmt::format("{:.{}g}", static_cast<double>(x), std::numeric_limits<P>::max_digits10);
  }
}

template <class D> typename D::UnitPoint unit_point(const Subject::Coordinates& v) {
  if constexpr (D::dim == 1) return v[0];
  else {
    typename D::UnitPoint p;
    for (int i = 0; i < D::dim; ++i) p[i] = v[static_cast<std::size_t>(i)];
    return p;
  }
}

/// The subject of a draw (random, x) -> bool and a density on a domain. Draw fills x and returns false where it fails.
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
      if (!draw(random, x)) {
        d.kind = Subject::Draw::Kind::failed;
      } else if (!all_finite(x)) {
        d.kind = Subject::Draw::Kind::not_finite;
      } else if (!domain.contains(x)) {
        d.kind = Subject::Draw::Kind::outside;
      } else {
        const double density = static_cast<double>(pdf(x));
        d.pdf_positive = density > 0 && std::isfinite(density);
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
    Pcg random(seed);
    Point x;
    bool ok = true;
    for (std::uint64_t i = 0; i <= index; ++i) ok = draw(random, x);
    if (!ok) return fmt::format("draw {} of Pcg({})", index, seed);
    return fmt::format("x = {}, pdf = {:.9g}, draw {} of Pcg({})", format_point(x), static_cast<double>(pdf(x)), index, seed);
  };
  s.describe_point = [chart](const Subject::Coordinates& v) { return format_point(cast_point<float>(chart.from_unit(unit_point<std::remove_cvref_t<Chart>>(v)))); };
  return s;
}

} // namespace detail

/// A warp. Float points are mapped to the chart in double, so the bins lose no precision.
template <Warp W> Subject make_subject(std::string name, const W& warp) {
  using S = typename W::Scalar;
  constexpr int dim = W::Domain::dim;
  const typename W::Domain domain = warp.domain();
  Subject s = detail::subject_on(
      std::move(name), domain,
      [warp](Pcg& random, PointOf<W>& x) {
        x = warp.sample(random.point<S, dim>());
        return true;
      },
      [warp](const PointOf<W>& x) { return warp.pdf(x); });
  s.describe_draw = [warp](std::uint64_t seed, std::uint64_t index) {
    Pcg random(seed);
    random.advance(index * static_cast<std::uint64_t>(dim) * (std::same_as<S, float> ? 1 : 2));
    const UnitPointOf<W> u = random.point<S, dim>();
    const PointOf<W> x = warp.sample(u);
    return fmt::format("u = {}, x = {}, pdf = {:.9g}", detail::format_point(u), detail::format_point(x), static_cast<double>(warp.pdf(x)));
  };
  return s;
}

/// A discrete distribution: its outcomes are atoms, its weight the ratio of stated and tabulated probability. An u_remapped
/// outside [0,1) counts as not finite.
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
    return fmt::format("u = {}, outcome {}, pmf = {:.9g}, u_remapped = {}", detail::format_point(u), drawn.index, static_cast<double>(drawn.pmf), detail::format_point(drawn.u_remapped));
  };
  return s;
}

/// A sampler random -> x (or optional x, empty where it fails) drawing from mc::Pcg, its claimed density and the domain.
template <Domain D, class Sampler, class Pdf>
Subject make_subject(std::string name, const D& domain, Sampler sampler, Pdf pdf) {
  using Result = std::invoke_result_t<Sampler, Pcg&>;
  constexpr bool optional = !std::convertible_to<Result, typename D::Point>;
  Subject s = detail::subject_on(
      std::move(name), domain,
      [sampler](Pcg& random, typename D::Point& x) {
        if constexpr (optional) {
          const auto drawn = sampler(random);
          if (drawn) x = *drawn;
          return drawn.has_value();
        } else {
          x = sampler(random);
          return true;
        }
      },
      pdf);
  s.may_fail = optional;
  return s;
}

} // namespace mc
