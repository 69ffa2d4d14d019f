// Boundary law: samples at the ends of the unit cube and next to the branches of the distribution.

#include <mc/check/fit/interior_density.h>
#include <mc/check/laws/find_breaks.h>
#include <mc/check/laws/law.h>

#include <limits>

namespace mc {
namespace {

using Kind = Subject::Draw::Kind;
using Uniforms = AnyDistribution::Uniforms;

bool has_zero(const AnyDistribution& s, const Uniforms& u) {
  return std::any_of(u.begin(), u.begin() + s.uniforms, [](double x) { return x == 0; });
}

// Returns the two neighbours of a coordinate in the distribution's scalar.
std::array<double, 2> beside(const AnyDistribution& s, double u) {
  if (s.is_float) return {std::nextafter(static_cast<float>(u), 0.0f), std::nextafter(static_cast<float>(u), 1.0f)};
  return {std::nextafter(u, 0.0), std::nextafter(u, 1.0)};
}

// Tests single values of u. Faults of measure zero are counted separately. Examples are u with a coordinate of exactly
// 0, and a density of 0 at one point, such as |x| at the centre. Points rounded onto an edge or a jump, where the
// density may be 0 or infinite, are counted there too.
class Probe {
 public:
  // accepted : faults of measure zero are accepted.
  Probe(const AnyDistribution& s, bool accepted) : distribution_(s), subject_(make_subject(s)), accepted_(accepted) {}

  void operator()(const Uniforms& u) {
    const bool at_zero = has_zero(distribution_, u);
    if (at_zero && distribution_.open_interval) return;
    const ChartSample p = to_chart(distribution_, distribution_.sample(u));
    const auto fault = fault_of(p);
    const bool single =
        at_zero ||
        (!fault.empty() && p.draw.kind == Kind::point &&
         (adjacent_density(subject_, p.draw.v) || (p.pdf == 0 && (subject_.density(p.draw.v) > 0 || is_single(u)))));
    if (single && accepted_) return;
    // A point of the domain where the pdf is a zero or a pole does no harm; NaN or a negative pdf is never right.
    const bool is_limit = p.pdf == 0 || p.pdf == std::numeric_limits<double>::infinity();
    WorstError& of_single = p.draw.kind == Kind::point && is_limit ? density_ : zero_;
    (single ? of_single : inner_).note(fault.empty() ? 0 : 1, [&] {
      return fmt::format("{}, at {}", fault, describe_sample(distribution_, u));
    });
  }

  // Returns the checks. A fault at single u alone does not imply a wrong density.
  std::vector<Check> checks() const {
    Check inner = inner_.check(), zero = zero_.check(), density = density_.check();
    if (accepted_) return {inner};
    if (density.verdict == Verdict::fail) density.verdict = Verdict::warning;
    if (inner.verdict == Verdict::pass && zero.verdict == Verdict::fail)
      zero.detail +=
          "; only single values of u do this: a coordinate is exactly 0 (use 1 - u instead), or rounding "
          "moves the point onto a boundary of the density or onto a point where the density is 0 or infinite; "
          "option open_interval (carlo validate --open-interval) accepts them as measure zero";
    if (zero.verdict == Verdict::fail && distribution_.open_interval)
      zero.detail += "; open_interval of the distribution itself excludes only u = 0";
    return {inner, zero, density};
  }

 private:
  // Whether the samples at both neighbours are correct.
  bool is_single(const Uniforms& u) const {
    const auto right = [&](const Uniforms& v) {
      return fault_of(to_chart(distribution_, distribution_.sample(v))).empty();
    };
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(distribution_.uniforms); ++axis) {
      const auto [lo, hi] = beside(distribution_, u[axis]);
      Uniforms below = u, above = u;
      below[axis] = lo;
      above[axis] = hi;
      if (u[axis] > 0 && above[axis] < 1 && right(below) && right(above)) return true;
    }
    return false;
  }

  std::string_view fault_of(const ChartSample& p) const {
    switch (p.draw.kind) {
    case Kind::failed: return distribution_.may_fail ? "" : "sample fails, should return a point";
    case Kind::not_finite: return "sample is not finite";
    case Kind::outside: return "sample is outside the domain";
    case Kind::atom:
    case Kind::point: return p.draw.pdf_positive ? "" : "pdf is not positive and finite";
    }
    return "";
  }

