#include <input/any_domain.h>

#include <mc/check/subject/chart_axes.h>
#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/domain/annulus.h>
#include <mc/domain/ball.h>
#include <mc/domain/disk.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/domain/sphere.h>
#include <mc/domain/triangle.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace carlo {

namespace {

constexpr double unit_tolerance = 1e-5, rounding = 1e-6;

template <class P> P point_from(const double* x) {
  if constexpr (std::is_arithmetic_v<P>) return x[0];
  else {
    P p;
    for (Eigen::Index i = 0; i < p.size(); ++i) p[i] = x[i];
    return p;
  }
}

template <class P> void point_to(const P& p, double* x) {
  if constexpr (std::is_arithmetic_v<P>) x[0] = p;
  else
    for (Eigen::Index i = 0; i < p.size(); ++i) x[i] = p[i];
}

// A domain of libmc over double as a part. `contains` is looser than the domain's own: files hold rounded numbers.
template <mc::Domain D>
DomainPart part(std::string text, std::vector<std::string> names, const D& d,
                std::function<bool(const double*)> contains) {
  using Point = typename D::Point;
  using Unit = typename D::UnitPoint;
  DomainPart p{std::move(text), std::move(names), mc::chart_axes(d), std::move(contains), {}, {}, {}};
  p.to_unit = [d](const double* x, double* v) {
    point_to<Unit>(d.to_unit(point_from<Point>(x)), v);
    for (int i = 0; i < D::dim; ++i) v[i] = std::clamp(v[i], 0.0, 1.0);
  };
  p.from_unit = [d](const double* v, double* x) { point_to<Point>(d.from_unit(point_from<Unit>(v)), x); };
  p.jacobian = [d](const double* v) { return d.jacobian(point_from<Unit>(v)); };
  return p;
}

double norm(const double* x, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += x[i] * x[i];
  return std::sqrt(sum);
}

// Directions are brought to length 1 first.
template <mc::Domain D>
DomainPart directions(std::string text, const D& d, std::function<bool(const double*)> contains) {
  DomainPart p = part(std::move(text), {"x", "y", "z"}, d, std::move(contains));
  p.to_unit = [to_unit = p.to_unit](const double* x, double* v) {
    const double length = norm(x, 3);
    const double unit[] = {x[0] / length, x[1] / length, std::max(x[2], -1.0) / length};
    to_unit(unit, v);
  };
  return p;
}

double number(std::string_view word, std::string_view whole) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  mc::require(error == std::errc() && end == word.data() + word.size() && !std::isnan(value),
              "--domain: '{}' in '{}' is not a number", word, whole);
  return value;
}

DomainPart interval(const std::string& name, std::string_view bounds, std::string_view whole,
                    const std::array<double, 3>& quartiles) {
  const std::size_t colon = bounds.find(':');
  mc::require(!name.empty() && colon != std::string_view::npos,
              "--domain: '{}' is not of the form name=lo:hi, as in \"x=0:1,y=-1:2\"", whole);
  const double lo = number(bounds.substr(0, colon), whole), hi = number(bounds.substr(colon + 1), whole);
  mc::require(lo < hi, "--domain: '{}' has bounds {} and {}; lo < hi is needed", whole, lo, hi);
  const std::string text = fmt::format("{} in [{:g}, {:g}]", name, lo, hi);
  const auto inside = [lo, hi](const double* x) { return x[0] >= lo && x[0] <= hi && std::isfinite(x[0]); };
  const auto scale = [](double size) { return size > 0 ? size : 1.0; };
  const auto [low, middle, high] = quartiles;
  DomainPart p;
  if (std::isinf(lo) && std::isinf(hi)) p = part(text, {name}, mc::RealLine<double>(middle, scale(high - low)), inside);
  else if (std::isinf(hi)) p = part(text, {name}, mc::HalfLine<double>(lo, scale(middle - lo)), inside);
  else if (std::isinf(lo)) p = part(text, {name}, mc::HalfLine<double>(hi, -scale(hi - middle)), inside);
  else p = part(text, {name}, mc::Interval<double>(lo, hi), inside);
  p.axes[0].name = name;
  return p;
}

DomainPart annulus(std::string_view radius) {
  const double inner = number(radius, radius);
  mc::require(inner > 0 && inner < 1, "--domain: annulus={} needs a radius in (0, 1)", radius);
  return part(
      fmt::format("the annulus {} <= r <= 1", inner), {"x", "y"}, mc::Annulus<double>(inner, 1),
      [inner](const double* x) { return std::abs(norm(x, 2) - 0.5 - inner / 2) <= 0.5 - inner / 2 + rounding; });
}

