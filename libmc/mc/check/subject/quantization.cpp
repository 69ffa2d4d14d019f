#include <mc/check/subject/quantization.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>

namespace mc {
namespace {

constexpr std::size_t least_points = 100;

struct SampledPoint {
  PointArray x;
  AnyDomain::Coordinates v;
};

std::vector<SampledPoint> draw_points(const AnyDistribution& s, std::uint64_t seed) {
  std::vector<SampledPoint> points;
  Pcg random(seed, 51);
  for (int i = 0; i < 1000; ++i) {
    const auto drawn = s.sample ? s.sample(random_uniforms(s, random)) : s.sample_stream(random);
    const ChartSample p = to_chart(s, drawn);
    if (p.draw.kind == Subject::Draw::Kind::point) points.push_back({drawn->x, p.draw.v});
  }
  return points;
}

// Returns the largest k such that a nonzero float is a multiple of 2^k.
int lowest_bit(float x) {
  int exponent = 0;
  const double digits = std::frexp(static_cast<double>(std::abs(x)), &exponent) * 0x1p24;
  return exponent - 24 + std::countr_zero(static_cast<std::uint32_t>(digits));
}

constexpr int spare_bits = 1; // a float with 23 random bits still counts as a full float

// Whether 1 - cos theta is a multiple of 2^-24, the spacing of floats below 1, and not of coarser steps. Only samples
// near the pole decide.
bool steps_at_pole(const std::vector<SampledPoint>& points, const Axis& axis, std::size_t k) {
  std::size_t near = 0, whole = 0, moved = 0, fine = 0;
  for (const SampledPoint& p : points) {
    const double steps = axis.b * p.v[k] * 0x1p24, rounded = std::round(steps);
    if (!(steps < 0x1p16)) continue;
    ++near;
    whole += rounded == 0 ? steps == 0 : std::abs(steps - rounded) < 0.05;
    moved += rounded != 0;
    fine += std::fmod(rounded, 2 << spare_bits) != 0;
  }
  const bool coarse = moved > 0 && static_cast<double>(fine) < 0.1 * static_cast<double>(moved);
  return near >= least_points && static_cast<double>(whole) > 0.9 * static_cast<double>(near) && !coarse;
}

// The largest power of two that divides all values of a set of floats.
struct Step {
  int exponent = 0;    // the power of two
  bool coarse = false; // coarser than the spacing of floats at the largest value
  std::string_view unit = {};
};

// Returns the step of values that are floats and not all equal; no value for others.
template <class Value> std::optional<Step> step_of(const std::vector<SampledPoint>& points, Value value) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  constexpr int none = std::numeric_limits<int>::max();
  bool differ = false;
  float largest = 0;
  int exponent = none;
  for (const SampledPoint& p : points) {
    const double x = value(p);
    const auto rounded = static_cast<float>(x);
    if (!(std::abs(x - static_cast<double>(rounded)) <= rounding * std::abs(x))) return {};
    differ = differ || x != value(points.front());
    largest = std::max(largest, std::abs(rounded));
    if (rounded != 0) exponent = std::min(exponent, lowest_bit(rounded));
  }
  if (!differ) return {};
  return Step{exponent, exponent > std::ilogb(largest) - 23 + spare_bits};
}

// The same for a function of chart coordinate k.
template <class Value>
std::optional<Step> step_at(const std::vector<SampledPoint>& points, std::size_t k, Value value) {
  return step_of(points, [&](const SampledPoint& p) { return value(p.v[k]); });
}

// Returns the step of the quantity of an axis; no value if it has none.
std::optional<Step> step_of_axis(const std::vector<SampledPoint>& points, const Axis& axis, std::size_t k) {
  const auto step = [&](auto value) { return step_at(points, k, value); };
  switch (axis.scale) {
  case Axis::Scale::azimuth: {
    std::optional<Step> turns = step([](double v) { return v; });
    if (turns) turns->unit = " turns";
    return turns ? turns : step([](double v) { return 2 * std::numbers::pi * v; });
  }
  case Axis::Scale::polar: {
    const auto cosine = step([&](double v) { return 1 - axis.b * v; });
    return cosine ? cosine : step([&](double v) { return axis.b * v; });
  }
  default: return step([&](double v) { return axis.value(v); });
  }
}

// Returns a clause about the step of a quantity; empty if there is nothing to report.
std::string clause(const std::string& what, const std::optional<Step>& step, bool is_float) {
  if (step && step->coarse)
    return fmt::format("{} has only multiples of {:.2g}{} (2^{})", what, std::ldexp(1.0, step->exponent), step->unit,
                       step->exponent);
  if (!step || is_float) return {};
  return what + " is rounded to float; compute it in double, or check the distribution as float";
}

// Tests the axes first, because they explain more than the coordinates of a point.
std::string clause_of_all(const AnyDistribution& s, const std::vector<SampledPoint>& points) {
  for (std::size_t k = 0; k < s.domain.axes.size(); ++k) {
    const Axis& axis = s.domain.axes[k];
    const std::string name = axis.scale == Axis::Scale::polar ? "cos " + axis.name : axis.name;
    const std::string text = clause(name, step_of_axis(points, axis, k), s.is_float);
    if (!text.empty()) return text;
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.domain.point_size); ++i) {
    const std::string name = s.domain.point_size == 1 ? "x" : fmt::format("x[{}]", i);
    const std::string text = clause(name, step_of(points, [i](const SampledPoint& p) { return p.x[i]; }), s.is_float);
    if (!text.empty()) return text;
  }
  return {};
}

