#pragma once
// Tests the stated bounds of warps at random parameters over their whole legal range, against the 50-digit oracle.

#include <mc/check/subject/oracle.h>
#include <mc/core/error.h>
#include <mc/random/pcg.h>
#include <mc/warp/concept.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sweep {

/// The bounds that a warp states at one point, in machine epsilons of its scalar.
///   sample : |sample(u) - exact| / max(scale, |exact|).
///   pdf    : |pdf(x) / exact - 1|.
///   invert : |invert(sample(u)) - u|.
///   reversal : (sample(u) - sample(v)) / max(scale, |sample(u)|) for the next number v after u, in one dimension.
struct Bounds {
  double sample = 16, pdf = 16, invert = 16, scale = 1, reversal = 0;
};

/// One law over all trials of a warp: its worst error as a multiple of the bound, and its place.
struct Law {
  double worst = 0; ///< error / bound
  double eps = 0;   ///< the same error in epsilons
  std::uint64_t broken = 0, points = 0;
  std::string worst_case; ///< place of the worst error, if it violates the bound

  template <class Describe> void note(double error, double bound, Describe&& describe) {
    ++points;
    const double ratio = error / bound;
    const bool holds = ratio <= 1;
    broken += holds ? 0 : 1;
    if (ratio <= worst) return;
    if (!holds && worst != worst) return; // NaN is the worst
    worst = ratio;
    eps = error;
    if (!holds) worst_case = describe();
  }
};

struct Row {
  std::string name;
  int tried = 0, refused = 0;
  Law edges, sample, pdf, invert, monotone;
};

struct Effort {
  int trials = 2000, points = 40;
  std::uint64_t seed = 1;
};

/// Draws random parameters.
struct Draw {
  mc::Pcg& random;
  double u() { return random.uniform<double>(); }
  bool often(double chance) { return u() < chance; }
  /// Log-uniform over [lo, hi], sometimes exactly lo or hi.
  double log(double lo, double hi) {
    const double v = u();
    if (v < 0.02) return lo;
    if (v > 0.98) return hi;
    return std::exp(std::log(lo) + u() * (std::log(hi) - std::log(lo)));
  }
  double sign() { return often(0.5) ? 1 : -1; }
  int below(int n) { return static_cast<int>(u() * n); }
  /// Unit vector, sometimes close to an axis or in a coordinate plane.
  template <class S> mc::Vec3<S> direction() {
    mc::Vec3<double> d(u() - 0.5, u() - 0.5, u() - 0.5);
    for (int i = 0; i < 3; ++i)
      if (often(0.2)) d[i] *= log(1e-20, 1);
    if (!(d.norm() > 0)) d = {0, 0, 1};
    return d.normalized().cast<S>().normalized();
  }
  /// A number of [0,1): uniform, at an end, or next to an end.
  template <class S> S unit() {
    const double v = u();
    if (v < 0.05) return S(0);
    if (v < 0.1) return mc::one_minus_epsilon<S>;
    if (v < 0.2) return S(std::ldexp(u(), -below(std::same_as<S, float> ? 24 : 53)));
    return random.uniform<S>();
  }
};

template <class S> inline constexpr double largest = static_cast<double>(std::numeric_limits<S>::max());
template <class S> inline constexpr double smallest = static_cast<double>(std::numeric_limits<S>::min());
template <class S> inline constexpr double denormal = static_cast<double>(std::numeric_limits<S>::denorm_min());

