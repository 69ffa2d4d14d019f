#include <input/parameters.h>
#include <input/parsed_domain.h>

#include <mc/check/subject/make_distribution.h>
#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/domain/annulus.h>
#include <mc/domain/ball.h>
#include <mc/domain/disk.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/domain/sphere.h>
#include <mc/domain/triangle.h>
#include <mc/domain/unit_quaternions.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace carlo {

using mc::AnyDomain, mc::PointArray;
constexpr double infinity = HUGE_VAL;

namespace {

constexpr double unit_tolerance = 1e-5, edge_tolerance = 1e-6;

// A factor of a domain.
using Part = ParsedDomain;
using Contains = std::function<bool(const PointArray& x)>;

double norm(const PointArray& x, int n) {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) sum += x[i] * x[i];
  return std::sqrt(sum);
}

// A domain of libmc over double as a part. For printed points, `near` decides whether they are inside.
template <mc::Domain D>
Part part(std::string text, std::vector<std::string> columns, const D& d, Rounding rounding, Contains near) {
  const mc::AnyDistribution on = rounding == Rounding::floats
                                     ? mc::detail::distribution_on("", d.template cast<float>())
                                     : mc::detail::distribution_on("", d);
  Part p{on.domain, std::move(columns), std::move(text)};
  if (rounding != Rounding::printed) return p;
  p.chart.contains = std::move(near);
  p.chart.to_unit = [to_unit = p.chart.to_unit](const PointArray& x) {
    AnyDomain::Coordinates v = to_unit(x);
    for (double& one : v) one = std::clamp(one, 0.0, 1.0);
    return v;
  };
  return p;
}

// Unit vectors; printed ones are first normalised.
template <mc::Domain D>
Part unit_vectors(std::string text, std::vector<std::string> columns, const D& d, Rounding rounding, Contains near) {
  const auto n = static_cast<int>(columns.size());
  Part p = part(std::move(text), std::move(columns), d, rounding, std::move(near));
  if (rounding != Rounding::printed) return p;
  p.text += fmt::format(" (to {:g})", unit_tolerance);
  p.chart.to_unit = [to_unit = p.chart.to_unit, n](PointArray x) {
    const double length = norm(x, n);
    for (double& one : x) one /= length;
    return to_unit(x);
  };
  return p;
}

double number(std::string_view word, std::string_view whole) {
  const std::optional<double> value = mc::parse_double(mc::trimmed(word));
  mc::require(value && !std::isnan(*value), "'{}' in '{}' is not a number", word, whole);
  return *value;
}

Part interval(const std::string& name, std::string_view bounds, std::string_view whole, const Quartiles& quartiles,
              std::size_t column, Rounding rounding) {
  const std::size_t colon = bounds.find(':');
  mc::require(!name.empty() && colon != std::string_view::npos,
              "'{}' is not of the form name=lo:hi, as in \"x=0:1,y=-1:2\"", whole);
  const double lo = number(bounds.substr(0, colon), whole), hi = number(bounds.substr(colon + 1), whole);
  mc::require(lo < hi, "'{}' has bounds {} and {}; lo < hi is needed", whole, lo, hi);
  const std::string text = fmt::format("{} in [{:g}, {:g}]", name, lo, hi);
  const auto inside = [lo, hi](const PointArray& x) { return x[0] >= lo && x[0] <= hi && std::isfinite(x[0]); };
  const auto scale = [](double size) { return size > 0 ? size : 1.0; };
  const auto on = [&](const auto& domain) { return part(text, {name}, domain, rounding, inside); };
  Part p;
  if (std::isfinite(lo) && std::isfinite(hi)) p = on(mc::Interval<double>(lo, hi));
  else {
    const auto [low, middle, high] = quartiles(column);
    if (std::isinf(lo) && std::isinf(hi)) p = on(mc::RealLine<double>(middle, scale(high - low)));
    else if (std::isinf(hi)) p = on(mc::HalfLine<double>(lo, scale(middle - lo)));
    else p = on(mc::HalfLine<double>(hi, -scale(hi - middle)));
  }
  p.chart.axes[0].name = name;
  return p;
}

