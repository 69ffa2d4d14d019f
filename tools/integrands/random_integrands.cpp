#include <integrands/parameter_draw.h>
#include <integrands/random_integrands.h>

#include <mc/core/probit.h>
#include <mc/core/types.h>

#include <cmath>
#include <complex>
#include <numeric>
#include <utility>

namespace carlo {

namespace {

using UnitPoint = std::span<const double>;
using Draw = ParameterDraw;

// The product of term(i) over the axes, one for each element of `a`.
template <class Term> double product(const std::vector<double>& a, Term&& term) {
  return carlo::product(a.size(), std::forward<Term>(term));
}

UnitCubeIntegral step(std::uint64_t seed) {
  Draw d(seed, 1, 3);
  const std::vector<double> a = d.each(0.05, 0.95);
  return d.made("step", product(a, [&](std::size_t i) { return a[i]; }), [a](UnitPoint x) {
    for (std::size_t i = 0; i < a.size(); ++i)
      if (x[i] >= a[i]) return 0.0;
    return 1.0;
  });
}

UnitCubeIntegral box(std::uint64_t seed) {
  Draw d(seed, 1, 3);
  const std::vector<double> lo = d.each(0, 0.7), width = d.each(0.1, 0.3);
  return d.made("box", product(lo, [&](std::size_t i) { return width[i]; }), [lo, width](UnitPoint x) {
    for (std::size_t i = 0; i < lo.size(); ++i)
      if (x[i] < lo[i] || x[i] >= lo[i] + width[i]) return 0.0;
    return 1.0;
  });
}

UnitCubeIntegral jump(std::uint64_t seed) {
  Draw d(seed, 2, 8);
  const std::vector<double> c = d.each(0.2, 4), a = d.each(0.1, 0.9);
  const auto truth = [&](std::size_t i) { return std::expm1(i < 2 ? c[i] * a[i] : c[i]) / c[i]; };
  return d.made("jump", product(c, truth), [c, a](UnitPoint x) {
    if (x[0] > a[0] || x[1] > a[1]) return 0.0;
    double s = 0;
    for (std::size_t i = 0; i < c.size(); ++i) s += c[i] * x[i];
    return std::exp(s);
  });
}

UnitCubeIntegral kink(std::uint64_t seed) {
  Draw d(seed, 1, 6);
  const std::vector<double> c = d.each(0.5, 8), a = d.each(0.05, 0.95);
  const double truth = product(c, [&](std::size_t i) { return 1 + c[i] * (mc::sqr(a[i]) + mc::sqr(1 - a[i])) / 2; });
  return d.made("kink", truth, [c, a](UnitPoint x) {
    double f = 1;
    for (std::size_t i = 0; i < c.size(); ++i) f *= 1 + c[i] * std::abs(x[i] - a[i]);
    return f;
  });
}

UnitCubeIntegral shell(std::uint64_t seed) {
  Draw d(seed, 2, 3);
  const double outer = d.between(0.15, 0.35), inner = outer - d.between(0.01, 0.1);
  const std::vector<double> c = d.each(0.36, 0.64);
  const double pi = mc::pi<double>, power = d.dim == 2 ? pi : 4 * pi / 3;
  return d.made("shell", power * (std::pow(outer, d.dim) - std::pow(inner, d.dim)), [=](UnitPoint x) {
    double r2 = 0;
    for (std::size_t i = 0; i < c.size(); ++i) r2 += mc::sqr(x[i] - c[i]);
    return r2 < outer * outer && r2 >= inner * inner ? 1.0 : 0.0;
  });
}

UnitCubeIntegral power_law(const char* name, Draw d, double least, double most) {
  const std::vector<double> p = d.each(least, most);
  std::vector<double> a = d.each(0, 1);
  if (d.between(0, 1) < 0.5) a.assign(a.size(), 0.0);
  const auto side = [&](std::size_t i) {
    return (std::pow(a[i], 1 - p[i]) + std::pow(1 - a[i], 1 - p[i])) / (1 - p[i]);
  };
  return d.made(name, product(p, side), [p, a](UnitPoint x) {
    // The value at the singular point itself is clamped. A sample hits it with probability 2^-53.
    double f = 1;
    for (std::size_t i = 0; i < p.size(); ++i) f *= std::pow(std::max(std::abs(x[i] - a[i]), 0x1p-60), -p[i]);
    return f;
  });
}
UnitCubeIntegral singular(std::uint64_t seed) { return power_law("singular", Draw(seed, 1, 3), 0.1, 0.4); }
UnitCubeIntegral infinite(std::uint64_t seed) { return power_law("infinite", Draw(seed, 1, 2), 0.5, 0.95); }

UnitCubeIntegral peaks(std::uint64_t seed) {
  Draw d(seed, 2, 6);
  struct Peak {
    std::vector<double> centre;
    double width, height;
  };
  std::vector<Peak> all;
  double truth = 0;
  for (int k = d.integer(1, 3); k > 0; --k) {
    const Peak p{d.each(0.15, 0.85), d.between(0.06, 0.2), d.between(0.3, 3)};
    const auto side = [&](std::size_t i) {
      const double s = p.width * std::sqrt(2.0);
      return std::sqrt(mc::pi<double>) / 2 * s * (std::erf((1 - p.centre[i]) / s) + std::erf(p.centre[i] / s));
    };
    truth += p.height * product(p.centre, side);
    all.push_back(p);
  }
  return d.made("peaks", truth, [all](UnitPoint x) {
    double sum = 0;
    for (const Peak& p : all) {
      double r2 = 0;
      for (std::size_t i = 0; i < x.size(); ++i) r2 += mc::sqr(x[i] - p.centre[i]);
      sum += p.height * std::exp(-r2 / (2 * p.width * p.width));
    }
    return sum;
  });
}

// Random orthonormal rows.
std::vector<std::vector<double>> turned_axes(Draw& d) {
  std::vector<std::vector<double>> rows;
  for (int k = 0; k < d.dim; ++k) {
    std::vector<double> row = d.each(-1, 1);
    for (const std::vector<double>& other : rows) {
      const double along = std::inner_product(row.begin(), row.end(), other.begin(), 0.0);
      for (std::size_t i = 0; i < row.size(); ++i) row[i] -= along * other[i];
    }
    const double length = std::sqrt(std::inner_product(row.begin(), row.end(), row.begin(), 0.0));
    for (double& x : row) x /= length;
    rows.push_back(row);
  }
  return rows;
}

// A Gaussian with five standard deviations inside the cube on every side: 6e-7 of its mass is outside.
UnitCubeIntegral turned(const char* name, Draw& d, const std::vector<double>& width) {
  const std::vector<std::vector<double>> axes = turned_axes(d);
  const std::vector<double> centre = d.each(0.42, 0.58);
  const double truth = product(width, [&](std::size_t i) { return std::sqrt(2 * mc::pi<double>) * width[i]; });
  return d.made(name, truth, [axes, centre, width](UnitPoint x) {
    double sum = 0;
    for (std::size_t k = 0; k < width.size(); ++k) {
      double along = 0;
      for (std::size_t i = 0; i < x.size(); ++i) along += axes[k][i] * (x[i] - centre[i]);
      sum += mc::sqr(along / width[k]);
    }
    return std::exp(-sum / 2);
  });
}

UnitCubeIntegral ridge(std::uint64_t seed) {
  Draw d(seed, 2, 3);
  return turned("ridge", d, d.each(0.008, 0.08));
}

// 1.5 to 20 times as long as thick.
UnitCubeIntegral needle(std::uint64_t seed) {
  Draw d(seed, 4, 5);
  const double length = d.between(0.03, 0.07), thickness = length * std::pow(0.05, d.between(0.12, 1));
  std::vector<double> width(static_cast<std::size_t>(d.dim), thickness);
  width.front() = length;
  return turned("needle", d, width);
}

UnitCubeIntegral wave(std::uint64_t seed) {
  using namespace std::complex_literals;
  Draw d(seed, 1, 8);
  const double phase = d.between(0, 2 * mc::pi<double>);
  const std::vector<double> c = d.each(0.5, 20.0 / d.dim);
  std::complex<double> p = std::exp(1i * phase);
  for (const double a : c) p *= (std::exp(1i * a) - 1.0) / (1i * a);
  return d.made("wave", p.real(), [phase, c](UnitPoint x) {
    double s = phase;
    for (std::size_t i = 0; i < c.size(); ++i) s += c[i] * x[i];
    return std::cos(s);
  });
}

UnitCubeIntegral powers(std::uint64_t seed) {
  Draw d(seed, 5, 20);
  const double p = d.between(0.5, 1);
  return d.made("product", std::pow(std::pow(2.0, p) / (1 + p), d.dim), [p](UnitPoint x) {
    double f = 1;
    for (const double u : x) f *= std::abs(4 * u - 2);
    return std::pow(f, p);
  });
}

// The area of a x + b y < c in the unit square.
double half_plane(double a, double b, double c) {
  const auto square = [](double x) { return mc::sqr(std::max(x, 0.0)); };
  return (square(c) - square(c - a) - square(c - b) + square(c - a - b)) / (2 * a * b);
}

UnitCubeIntegral aligned(std::uint64_t seed) {
  Draw d(seed, 1, 2);
  if (d.dim == 2 && d.integer(0, 1) == 0) {
    // e^(k y) plus or times a jump near the end of an interval of the net.
    const double k = d.between(0.5, 3), smooth = std::expm1(k) / k, height = std::exp(d.between(-3, 3));
    const double at = (d.integer(1, 63) + std::copysign(std::exp2(-d.between(3, 8)), d.between(-1, 1))) / 64;
    if (d.integer(0, 1) == 0)
      return d.made("aligned", smooth * at, [=](UnitPoint x) { return x[0] < at ? std::exp(k * x[1]) : 0.0; });
    return d.made("aligned", smooth + height * at,
                  [=](UnitPoint x) { return std::exp(k * x[1]) + (x[0] < at ? height : 0.0); });
  }
  if (d.dim == 2) {
    const double a = d.integer(1, 3), b = d.integer(1, 3), c = (a + b) * d.integer(1, 7) / 8;
    return d.made("aligned", half_plane(a, b, c), [=](UnitPoint x) { return a * x[0] + b * x[1] < c ? 1.0 : 0.0; });
  }
  const int kind = d.integer(0, 2);
  const double k = d.between(0.5, 3);
  if (kind == 0)
    return d.made("aligned", 1 + std::exp(-k * k / 2), [k](UnitPoint x) { return 1 + std::cos(k * mc::probit(x[0])); });
  const double n = kind == 1 ? d.between(2, 20) : d.integer(100, 10'000), whole = std::floor(n);
  if (kind == 1)
    return d.made("aligned", whole * ((whole - 1) / 2 + n - whole) / n,
                  [n](UnitPoint x) { return std::floor(n * x[0]); });
  return d.made("aligned", std::expm1(k) / (n * std::expm1(k / n)),
                [k, n](UnitPoint x) { return std::exp(k * std::floor(n * x[0]) / n); });
}

} // namespace

const std::vector<IntegrandClass>& integrand_classes() {
  static const std::vector<IntegrandClass> list = {
      {"step", "1 below a place on each axis", true, step},
      {"box", "1 in a box", true, box},
      {"jump", "a step times an exponential", true, jump},
      {"kink", "a product of 1 + c |x - a|", true, kink},
      {"shell", "1 between two spheres", true, shell},
      {"singular", "a product of |x - a|^-p, p up to .4", true, singular},
      {"infinite", "a product of |x - a|^-p, p from .5 to .95", false, infinite},
      {"peaks", "up to three Gaussians", true, peaks},
      {"ridge", "a Gaussian with turned axes", true, ridge},
      {"needle", "a long thin one, that few points meet", true, needle},
      {"wave", "the cosine of a linear form", true, wave},
      {"product", "a product of |4 x - 2|^p", true, powers},
      {"aligned", "edges and periods that fit the points", true, aligned}};
  return list;
}

} // namespace carlo