namespace detail {
template <class P> std::string text(const P& x) {
  if constexpr (requires { x.size(); }) {
    std::string s = "(";
    for (int i = 0; i < x.size(); ++i) s += fmt::format("{}{:.9g}", i ? ", " : "", static_cast<double>(x[i]));
    return s + ")";
  } else return fmt::format("{:.9g}", static_cast<double>(x));
}
template <class P> double component(const P& x, int i) {
  if constexpr (requires { x.size(); }) return static_cast<double>(x[i]);
  else return static_cast<double>(x);
}
template <class P> double size(const P& x) {
  if constexpr (requires { x.norm(); }) return static_cast<double>(x.norm());
  else return std::abs(static_cast<double>(x));
}
template <class P> bool finite(const P& x) {
  if constexpr (requires { x.allFinite(); }) return x.allFinite();
  else return std::isfinite(x);
}
template <class P, class V> V& entry(P& x, int i) {
  if constexpr (requires { x.size(); }) return x[i];
  else return x;
}

template <class W> struct Prober {
  using S = typename W::Scalar;
  static constexpr int dim = W::Domain::dim;
  const W& warp;
  const std::string& parameters;
  Row& row;
  double eps = static_cast<double>(std::numeric_limits<S>::epsilon());

  std::string where(const mc::UnitPointOf<W>& u) const { return fmt::format("{} u {}", parameters, text(u)); }

  template <class O, class BoundsAt> void probe(const O& oracle, const mc::UnitPointOf<W>& u, const BoundsAt& at) {
    const mc::PointOf<W> x = warp.sample(u);
    const double density = static_cast<double>(warp.pdf(x));
    const bool good = finite(x) && warp.domain().contains(x) && density > 0 && std::isfinite(density);
    row.edges.note(good ? 0 : 2, 1, [&] { return fmt::format("{}: x {} pdf {:.9g}", where(u), text(x), density); });
    if (!finite(x)) return;
    const Bounds bounds = at(u, x);
    double off = distance(x, oracle.sample(mc::cast_point<mc::Oracle>(u)), bounds.scale);
    // If the density vanishes at an end, the warp replaces u by half a step of u there. The 50-digit oracle has a
    // different step, so the step of S is tried.
    for (const double half_step : {eps / 4, eps / 2, eps / 8}) {
      if (off <= bounds.sample) break;
      auto wide = mc::cast_point<mc::Oracle>(u);
      for (int i = 0; i < dim; ++i) {
        mc::Oracle& v = entry<decltype(wide), mc::Oracle>(wide, i);
        if (v < half_step) v = half_step;
      }
      off = std::min(off, distance(x, oracle.sample(wide), bounds.scale));
    }
    row.sample.note(off, bounds.sample,
                    [&] { return fmt::format("{}: x {} is {:.3g} eps off", where(u), text(x), off); });
    const mc::Oracle truth = oracle.pdf(exactly(x));
    if (truth > 0) { // a denormal density has no relative precision
      const mc::Oracle error = abs(mc::Oracle(mc::Oracle(warp.pdf(x)) - truth));
      const double wrong = static_cast<double>(mc::Oracle(error / std::max(truth, mc::Oracle(smallest<S>)))) / eps;
      row.pdf.note(wrong, bounds.pdf, [&] {
        return fmt::format("{}: x {} pdf {:.9g} is {:.3g} eps off", where(u), text(x), density, wrong);
      });
    }
    if constexpr (mc::InvertibleWarp<W>) inverse(u, x, bounds.invert);
  }

  /// A direction is a unit vector only to the precision of its scalar: it is normalized for the oracle.
  static auto exactly(const mc::PointOf<W>& x) {
    auto wide = mc::cast_point<mc::Oracle>(x);
    if constexpr (W::Domain::measure == mc::Measure::solid_angle) wide.normalize();
    return wide;
  }

  template <class P> double distance(const mc::PointOf<W>& x, const P& exact, double scale) const {
    return size(P(mc::cast_point<mc::Oracle>(x) - exact)) / std::max(scale, size(exact)) / eps;
  }

  void inverse(const mc::UnitPointOf<W>& u, const mc::PointOf<W>& x, double bound) {
    const mc::UnitPointOf<W> back = warp.invert(x);
    double worst = 0;
    for (int i = 0; i < dim; ++i)
      if (!(component(back, i) >= 0 && component(back, i) < 1)) worst = HUGE_VAL;
    if (worst > 0)
      return row.invert.note(worst, bound, [&] { return fmt::format("{}: inverted {}", where(u), text(back)); });
    // An end of one coordinate may be a singular point of the chart for another: a pole has no azimuth.
    bool end = false;
    for (int i = 0; i < dim; ++i) {
      const double v = component(u, i);
      end |= v == 0 || v > 1 - eps;
    }
    if (end && size(mc::PointOf<W>(warp.sample(back) - x)) <= 4 * eps * size(x))
      return row.invert.note(0, bound, [] { return ""; });
    for (int i = 0; i < dim; ++i) {
      double off = std::abs(component(back, i) - component(u, i));
      if (off > 0.5 && size(mc::PointOf<W>(warp.sample(back) - x)) <= 64 * eps * std::max(1.0, size(x)))
        off = std::abs(1 - off);
      worst = off <= worst ? worst : off;
    }
    row.invert.note(worst / eps, bound, [&] { return fmt::format("{}: inverted {}", where(u), text(back)); });
  }

  void ascends(const S& u, const Bounds& bounds) {
    if constexpr (dim == 1) {
      const S next = std::nextafter(u, S(1));
      if (!(next < 1)) return;
      const S a = warp.sample(u), b = warp.sample(next);
      const bool holds =
          a <= b || double(a) - double(b) <= bounds.reversal * eps * std::max(bounds.scale, std::abs(double(a)));
      row.monotone.note(holds ? 0 : 2, 1, [&] { return fmt::format("{}: x {} then {}", where(u), text(a), text(b)); });
    }
  }
};
} // namespace detail

/// make(draw, parameters) returns the warp, or throws mc::Error if it rejects the parameters. bounds(warp) maps (u, x)
/// to Bounds.
template <class Make, class BoundsOf> Row run(std::string name, const Effort& effort, Make make, BoundsOf bounds_of) {
  Row row;
  row.name = std::move(name);
  mc::Pcg random(effort.seed, 31);
  Draw draw{random};
  for (int k = 0; k < effort.trials; ++k) {
    ++row.tried;
    std::string parameters;
    using W = decltype(make(draw, parameters));
    std::optional<W> warp;
    try {
      warp.emplace(make(draw, parameters));
    } catch (const mc::Error&) {
      ++row.refused;
      continue;
    }
    try {
      const auto at = bounds_of(*warp);
      const auto oracle = warp->template cast<mc::Oracle>();
      detail::Prober<W> prober{*warp, parameters, row};
      for (int i = 0; i < effort.points; ++i) {
        mc::UnitPointOf<W> u;
        using S = typename W::Scalar;
        if constexpr (W::Domain::dim == 1) {
          u = draw.template unit<S>();
          prober.ascends(u, at(u, warp->sample(u)));
        } else {
          for (int j = 0; j < W::Domain::dim; ++j) u[j] = draw.template unit<S>();
        }
        prober.probe(oracle, u, at);
      }
    } catch (const mc::Error& e) { // accepted parameters must not be rejected later
      row.edges.note(2, 1, [&] { return fmt::format("{}: {}", parameters, e.what()); });
    }
  }
  return row;
}

/// The same bounds at every point.
inline auto constant(Bounds b) {
  return [b](const auto&) { return [b](const auto&, const auto&) { return b; }; };
}

std::vector<Row> intervals(const Effort& effort);
std::vector<Row> planes(const Effort& effort);
std::vector<Row> spheres(const Effort& effort);
std::vector<Row> lobes(const Effort& effort);
std::vector<Row> lights(const Effort& effort);

} // namespace sweep