Part annulus(std::string_view radius, Rounding rounding) {
  const double inner = number(radius, radius);
  mc::require(inner > 0 && inner < 1, "annulus={} needs a radius in (0, 1)", radius);
  return part(fmt::format("the annulus {} <= r <= 1", inner), {"x", "y"}, mc::Annulus<double>(inner, 1), rounding,
              [inner](const PointArray& x) {
                return std::abs(norm(x, 2) - 0.5 - inner / 2) <= 0.5 - inner / 2 + edge_tolerance;
              });
}

Part named(const std::string& name, Rounding rounding) {
  const auto is_unit = [](int n) {
    return [n](const PointArray& x) { return std::abs(norm(x, n) - 1) <= unit_tolerance; };
  };
  if (name == "sphere")
    return unit_vectors("the unit sphere", {"x", "y", "z"}, mc::Sphere<double>(), rounding, is_unit(3));
  if (name == "hemisphere")
    return unit_vectors("the unit hemisphere", {"x", "y", "z"}, mc::Hemisphere<double>(), rounding,
                        [near = is_unit(3)](const PointArray& x) { return near(x) && x[2] >= -unit_tolerance; });
  if (name == "rotation")
    return unit_vectors("unit quaternions", {"x", "y", "z", "w"}, mc::UnitQuaternions<double>(), rounding, is_unit(4));
  if (name == "disk")
    return part("the unit disk", {"x", "y"}, mc::Disk<double>(), rounding,
                [](const PointArray& x) { return norm(x, 2) <= 1 + edge_tolerance; });
  if (name == "ball")
    return part("the unit ball", {"x", "y", "z"}, mc::Ball<double>(), rounding,
                [](const PointArray& x) { return norm(x, 3) <= 1 + edge_tolerance; });
  if (name == "triangle") {
    Part p = part("the triangle x, y >= 0, x + y <= 1", {"x", "y"}, mc::Triangle<double>(), rounding,
                  [](const PointArray& x) {
                    return x[0] >= -edge_tolerance && x[1] >= -edge_tolerance && x[0] + x[1] <= 1 + edge_tolerance;
                  });
    p.chart.axes[0].name = "1 - x";
    p.chart.axes[1].name = "y / (1 - x)";
    return p;
  }
  static const std::vector<std::string> known = {"sphere", "hemisphere", "disk",     "annulus",
                                                 "ball",   "triangle",   "rotation", "discrete"};
  throw mc::Error(fmt::format("'{}' is not of the form name=lo:hi, as in \"x=0:1,y=-1:2\", nor one of {}{}", name,
                              fmt::join(known, ", "), mc::did_you_mean(name, known)));
}

constexpr double most_outcomes = 1 << 24;

double whole_number(std::string_view word, std::string_view whole) {
  const double n = number(word, whole);
  mc::require(n == std::floor(n), "'{}': {} is no whole number", whole, n);
  return n;
}

Part discrete(std::string_view value, std::string_view whole) {
  const std::size_t colon = value.find(':');
  const bool is_range = colon != std::string_view::npos;
  const double lo = is_range ? whole_number(value.substr(0, colon), whole) : 0,
               hi = is_range ? whole_number(value.substr(colon + 1), whole) : whole_number(value, whole) - 1;
  const bool any = lo <= hi && lo < infinity && hi > -infinity;
  mc::require(any && (!std::isfinite(hi - lo) || hi - lo < most_outcomes),
              "'{}'; 1 to 2^24 outcomes are possible, or LO:HI with an infinite end", whole);
  Part p{{}, {"i"}, fmt::format("outcomes {} to {}", lo, hi), {lo, hi}};
  p.chart.point_size = 1;
  return p;
}

