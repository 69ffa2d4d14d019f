#include <integrands/composed_integrands.h>

#include <integrands/parameter_draw.h>

#include <mc/core/types.h>
#include <mc/random/hash.h>

#include <cmath>
#include <complex>
#include <span>
#include <vector>

namespace carlo {

namespace {

using UnitPoint = std::span<const double>;
using Draw = ParameterDraw;

// A smooth integrand of mean size about 1.
struct Smooth {
  double truth;
  std::function<double(UnitPoint)> f;
};

Smooth constant() {
  return {1, [](UnitPoint) { return 1.0; }};
}
Smooth linear(Draw& d) {
  const std::vector<double> a = d.each(0, 2);
  const double mean = sum(a.size(), [&](std::size_t i) { return a[i] / 2; });
  return {1, [a, mean](UnitPoint x) { return sum(a.size(), [&](std::size_t i) { return a[i] * x[i]; }) / mean; }};
}
Smooth exponential(Draw& d) {
  const std::vector<double> c = d.each(-3, 3);
  const double mean = product(c.size(), [&](std::size_t i) { return std::expm1(c[i]) / c[i]; });
  return {
      1, [c, mean](UnitPoint x) { return std::exp(sum(c.size(), [&](std::size_t i) { return c[i] * x[i]; })) / mean; }};
}
// cos(phase + c . x), whose integral is the real part of that of a product of exponentials.
struct Wave {
  double phase;
  std::vector<double> c;