// Returns the distance of x from the nearest point on the edge of the chart; no value if the chart has no point there.
std::optional<double> distance(const AnyDomain& domain, const PointArray& x) {
  AnyDomain::Coordinates v = domain.to_unit(x);
  for (double& one : v) {
    if (!std::isfinite(one)) return {};
    one = std::clamp(one, 0.0, 1.0);
  }
  const PointArray nearest = domain.from_unit(v).x;
  double most = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(domain.point_size); ++i) {
    if (!std::isfinite(nearest[i])) return {};
    most = std::max(most, std::abs(x[i] - nearest[i]) / std::max(1.0, std::abs(nearest[i])));
  }
  return most;
}

// Whether x is a float that needs more than half of its digits. Short floats such as 0.75 do not show the precision of
// their computation.
bool is_float_in_full(double x) {
  const auto rounded = static_cast<float>(x);
  return rounded != 0 && static_cast<double>(rounded) == x && std::ilogb(rounded) - lowest_bit(rounded) > 12;
}

} // namespace

std::string describe_quantization(const AnyDistribution& s, std::uint64_t seed) {
  const std::vector<SampledPoint> points = draw_points(s, seed);
  if (points.size() < least_points) return {};
  for (std::size_t k = 0; k < s.domain.axes.size(); ++k) {
    const Axis& axis = s.domain.axes[k];
    if (axis.scale == Axis::Scale::polar && steps_at_pole(points, axis, k))
      return fmt::format("cos {} is rounded to float near the pole; compute 1 - cos {} instead", axis.name, axis.name);
  }
  return clause_of_all(s, points);
}

std::string describe_float_rounding(const AnyDistribution& s, const PointArray& x) {
  if (s.is_float || !s.domain.to_unit || !s.domain.from_unit) return {};
  const std::span numbers = std::span(x).first(static_cast<std::size_t>(s.domain.point_size));
  if (!std::any_of(numbers.begin(), numbers.end(), is_float_in_full)) return {};
  const std::optional<double> off = distance(s.domain, x);
  if (!off || !(*off <= 4 * static_cast<double>(std::numeric_limits<float>::epsilon()))) return {};
  return ", off by the rounding error of float: compute it in double, or declare the distribution as float";
}

} // namespace mc