// Copies the elements [first, first + count) to the start of another array.
template <std::size_t N> std::array<double, N> slice(const std::array<double, N>& x, std::size_t first, int count) {
  std::array<double, N> part{};
  std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(first), count, part.begin());
  return part;
}
template <std::size_t N>
void put(std::array<double, N>& x, std::size_t first, int count, const std::array<double, N>& part) {
  std::copy_n(part.begin(), count, x.begin() + static_cast<std::ptrdiff_t>(first));
}

Part product(const Part& a, const Part& b) {
  Part p{{}, a.columns, a.text + ", " + b.text};
  p.columns.insert(p.columns.end(), b.columns.begin(), b.columns.end());
  mc::require(p.columns.size() <= std::tuple_size_v<PointArray>,
              "{} has {} dimensions in {} columns; at most {} columns can be checked", p.text,
              a.chart.dim + b.chart.dim, p.columns.size(), std::tuple_size_v<PointArray>);
  p.chart.dim = a.chart.dim + b.chart.dim;
  p.chart.point_size = a.chart.point_size + b.chart.point_size;
  p.chart.axes = a.chart.axes;
  p.chart.axes.insert(p.chart.axes.end(), b.chart.axes.begin(), b.chart.axes.end());
  const auto x_split = static_cast<std::size_t>(a.chart.point_size), v_split = static_cast<std::size_t>(a.chart.dim);
  p.chart.contains = [a = a.chart, b = b.chart, x_split](const PointArray& x) {
    return a.contains(slice(x, 0, a.point_size)) && b.contains(slice(x, x_split, b.point_size));
  };
  p.chart.to_unit = [a = a.chart, b = b.chart, x_split, v_split](const PointArray& x) {
    AnyDomain::Coordinates v = a.to_unit(slice(x, 0, a.point_size));
    put(v, v_split, b.dim, b.to_unit(slice(x, x_split, b.point_size)));
    return v;
  };
  p.chart.from_unit = [a = a.chart, b = b.chart, x_split, v_split](const AnyDomain::Coordinates& v) {
    AnyDomain::DomainPoint image = a.from_unit(slice(v, 0, a.dim));
    const AnyDomain::DomainPoint second = b.from_unit(slice(v, v_split, b.dim));
    put(image.x, x_split, b.point_size, second.x);
    image.jacobian *= second.jacobian;
    return image;
  };
  p.chart.jacobian = [a = a.chart, b = b.chart, v_split](const AnyDomain::Coordinates& v) {
    return a.jacobian(slice(v, 0, a.dim)) * b.jacobian(slice(v, v_split, b.dim));
  };
  return p;
}

} // namespace

int ParsedDomain::outcome_of(const double* row) const { return is_point(row) ? -1 : outcomes.index(row[0]); }

PointArray ParsedDomain::point_of(const double* row) const {
  PointArray x{};
  std::copy_n(row + (is_mixed() ? 1 : 0), chart.point_size, x.begin());
  return x;
}

std::vector<double> ParsedDomain::row_of(const PointArray& x) const {
  std::vector<double> row(x.begin(), x.begin() + chart.point_size);
  if (is_mixed()) row.insert(row.begin(), -1);
  return row;
}

std::vector<double> ParsedDomain::row_of(int outcome) const {
  std::vector<double> row(columns.size());
  row[0] = outcomes.first + outcome;
  return row;
}

bool ParsedDomain::contains(const double* row) const {
  return is_point(row) ? chart.contains(point_of(row)) : outcomes.index(row[0]) >= 0;
}

std::array<double, 3> unknown_quartiles(std::size_t) { return {-1, 0, 1}; }

std::array<double, 3> quartiles_of(std::vector<double> column) {
  std::erase_if(column, [](double x) { return !std::isfinite(x); });
  if (column.empty()) return unknown_quartiles(0);
  std::sort(column.begin(), column.end());
  return {column[column.size() / 4], column[column.size() / 2], column[column.size() * 3 / 4]};
}