  const AnyDistribution& distribution_;
  Subject subject_;
  bool accepted_;
  WorstError inner_{"boundary and branches of u", 0, Fault::boundary};
  WorstError zero_{"single u of measure zero", 0, Fault::measure_zero};
  WorstError density_{"pdf at single u of measure zero", 0, Fault::measure_zero};
};

// Returns the tested values of a coordinate: ends, quarters and middle, with neighbours.
std::vector<double> places(const AnyDistribution& s) {
  const double h = s.epsilon() / 2;
  return {0, h, 0.25, 0.5 - h / 2, 0.5, 0.5 + h, 0.75, 1 - 0x1p-24, s.max_u()};
}

// Tests every combination of the values.
void probe_corners(const AnyDistribution& s, Probe& probe) {
  const std::vector<double> at = places(s);
  std::size_t total = 1;
  for (int i = 0; i < s.uniforms; ++i) total *= at.size();
  for (std::size_t k = 0; k < total; ++k) {
    Uniforms u{};
    std::size_t rest = k;
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.uniforms); ++i) {
      u[i] = at[rest % at.size()];
      rest /= at.size();
    }
    probe(u);
  }
}

// Tests the five nearest numbers around t, and t - h and t + h.
template <class S>
void probe_about(const AnyDistribution& s, const Uniforms& start, std::size_t axis, S t, Probe& probe) {
  using std::nextafter;
  const S h = std::numeric_limits<S>::epsilon() / 2, below = nextafter(t, S(0)), above = nextafter(t, S(1));
  Uniforms u = start;
  for (const S place : {S(t - h), nextafter(below, S(0)), below, t, above, nextafter(above, S(1)), S(t + h)}) {
    u[axis] = std::clamp(static_cast<double>(place), 0.0, s.max_u());
    probe(u);
  }
}

// Returns the point at u; if sample fails, the point of the chart at `start`.
PointArray point_at(const AnyDistribution& s, Uniforms u, const Uniforms& start) {
  if (s.open_interval)
    for (double& one : u) one = std::max(one, s.epsilon() / 2);
  if (const auto drawn = s.sample(u)) return drawn->x;
  return s.domain.from_unit ? s.domain.from_unit({start[0], start[1], start[2]}).x : PointArray{};
}

// Converts the coordinates of a point to S.
template <class S> std::vector<S> numbers_of(const AnyDistribution& s, const PointArray& x) {
  std::vector<S> numbers;
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.domain.point_size); ++i)
    numbers.push_back(static_cast<S>(x[i]));
  return numbers;
}

// Returns jumps and kinks of sample over S along one axis.
template <class S> std::vector<S> breaks_along(const AnyDistribution& s, const Uniforms& start, std::size_t axis) {
  const std::function<std::vector<S>(const S&)> map = [&](const S& t) {
    Uniforms u = start;
    u[axis] = static_cast<double>(t);
    return numbers_of<S>(s, point_at(s, u, start));
  };
  return find_breaks<S>(map, 256, 4);
}

// Returns jumps and kinks of the oracle: rounding in the distribution's own scalar hides kinks.
std::vector<Oracle> oracle_breaks_along(const AnyDistribution& s, const Uniforms& start, std::size_t axis) {
  const PointArray centre = s.domain.from_unit({start[0], start[1], start[2]}).x;
  const std::function<std::vector<Oracle>(const Oracle&)> map = [&](const Oracle& t) {
    OracleDistribution::Point u{start[0], start[1], start[2]};
    u[axis] = t;
    const auto x = s.oracle->sample(u);
    std::vector<Oracle> numbers;
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.domain.point_size); ++i)
      numbers.push_back(x ? (*x)[i] : Oracle(centre[i]));
    return numbers;
  };
  return find_breaks<Oracle>(map, 48, 2);
}

template <class S> void probe_breaks(const AnyDistribution& s, std::uint64_t seed, Probe& probe) {
  Pcg random(seed, 14);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(s.uniforms); ++axis) {
    for (int line = 0; line < (s.uniforms == 1 ? 1 : 8); ++line) {
      const Uniforms start = rounded_uniforms(s, random);
      for (const S t : breaks_along<S>(s, start, axis)) probe_about<S>(s, start, axis, t, probe);
      if (line > 0 || !s.oracle) continue;
      for (const Oracle& t : oracle_breaks_along(s, start, axis))
        probe_about<S>(s, start, axis, static_cast<S>(t), probe);
    }
  }
}

} // namespace

Findings boundary_law(const AnyDistribution& s, const LawOptions& options) {
  if (!s.sample) return {};
  Probe probe(s, options.statistics.open_interval);
  probe_corners(s, probe);
  if (s.domain.dim > 0) {
    if (s.is_float) probe_breaks<float>(s, options.statistics.seed, probe);
    else probe_breaks<double>(s, options.statistics.seed, probe);
  }
  return {probe.checks()};
}

} // namespace mc