  explicit Wave(Draw& d) : phase(d.between(0, 2 * mc::pi<double>)), c(d.each(0.5, 20.0 / d.dim)) {}
  double operator()(UnitPoint x) const {
    return std::cos(phase + sum(c.size(), [&](std::size_t i) { return c[i] * x[i]; }));
  }
  /// The integral of cos(n (phase + c . x)).
  double integral(double n = 1) const {
    using namespace std::complex_literals;
    std::complex<double> p = std::exp(1i * (n * phase));
    for (const double a : c) p *= (std::exp(1i * (n * a)) - 1.0) / (1i * (n * a));
    return p.real();
  }
};
Smooth oscillation(Draw& d) {
  const Wave wave(d);
  return {wave.integral(), wave};
}
Smooth smooth(Draw& d) {
  switch (d.integer(0, 3)) {
  case 0: return constant();
  case 1: return linear(d);
  case 2: return exponential(d);
  default: return oscillation(d);
  }
}

// The mean of |f|, as far as few points tell; the integral where they show less.
double size_of(const UnitCubeIntegral& e) {
  mc::Pcg random(1);
  double total = 0;
  constexpr int points = 64;
  std::vector<double> u(static_cast<std::size_t>(e.dim));
  for (int i = 0; i < points; ++i) {
    for (double& x : u) x = random.uniform<double>();
    total += std::abs(e.f(u));
  }
  return std::max(total / points, std::abs(e.truth));
}

// A smooth part plus an integrand of another class on some of the axes, in a random order. Their mean sizes differ by a
// factor between 1e-3 and 1e3. Needles are left out: beside a smooth part no values reveal that no point hit them.
UnitCubeIntegral sum_with(std::uint64_t seed, const char* name, bool finite_variance) {
  std::vector<const IntegrandClass*> classes;
  for (const IntegrandClass& c : integrand_classes())
    if (c.finite_variance == finite_variance && c.name != "needle") classes.push_back(&c);
  mc::Pcg choice(mc::hash(seed, 1));
  UnitCubeIntegral rough;
  for (std::uint64_t k = 0; k == 0 || rough.dim > 8; ++k) {
    const auto i = static_cast<std::size_t>(choice.uniform<double>() * static_cast<double>(classes.size()));
    rough = classes[i]->draw(mc::hash(seed, 2, k));
  }
  Draw d(mc::hash(seed, 3), rough.dim, 8);
  const Smooth other = smooth(d);
  std::vector<std::size_t> axis(static_cast<std::size_t>(d.dim));
  for (std::size_t i = 0; i < axis.size(); ++i) {
    axis[i] = i;
    std::swap(axis[i], axis[static_cast<std::size_t>(d.integer(0, static_cast<int>(i)))]);
  }
  axis.resize(static_cast<std::size_t>(rough.dim));
  const double sign = d.between(0, 1) < 0.5 ? -1 : 1, ratio = std::pow(10, d.between(-3, 3)),
               unit = sign / size_of(rough);
  const auto at = [axis](UnitPoint x) {
    std::vector<double> part(axis.size());
    for (std::size_t i = 0; i < axis.size(); ++i) part[i] = x[axis[i]];
    return part;
  };
  return d.made(name, ratio * other.truth + unit * rough.truth,
                [=](UnitPoint x) { return ratio * other.f(x) + unit * rough.f(at(x)); });
}
UnitCubeIntegral sum_of_finite(std::uint64_t seed) { return sum_with(seed, "sum", true); }
UnitCubeIntegral sum_of_infinite(std::uint64_t seed) { return sum_with(seed, "sum_infinite", false); }

// Integrals over [0, 1] of functions of t = |x - a|, by the integral from 0.
template <class Primitive> double both_sides(double a, Primitive&& from_0) { return from_0(a) + from_0(1 - a); }

// Places inside the cube or at its corner.
std::vector<double> places(Draw& d) {
  std::vector<double> a = d.each(0, 1);
  if (d.between(0, 1) < 0.5) a.assign(a.size(), 0.0);
  return a;
}
double distance(double x, double a) { return std::max(std::abs(x - a), 0x1p-60); }

UnitCubeIntegral exp_of_step(std::uint64_t seed) {
  Draw d(seed, 1, 3);
  const std::vector<double> a = d.each(0.05, 0.95);
  const double h = d.between(-3, 5), volume = product(a.size(), [&](std::size_t i) { return a[i]; });
  return d.made("nested", 1 + std::expm1(h) * volume, [a, h](UnitPoint x) {
    for (std::size_t i = 0; i < a.size(); ++i)
      if (x[i] >= a[i]) return 1.0;
    return std::exp(h);
  });
}
UnitCubeIntegral exp_of_kink(std::uint64_t seed) {
  Draw d(seed, 1, 8);
  const std::vector<double> c = d.each(0.5, 6), a = d.each(0, 1);
  const auto side = [&](std::size_t i) {
    return both_sides(a[i], [&](double t) { return -std::expm1(-c[i] * t) / c[i]; });
  };
  return d.made("nested", product(a.size(), side), [a, c](UnitPoint x) {
    return std::exp(-sum(a.size(), [&](std::size_t i) { return c[i] * std::abs(x[i] - a[i]); }));
  });
}
// The mean of exp(b cos(2 pi m x)) is the Bessel function I0(b).
UnitCubeIntegral exp_of_wave(std::uint64_t seed) {
  Draw d(seed, 1, 6);
  const std::vector<double> b = d.each(-2, 2);
  const double m = d.integer(1, 4);
  return d.made("nested", product(b.size(), [&](std::size_t i) { return std::cyl_bessel_i(0.0, std::abs(b[i])); }),
                [b, m](UnitPoint x) {
                  return std::exp(
                      sum(b.size(), [&](std::size_t i) { return b[i] * std::cos(2 * mc::pi<double> * m * x[i]); }));
                });
}
UnitCubeIntegral log_of_power(std::uint64_t seed) {
  Draw d(seed, 1, 6);
  const std::vector<double> p = d.each(0.1, 2), a = places(d);
  const auto side = [&](std::size_t i) {
    return p[i] * both_sides(a[i], [](double t) { return t > 0 ? t - t * std::log(t) : 0; });
  };
  return d.made("nested", sum(p.size(), side), [p, a](UnitPoint x) {
    return -sum(p.size(), [&](std::size_t i) { return p[i] * std::log(distance(x[i], a[i])); });
  });
}
UnitCubeIntegral log_of_kink(std::uint64_t seed) {
  Draw d(seed, 1, 8);
  const std::vector<double> c = d.each(0.5, 20), a = d.each(0, 1);
  const auto side = [&](std::size_t i) {
    return both_sides(a[i], [&](double t) { return ((1 + c[i] * t) * std::log1p(c[i] * t) - c[i] * t) / c[i]; });
  };
  return d.made("nested", sum(a.size(), side), [a, c](UnitPoint x) {
    return sum(a.size(), [&](std::size_t i) { return std::log1p(c[i] * std::abs(x[i] - a[i])); });
  });
}
UnitCubeIntegral square_of_kink(std::uint64_t seed) {
  Draw d(seed, 1, 6);
  const std::vector<double> c = d.each(0.5, 8), a = d.each(0.05, 0.95);
  const auto side = [&](std::size_t i) {
    return both_sides(a[i], [&](double t) { return (std::pow(1 + c[i] * t, 3) - 1) / (3 * c[i]); });
  };
  return d.made("nested", product(a.size(), side), [a, c](UnitPoint x) {
    return mc::sqr(product(a.size(), [&](std::size_t i) { return 1 + c[i] * std::abs(x[i] - a[i]); }));
  });
}
// The square of a cosine is half of 1 plus the cosine of twice the angle.
UnitCubeIntegral square_of_wave(std::uint64_t seed) {
  Draw d(seed, 1, 8);
  const Wave wave(d);
  return d.made("nested", (1 + wave.integral(2)) / 2, [wave](UnitPoint x) { return mc::sqr(wave(x)); });
}
// (w y + sum |x - a|^-p)^2: terms are independent, so that the mean of the square follows from two moments of each.
UnitCubeIntegral square_of_sum(std::uint64_t seed, const char* name, double least, double most) {
  Draw d(seed, 1, 3);
  const std::vector<double> p = d.each(least, most), a = places(d);
  const double w = std::pow(10, d.between(-1, 2));
  d.dim += 1;
  const auto power = [&](std::size_t i, double q) {
    return both_sides(a[i], [&](double t) { return std::pow(t, 1 - q) / (1 - q); });
  };
  double mean = w / 2, square = w * w / 3;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double first = power(i, p[i]);
    square += power(i, 2 * p[i]) + 2 * mean * first;
    mean += first;
  }
  return d.made(name, square, [p, a, w](UnitPoint x) {
    return mc::sqr(w * x[p.size()] +
                   sum(p.size(), [&](std::size_t i) { return std::pow(distance(x[i], a[i]), -p[i]); }));
  });
}
UnitCubeIntegral square_of_singular(std::uint64_t seed) { return square_of_sum(seed, "nested", 0.02, 0.2); }
// Cut at a height: large, but of finite variance.
UnitCubeIntegral min_of_power(std::uint64_t seed) {
  Draw d(seed, 1, 3);
  const std::vector<double> p = d.each(0.1, 0.9), a = places(d);
  const double cap = std::pow(10, d.between(0.3, 2));
  const auto side = [&](std::size_t i) {
    return both_sides(a[i], [&](double t) {
      const double q = p[i], start = std::pow(cap, -1 / q);
      return t < start ? cap * t : cap * start + (std::pow(t, 1 - q) - std::pow(start, 1 - q)) / (1 - q);
    });
  };
  return d.made("nested", product(p.size(), side), [p, a, cap](UnitPoint x) {
    return product(p.size(), [&](std::size_t i) { return std::min(std::pow(distance(x[i], a[i]), -p[i]), cap); });
  });
}
// max(x_1 + ... + x_d - k, 0), by the distribution of the sum [Irwin27, Hall27].
UnitCubeIntegral max_of_sum(std::uint64_t seed) {
  Draw d(seed, 1, 8);
  const double k = d.dim * d.between(0.3, 0.8), rest = d.dim - k;
  double truth = 0, term = 1 / std::tgamma(d.dim + 2); // (-1)^j C(d, j) / (d + 1)!
  for (int j = 0; j < rest; ++j) {
    truth += term * std::pow(rest - j, d.dim + 1);
    term *= -static_cast<double>(d.dim - j) / (j + 1);
  }
  return d.made("nested", truth,
                [k](UnitPoint x) { return std::max(sum(x.size(), [&](std::size_t i) { return x[i]; }) - k, 0.0); });
}
// max(x^-p, y^-q): both are at least 1, and P(x^-p > t) = t^(-1 / p).
UnitCubeIntegral max_of_powers(std::uint64_t seed, const char* name, double least, double most) {
  Draw d(seed, 2, 2);
  const std::vector<double> p = d.each(least, most);
  const double truth = 1 + p[0] / (1 - p[0]) + p[1] / (1 - p[1]) - 1 / (1 / p[0] + 1 / p[1] - 1);
  return d.made(name, truth, [p](UnitPoint x) {
    return std::max(std::pow(distance(x[0], 0), -p[0]), std::pow(distance(x[1], 0), -p[1]));
  });
}
UnitCubeIntegral max_of_singular(std::uint64_t seed) { return max_of_powers(seed, "nested", 0.05, 0.4); }

template <std::size_t N>
UnitCubeIntegral one_of(std::uint64_t seed, UnitCubeIntegral (*const (&kinds)[N])(std::uint64_t)) {
  return kinds[mc::hash(seed, 1) % N](mc::hash(seed, 2));
}

UnitCubeIntegral nested(std::uint64_t seed) {
  return one_of(seed, {exp_of_step, exp_of_kink, exp_of_wave, log_of_power, log_of_kink, square_of_kink,
                       square_of_singular, square_of_wave, min_of_power, max_of_sum, max_of_singular});
}
UnitCubeIntegral nested_infinite(std::uint64_t seed) {
  constexpr auto square = [](std::uint64_t s) { return square_of_sum(s, "nested_infinite", 0.27, 0.45); };
  constexpr auto largest = [](std::uint64_t s) { return max_of_powers(s, "nested_infinite", 0.55, 0.9); };
  return one_of(seed, {+square, +largest});
}

} // namespace

const std::vector<IntegrandClass>& composed_integrand_classes() {
  static const std::vector<IntegrandClass> list = {
      {"sum", "a smooth function plus an integrand of another class", true, sum_of_finite},
      {"sum_infinite", "a smooth function plus an integrand of infinite variance", false, sum_of_infinite},
      {"nested", "exp, log, square, min or max of another integrand", true, nested},
      {"nested_infinite", "a square or maximum of infinite variance", false, nested_infinite}};
  return list;
}

} // namespace carlo
