#include <mc/check/subject/float_steps.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mc {
namespace {

constexpr std::size_t least_points = 100;

struct Seen {
  Numbers x;
  AnyDomain::Chart v;
};

std::vector<Seen> draw_points(const AnySampler& s, std::uint64_t seed) {
  std::vector<Seen> points;
  Pcg random(seed, 51);
  for (int i = 0; i < 1000; ++i) {
    const auto drawn = s.sample ? s.sample(random_uniforms(s, random)) : s.sample_stream(random);
    const Placed p = place(s, drawn);
    if (p.draw.kind == Subject::Draw::Kind::point) points.push_back({drawn->x, p.draw.v});
  }
  return points;
}

// Whether 1 - cos theta is a multiple of 2^-24, the distance of floats below 1, wherever that can be told.
bool steps_at_pole(const std::vector<Seen>& points, const Axis& axis, std::size_t k) {
  std::size_t near = 0, whole = 0;
  for (const Seen& p : points) {
    const double steps = axis.b * p.v[k] * 0x1p24;
    if (!(steps < 0x1p16)) continue;
    ++near;
    whole += std::abs(steps - std::round(steps)) < 0.05;
  }
  return near >= least_points && static_cast<double>(whole) > 0.9 * static_cast<double>(near);
}

// Whether all values are floats, and not all the same one.
template <class Value> bool are_floats(const std::vector<Seen>& points, Value value) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  bool differ = false;
  for (const Seen& p : points) {
    const double x = value(p);
    if (!(std::abs(x - static_cast<double>(static_cast<float>(x))) <= rounding * std::abs(x))) return false;
    differ = differ || x != value(points.front());
  }
  return differ;
}

// Likewise of what is made of their coordinate k of the chart.
template <class Value> bool are_floats_at(const std::vector<Seen>& points, std::size_t k, Value value) {
  return are_floats(points, [&](const Seen& p) { return value(p.v[k]); });
}

// What of the axis is a float; empty: nothing.
std::string float_of_axis(const std::vector<Seen>& points, const Axis& axis, std::size_t k) {
  const auto are = [&](auto value) { return are_floats_at(points, k, value); };
  switch (axis.scale) {
  case Axis::Scale::azimuth:
    if (are([](double v) { return v; }) || are([](double v) { return 2 * std::numbers::pi * v; })) return axis.name;
    return {};
  case Axis::Scale::polar:
    if (are([&](double v) { return 1 - axis.b * v; }) || are([&](double v) { return axis.b * v; }))
      return "cos " + axis.name;
    return {};
  default:
    if (are([&](double v) { return axis.value(v); })) return axis.name;
    return {};
  }
}

} // namespace

std::string float_steps(const AnySampler& s, std::uint64_t seed) {
  const std::vector<Seen> points = draw_points(s, seed);
  if (points.size() < least_points) return {};
  for (std::size_t k = 0; k < s.domain.axes.size(); ++k) {
    const Axis& axis = s.domain.axes[k];
    if (axis.scale == Axis::Scale::polar && steps_at_pole(points, axis, k))
      return fmt::format("cos {} comes in steps of a float; compute 1 - cos {} instead", axis.name, axis.name);
  }
  if (s.is_float) return {};
  const auto advice = [](const std::string& what) {
    return what + " comes in steps of a float; compute it in double, or check the sampler as one over float";
  };
  for (std::size_t k = 0; k < s.domain.axes.size(); ++k)
    if (const std::string what = float_of_axis(points, s.domain.axes[k], k); !what.empty()) return advice(what);
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.domain.numbers); ++i)
    if (are_floats(points, [i](const Seen& p) { return p.x[i]; }))
      return advice(s.domain.numbers == 1 ? "x" : fmt::format("x[{}]", i));
  return {};
}

} // namespace mc