namespace {

// The chart coordinate at which a monotone axis has the value x.
double place_on(const mc::Axis& axis, double x) {
  const double at_0 = axis.value(0), at_1 = axis.value(1);
  mc::require(std::isfinite(x) && x >= std::min(at_0, at_1) && x <= std::max(at_0, at_1),
              "a break of {} at {} lies outside of the domain", axis.name, x);
  if (axis.scale == mc::Axis::Scale::linear) return (x - axis.a) / (axis.b - axis.a);
  double lo = 0, hi = 1;
  for (double middle = 0.5; middle > lo && middle < hi; middle = 0.5 * (lo + hi))
    ((axis.value(middle) < x) == (at_0 < at_1) ? lo : hi) = middle;
  return hi;
}

} // namespace

Breaks chart_breaks(const AnyDomain& domain, const Breaks& places) {
  Breaks breaks;
  for (std::size_t k = 0; k < domain.axes.size(); ++k) {
    for (const double x : places[k]) {
      const double v = place_on(domain.axes[k], x);
      if (v > 0 && v < 1) breaks[k].push_back(v);
    }
    std::sort(breaks[k].begin(), breaks[k].end());
    breaks[k].erase(std::unique(breaks[k].begin(), breaks[k].end()), breaks[k].end());
  }
  return breaks;
}

Breaks parse_breaks(const std::string& text, const AnyDomain& domain) {
  Breaks places;
  if (text.empty()) return places;
  std::vector<std::string> names;
  for (const mc::Axis& axis : domain.axes) names.push_back(axis.name);
  for (const auto& [name, values] : parse_lists(text, "--breaks")) {
    const auto found = std::find(names.begin(), names.end(), name);
    mc::require(found != names.end(), "--breaks: '{}' is no axis of the domain; it has {}", name,
                fmt::join(names, ", "));
    places[static_cast<std::size_t>(found - names.begin())] = values;
  }
  return mc::with_context("--breaks", [&] { return chart_breaks(domain, places); });
}

ParsedDomain parse_domain(const std::string& text, const Quartiles& quartiles, Rounding rounding) {
  std::optional<ParsedDomain> whole, beside; // the points, and outcomes beside them
  for (const std::string_view part : mc::split(text, ',')) {
    const std::string one(part);
    const std::size_t equals = std::min(one.find('='), one.size());
    const std::string name(mc::trimmed(std::string_view(one).substr(0, equals)));
    const std::string_view value = std::string_view(one).substr(std::min(equals + 1, one.size()));
    if (name == "discrete") {
      mc::require(text.find(',') == std::string::npos, "'{}' stands alone", one);
      return discrete(value, one);
    }
    if (name == "outcome" && value.find(':') == std::string_view::npos) {
      mc::require(!whole && !beside, "'{}' stands first", one);
      beside = discrete(value, one);
      continue;
    }
    const std::size_t column = (whole ? whole->columns.size() : 0) + (beside ? 1 : 0);
    Part next;
    if (name == "annulus") next = annulus(value, rounding);
    else if (one.find('=') != std::string::npos) next = interval(name, value, one, quartiles, column, rounding);
    else next = named(one, rounding);
    whole = whole ? product(*whole, next) : std::move(next);
  }
  mc::require(whole.has_value(), "'{}' has no points; discrete=N has outcomes alone", text);
  if (beside) {
    whole->outcomes = beside->outcomes;
    whole->text = beside->text + " and " + whole->text;
    whole->columns.insert(whole->columns.begin(), "outcome");
  }
  std::vector<std::string> names = whole->columns;
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  mc::require(twice == names.end(), "'{}' is bounded twice in '{}'", twice == names.end() ? "" : *twice, text);
  return std::move(*whole);
}

} // namespace carlo
