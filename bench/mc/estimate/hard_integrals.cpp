#include "hard_integrals.h"

#include <mc/core/erf.h>
#include <mc/core/types.h>

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace carlo {

namespace {

using UnitPoint = std::span<const double>;
const double pi = mc::pi<double>;

double distance2(UnitPoint x, double centre) {
  double r2 = 0;
  for (const double u : x) r2 += mc::sqr(u - centre);
  return r2;
}

// Integral over [0,1] of exp(-(x - a)^2 / 2 s^2).
double bell(double a, double s) {
  return s * std::sqrt(pi / 2) * (std::erf((1 - a) / s / std::sqrt(2.0)) + std::erf(a / s / std::sqrt(2.0)));
}

constexpr double peak = 0.07;
double two_peaks(UnitPoint x) {
  return std::exp(-distance2(x, 0.3) / (2 * peak * peak)) + std::exp(-distance2(x, 0.7) / (2 * peak * peak));
}

double absolute_product(UnitPoint x) {
  double f = 1;
  for (const double u : x) f *= std::abs(4 * u - 2);
  return f;
}

// Call option on the geometric mean of 50 prices of a lognormal walk: price and strike 100, volatility .3, rate .05,
// one year.
constexpr double volatility = 0.3, rate = 0.05;
constexpr int days = 50;
double asian(UnitPoint u) {
  double walk = 0, sum = 0;
  for (const double x : u) {
    walk += (rate - volatility * volatility / 2) / days +
            volatility / std::sqrt(double(days)) * -std::sqrt(2.0) * mc::erfc_inv(2 * x);
    sum += walk;
  }
  return std::exp(-rate) * std::max(100 * std::exp(sum / days) - 100, 0.0);
}
// Exact value: the logarithm of the geometric mean is normal.
double asian_truth() {
  const double n = days, mean = (rate - volatility * volatility / 2) * (n + 1) / (2 * n);
  const double s = volatility * std::sqrt((n + 1) * (2 * n + 1) / (6 * n * n));
  const auto below = [](double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; };
  return 100 * std::exp(-rate) * (std::exp(mean + s * s / 2) * below(mean / s + s) - below(mean / s));
}

constexpr std::array box_lo = {0.1374, 0.5193, 0.3071}, box_hi = {0.3021, 0.9226, 0.4459};
double box(UnitPoint x) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i] < box_lo[i] || x[i] >= box_hi[i]) return 0;
  return 1;
}
double box_truth() {
  double volume = 1;
  for (std::size_t i = 0; i < box_lo.size(); ++i) volume *= box_hi[i] - box_lo[i];
  return volume;
}

constexpr double shell_inner = 0.33, shell_outer = 0.34;
double shell(UnitPoint x) {
  const double r2 = distance2(x, 0.47);
  return r2 < mc::sqr(shell_outer) && r2 >= mc::sqr(shell_inner) ? 1 : 0;
}

// A Gaussian ten times as long as wide, along (1, 2, 2) / 3. The share outside of the cube is below 1e-11.
constexpr double ridge_width = 0.006, ridge_length = 0.06;
double ridge(UnitPoint x) {
  const double along = (x[0] - 0.5 + 2 * (x[1] - 0.5) + 2 * (x[2] - 0.5)) / 3,
               across2 = distance2(x, 0.5) - along * along;
  return std::exp(-(mc::sqr(along / ridge_length) + across2 / mc::sqr(ridge_width)) / 2);
}

// The shares of the hole in the middle and of the region outside of the square are below 1e-100.
constexpr double ring_radius = 0.3, ring_width = 0.008;
double ring(UnitPoint x) { return std::exp(-mc::sqr((std::sqrt(distance2(x, 0.5)) - ring_radius) / ring_width) / 2); }

double corner(UnitPoint x) { return std::pow(std::max(x[0] * x[1] * x[2], 1e-300), -0.4); }

// |x - c|^-1.2 in a ball about c inside the cube.
constexpr double pole_power = 1.2, pole_radius = 0.4;
double pole(UnitPoint x) {
  const double r2 = distance2(x, 0.43);
  return r2 < mc::sqr(pole_radius) ? std::pow(std::max(r2, 1e-300), -pole_power / 2) : 0;
}

double ball(UnitPoint x) { return distance2(x, 0) <= 1 ? 1 : 0; }

std::vector<UnitCubeIntegral> make() {
  using Class = Smoothness::Class;
  const auto one = [](const char* name, const char* title, int dim, double truth, Class smoothness,
                      double (*f)(UnitPoint)) {
    return UnitCubeIntegral{fmt::format("hard_{}", name), title, "made to be hard", dim, truth, {smoothness}, 0, f};
  };
  const double sphere = 4 * pi / 3;
  return {one("peaks_5d", "two Gaussians on a diagonal", 5, 2 * std::pow(bell(0.3, peak), 5), Class::smooth, two_peaks),
          one("product_20d", "a product of |4 x - 2|", 20, 1, Class::axis_kink, absolute_product),
          one("asian_50d", "an Asian option on a geometric mean", days, asian_truth(), Class::kink, asian),
          one("box_3d", "1 in a box", 3, box_truth(), Class::axis_jump, box),
          one("shell_3d", "1 between two spheres", 3, sphere * (std::pow(shell_outer, 3) - std::pow(shell_inner, 3)),
              Class::jump, shell),
          one("ridge_3d", "a long Gaussian that follows no axis", 3,
              std::pow(2 * pi, 1.5) * ridge_length * mc::sqr(ridge_width), Class::smooth, ridge),
          one("ring_2d", "a ring", 2, 2 * pi * ring_radius * ring_width * std::sqrt(2 * pi), Class::smooth, ring),
          one("corner_3d", "(x y z)^-.4", 3, std::pow(0.6, -3), Class::corner, corner),
          one("pole_3d", "|x - c|^-1.2 in a ball about c", 3,
              4 * pi * std::pow(pole_radius, 3 - pole_power) / (3 - pole_power), Class::unknown, pole),
          one("ball_5d", "1 in a part of a ball", 5, std::pow(pi, 2.5) / std::tgamma(3.5) / 32, Class::jump, ball)};
}

} // namespace

const std::vector<UnitCubeIntegral>& hard_integrals() {
  static const std::vector<UnitCubeIntegral> list = make();
  return list;
}

} // namespace carlo
