#include "seconds_integrals.h"

#include <mc/core/types.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

namespace bench {

namespace {

using carlo::UnitCubeIntegral;
using Point = std::span<const double>;

double sum(Point x) { return std::accumulate(x.begin(), x.end(), 0.0); }

UnitCubeIntegral integral(std::string name, int dim, double truth, std::function<double(Point)> f) {
  UnitCubeIntegral e{};
  e.name = std::move(name);
  e.dim = dim;
  e.truth = truth;
  e.f = std::move(f);
  return e;
}

// Integral of g over [0, 1] by Simpson's rule, for truths without closed form.
template <class F> double simpson(F&& g) {
  constexpr int n = 20000;
  double s = g(0.0) + g(1.0);
  for (int i = 1; i < n; ++i) s += (i % 2 == 1 ? 4 : 2) * g(double(i) / n);
  return s / (3.0 * n);
}

UnitCubeIntegral smooth() {
  const double one = 1 + (1 - std::cos(3.0)) / 6;
  return integral("smooth_4d", 4, std::pow(one, 4), [](Point x) {
    double f = 1;
    for (const double c : x) f *= 1 + std::sin(3 * c) / 2;
    return f;
  });
}

UnitCubeIntegral kinks() {
  double truth = 1;
  for (int i = 0; i < 6; ++i) {
    const double c = 0.2 + 0.1 * i;
    truth *= (2 - std::exp(-4 * c) - std::exp(-4 * (1 - c))) / 4;
  }
  return integral("kinks_6d", 6, truth, [](Point x) {
    double s = 0, c = 0.2;
    for (std::size_t i = 0; i < 6; ++i, c += 0.1) s += std::abs(x[i] - c);
    return std::exp(-4 * s);
  });
}

UnitCubeIntegral slanted_step() {
  return integral("slanted_step_2d", 2, std::exp(0.7) - 1.7,
                  [](Point x) { return x[0] + x[1] < 0.7 ? std::exp(x[0]) : 0.0; });
}

// Normal density with equal correlations c: the inverse covariance is (I - k J) / (s^2 (1 - c)), k = c / (1 + 4 c).
UnitCubeIntegral tilted_bell() {
  constexpr double s = 0.03, c = 0.8, k = c / (1 + 4 * c);
  const double determinant = std::pow(s, 10) * std::pow(1 - c, 4) * (1 + 4 * c);
  const double scale = 1 / std::sqrt(std::pow(2 * mc::pi<double>, 5) * determinant);
  return integral("tilted_bell_5d", 5, 1, [scale](Point x) {
    double total = 0, squares = 0;
    for (std::size_t i = 0; i < 5; ++i) {
      const double d = x[i] - 0.4 - 0.05 * double(i);
      total += d;
      squares += d * d;
    }
    return scale * std::exp(-0.5 * (squares - k * total * total) / (s * s * (1 - c)));
  });
}

UnitCubeIntegral shell() {
  const double radial = simpson([](double r) { return std::pow(r, 7) * std::exp(-mc::sqr((r - 0.5) / 0.05)); });
  return integral("shell_8d", 8, 2 * std::pow(mc::pi<double>, 4) / 6 * radial / 256, [](Point x) {
    double r2 = 0;
    for (const double c : x) r2 += c * c;
    return std::exp(-mc::sqr((std::sqrt(r2) - 0.5) / 0.05));
  });
}

UnitCubeIntegral corner_singularity() {
  return integral("corner_singularity_2d", 2, 1 / 0.36, [](Point x) { return std::pow(x[0] * x[1], -0.4); });
}

UnitCubeIntegral basket() {
  double truth = 0, binomial = 1;
  for (int k = 0; k <= 4; ++k) {
    truth += (k % 2 ? -1 : 1) * binomial * std::pow(5 - k, 11) / 39916800;
    binomial *= double(10 - k) / (k + 1);
  }
  return integral("basket_10d", 10, truth, [](Point x) { return std::max(sum(x) - 5, 0.0); });
}

UnitCubeIntegral decaying_exponential() {
  double truth = 1;
  for (int i = 1; i <= 20; ++i) truth *= i * std::expm1(1.0 / i);
  return integral("decaying_exponential_20d", 20, truth, [](Point x) {
    double s = 0;
    for (std::size_t i = 0; i < 20; ++i) s += x[i] / double(i + 1);
    return std::exp(s);
  });
}

UnitCubeIntegral two_bells() {
  const auto one = [](double c) {
    const double w = 0.1 * std::sqrt(2.0);
    return std::sqrt(mc::pi<double>) / 2 * w * (std::erf((1 - c) / w) + std::erf(c / w));
  };
  return integral("two_bells_3d", 3, std::pow(one(0.25), 3) + std::pow(one(0.7), 3), [](Point x) {
    double a = 0, b = 0;
    for (const double c : x) {
      a += mc::sqr(c - 0.25);
      b += mc::sqr(c - 0.7);
    }
    return std::exp(-50 * a) + std::exp(-50 * b);
  });
}

UnitCubeIntegral wave() {
  const std::complex<double> i(0, 1), one = (std::exp(3.0 * i) - 1.0) / (3.0 * i);
  return integral("wave_6d", 6, 2 + std::pow(one, 6).real(), [](Point x) { return 2 + std::cos(3 * sum(x)); });
}

UnitCubeIntegral line_and_power() {
  return integral("line_and_power_2d", 2, 50 + 1 / 0.6, [](Point x) { return 100 * x[1] + std::pow(x[0], -0.4); });
}

UnitCubeIntegral ball() {
  return integral("ball_4d", 4, mc::sqr(mc::pi<double>) / 2 * std::pow(0.4, 4), [](Point x) {
    double r2 = 0;
    for (const double c : x) r2 += mc::sqr(c - 0.5);
    return r2 < 0.16 ? 1.0 : 0.0;
  });
}

UnitCubeIntegral product_peak() {
  return integral("product_peak_8d", 8, std::pow(2 / 0.2 * std::atan(0.5 / 0.2), 8), [](Point x) {
    double f = 1;
    for (const double c : x) f /= 0.04 + mc::sqr(c - 0.5);
    return f;
  });
}

UnitCubeIntegral logarithms() {
  return integral("logarithms_5d", 5, 1, [](Point x) {
    double f = 1;
    for (const double c : x) f *= -std::log(c);
    return f;
  });
}

UnitCubeIntegral largest() {
  return integral("largest_12d", 12, 12.0 / 13, [](Point x) { return *std::max_element(x.begin(), x.end()); });
}

UnitCubeIntegral root_of_difference() {
  return integral("root_of_difference_2d", 2, 8.0 / 15, [](Point x) { return std::sqrt(std::abs(x[0] - x[1])); });
}

} // namespace

std::vector<UnitCubeIntegral> seconds_integrals() {
  return {smooth(),         kinks(),
          slanted_step(),   tilted_bell(),
          shell(),          corner_singularity(),
          basket(),         decaying_exponential(),
          two_bells(),      wave(),
          line_and_power(), ball(),
          product_peak(),   logarithms(),
          largest(),        root_of_difference()};
}

} // namespace bench