DomainPart named(const std::string& name) {
  if (name == "sphere")
    return directions(fmt::format("the unit sphere (to {:g})", unit_tolerance), mc::Sphere<double>(),
                      [](const double* x) { return std::abs(norm(x, 3) - 1) <= unit_tolerance; });
  if (name == "hemisphere")
    return directions(
        fmt::format("the unit hemisphere (to {:g})", unit_tolerance), mc::Hemisphere<double>(),
        [](const double* x) { return std::abs(norm(x, 3) - 1) <= unit_tolerance && x[2] >= -unit_tolerance; });
  if (name == "disk")
    return part("the unit disk", {"x", "y"}, mc::Disk<double>(),
                [](const double* x) { return norm(x, 2) <= 1 + rounding; });
  if (name == "ball")
    return part("the unit ball", {"x", "y", "z"}, mc::Ball<double>(),
                [](const double* x) { return norm(x, 3) <= 1 + rounding; });
  if (name == "triangle")
    return part("the triangle x, y >= 0, x + y <= 1", {"x", "y"}, mc::Triangle<double>(),
                [](const double* x) { return x[0] >= -rounding && x[1] >= -rounding && x[0] + x[1] <= 1 + rounding; });
  static const std::vector<std::string> known = {"sphere", "hemisphere", "disk",    "annulus",
                                                 "ball",   "triangle",   "discrete"};
  throw mc::Error(fmt::format("--domain: '{}' is not of the form name=lo:hi, as in \"x=0:1,y=-1:2\", nor one of {}{}",
                              name, fmt::join(known, ", "), mc::did_you_mean(name, known)));
}

} // namespace

std::vector<std::string> AnyDomain::names() const {
  if (outcomes_ > 0) return {"i"};
  std::vector<std::string> all;
  for (const DomainPart& p : parts_) all.insert(all.end(), p.names.begin(), p.names.end());
  return all;
}

std::vector<mc::Axis> AnyDomain::axes() const {
  std::vector<mc::Axis> all;
  for (const DomainPart& p : parts_) all.insert(all.end(), p.axes.begin(), p.axes.end());
  return all;
}

std::string AnyDomain::text() const {
  if (outcomes_ > 0) return fmt::format("outcomes 0 to {}", outcomes_ - 1);
  std::string all;
  for (const DomainPart& p : parts_) all += (all.empty() ? "" : ", ") + p.text;
  return all;
}

bool AnyDomain::contains(const double* x) const {
  if (outcomes_ > 0) return x[0] >= 0 && x[0] < outcomes_ && x[0] == std::floor(x[0]);
  for (const DomainPart& p : parts_) {
    if (!p.contains(x)) return false;
    x += p.names.size();
  }
  return true;
}

AnyDomain::Coordinates AnyDomain::to_unit(const double* x) const {
  Coordinates v{};
  double* at = v.data();
  for (const DomainPart& p : parts_) {
    p.to_unit(x, at);
    x += p.names.size();
    at += p.axes.size();
  }
  return v;
}

std::vector<double> AnyDomain::from_unit(const Coordinates& v) const {
  std::vector<double> x(names().size());
  const double* from = v.data();
  double* at = x.data();
  for (const DomainPart& p : parts_) {
    p.from_unit(from, at);
    from += p.axes.size();
    at += p.names.size();
  }
  return x;
}

double AnyDomain::jacobian(const Coordinates& v) const {
  double product = 1;
  const double* from = v.data();
  for (const DomainPart& p : parts_) {
    product *= p.jacobian(from);
    from += p.axes.size();
  }
  return product;
}

AnyDomain parse_domain(const std::string& text, const Quartiles& quartiles) {
  std::vector<DomainPart> parts;
  std::size_t column = 0;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string one = text.substr(begin, end - begin), name = one.substr(0, one.find('='));
    begin = end + 1;
    const std::string_view value = std::string_view(one).substr(std::min(name.size() + 1, one.size()));
    if (name == "discrete") {
      const double n = number(value, one);
      mc::require(n >= 1 && n <= 1 << 24 && n == std::floor(n), "--domain: '{}'; 1 to 2^24 outcomes are possible", one);
      mc::require(one.size() == text.size(), "--domain: '{}' stands alone", one);
      return AnyDomain({}, static_cast<int>(n));
    }
    if (name == "annulus") parts.push_back(annulus(value));
    else if (one.find('=') != std::string::npos) parts.push_back(interval(name, value, one, quartiles(column)));
    else parts.push_back(named(one));
    column += parts.back().names.size();
  }
  AnyDomain domain(std::move(parts), 0);
  mc::require(domain.dim() <= 3, "--domain: '{}' has {} dimensions; at most 3 can be checked", text, domain.dim());
  std::vector<std::string> names = domain.names();
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  mc::require(twice == names.end(), "--domain: '{}' is bounded twice in '{}'", twice == names.end() ? "" : *twice,
              text);
  return domain;
}

} // namespace carlo
