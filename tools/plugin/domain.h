#pragma once
/// The functions of a plugin in the types of their domain.

#include <plugin/plugin.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/box.h>
#include <mc/domain/disk.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/domain/sphere.h>
#include <mc/domain/triangle.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace carlo {

using Coordinates = std::array<double, 3>;
using Uniforms = std::array<double, Watch::max_arguments>;

/// Domains of one kind of points as one domain, so that the laws are compiled once for all of them.
template <mc::Domain First, mc::Domain... Rest> struct OneOf {
  using Scalar = typename First::Scalar;
  using Point = typename First::Point;
  using UnitPoint = typename First::UnitPoint;
  static constexpr int dim = First::dim;
  static constexpr mc::Measure measure = First::measure;

  std::variant<First, Rest...> which;

  Point from_unit(const UnitPoint& v) const {
    return std::visit([&](const auto& d) -> Point { return d.from_unit(v); }, which);
  }
  UnitPoint to_unit(const Point& x) const {
    return std::visit([&](const auto& d) -> UnitPoint { return d.to_unit(x); }, which);
  }
  Scalar jacobian(const UnitPoint& v) const {
    return std::visit([&](const auto& d) { return d.jacobian(v); }, which);
  }
  bool contains(const Point& x) const {
    return std::visit([&](const auto& d) { return d.contains(x); }, which);
  }
  template <mc::Real T> auto cast() const {
    using Other =
        OneOf<decltype(std::declval<First>().template cast<T>()), decltype(std::declval<Rest>().template cast<T>())...>;
    return std::visit([](const auto& d) { return Other{d.template cast<T>()}; }, which);
  }
};

template <mc::Real S> using Line = OneOf<mc::Interval<S>, mc::HalfLine<S>, mc::RealLine<S>>;
template <mc::Real S> using Plane = OneOf<mc::Box<S, 2>, mc::Disk<S>, mc::Triangle<S>>;
template <mc::Real S> using Directions = OneOf<mc::Sphere<S>, mc::Hemisphere<S>>;
template <mc::Real S> using Space = OneOf<mc::Box<S, 3>>;

/// The plugin's functions in the types of its domain.
template <mc::Domain D> struct Plugged {
  using S = typename D::Scalar;
  using Point = typename D::Point;

  PluginSampler plugin;
  D domain;

  static Point narrow(const double* x) {
    if constexpr (requires(Point p) { p.size(); }) {
      Point p;
      for (int i = 0; i < p.size(); ++i) p[i] = static_cast<S>(x[i]);
      return p;
    } else {
      return static_cast<S>(x[0]);
    }
  }
  static Coordinates widen(const Point& x) {
    Coordinates c{};
    for (int i = 0; i < mc::detail::components(x); ++i) c[static_cast<std::size_t>(i)] = mc::detail::component(x, i);
    return c;
  }

  Uniforms uniforms(mc::Pcg& random) const {
    Uniforms u{};
    for (int i = 0; i < plugin.uniforms(); ++i)
      u[static_cast<std::size_t>(i)] = static_cast<double>(random.uniform<S>());
    return u;
  }
  // Those of draw `index` of the stream `seed`.
  Uniforms uniforms_at(std::uint64_t seed, std::uint64_t index) const {
    mc::Pcg random(seed);
    random.advance(index * static_cast<std::uint64_t>(plugin.uniforms()) * (std::same_as<S, float> ? 1 : 2));
    return uniforms(random);
  }
  std::optional<Point> sample(const Uniforms& u) const {
    Coordinates x;
    x.fill(std::numeric_limits<double>::quiet_NaN()); // what sample forgets to write shows
    return plugin.sample(u.data(), x.data()) ? std::optional<Point>(narrow(x.data())) : std::nullopt;
  }
  // Both to 64 eps of their length.
  static bool same(const Point& a, const Point& b) {
    const double eps = static_cast<double>(std::numeric_limits<S>::epsilon());
    double apart = 0, size = 1;
    for (int i = 0; i < mc::detail::components(a); ++i) {
      apart += std::abs(mc::detail::component(a, i) - mc::detail::component(b, i));
      size += std::abs(mc::detail::component(a, i));
    }
    return apart <= 64 * eps * size;
  }
  double pdf(const Point& x) const { return plugin.pdf(widen(x).data()); }
  std::optional<Uniforms> invert(const Point& x) const {
    Uniforms u;
    u.fill(std::numeric_limits<double>::quiet_NaN());
    return plugin.invert(widen(x).data(), u.data()) ? std::optional<Uniforms>(u) : std::nullopt;
  }
  double eval(const Point& x) const { return plugin.eval(widen(x).data()); }
  double weight(const Uniforms& u, const Point& x) const { return plugin.weight(u.data(), widen(x).data()); }

  std::string format(const Uniforms& u) const {
    std::string text = "(";
    for (int i = 0; i < plugin.uniforms(); ++i)
      text += fmt::format("{}{:.17g}", i ? ", " : "", u[static_cast<std::size_t>(i)]);
    return text + ")";
  }
  std::string describe(const Uniforms& u) const {
    const auto x = sample(u);
    if (!x) return fmt::format("u = {}: it fails", format(u));
    std::string text = fmt::format("u = {}, x = {}, pdf = {:.9g}", format(u), mc::detail::format_point(*x), pdf(*x));
    if (plugin->eval) text += fmt::format(", eval = {:.9g}", eval(*x));
    if (plugin->weight) text += fmt::format(", weight = {:.9g}", weight(u, *x));
    return text;
  }
};

} // namespace carlo
