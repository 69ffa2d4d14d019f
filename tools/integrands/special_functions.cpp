#include <integrands/special_functions.h>

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include <cmath>
#include <exception>
#include <limits>

namespace carlo {

namespace {

namespace policies = boost::math::policies;
using Silent =
    policies::policy<policies::domain_error<policies::ignore_error>, policies::pole_error<policies::ignore_error>,
                     policies::overflow_error<policies::ignore_error>,
                     policies::evaluation_error<policies::ignore_error>, policies::promote_double<false>>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

// Boost.Math needs finite arguments; its time grows with the order.
constexpr double largest_order = 1e6;

double erf_of(double x) { return std::erf(x); }
double erfc_of(double x) { return std::erfc(x); }
double gamma_of(double x) { return std::tgamma(x); }
double lgamma_of(double x) { // std::lgamma writes a global variable
  if (std::isinf(x) || (x <= 0 && x == std::floor(x))) return infinity;
  return std::isnan(x) ? nan : boost::math::lgamma(x, Silent());
}
double beta_of(double a, double b) {
  if (a == 0 || b == 0) return infinity;
  return std::isfinite(a) && std::isfinite(b) ? boost::math::beta(a, b, Silent()) : nan;
}
// NaN where Boost.Math throws: some of its internal calls ignore the policy.
template <class F> double bessel(double nu, double x, F f) try {
  return std::abs(nu) <= largest_order && std::isfinite(x) ? f(nu, x, Silent()) : nan;
} catch (const std::exception&) {
  return nan;
}
double bessel_j(double nu, double x) {
  return bessel(nu, x, [](auto... a) { return boost::math::cyl_bessel_j(a...); });
}
double bessel_y(double nu, double x) {
  if (!(x > 0)) return x == 0 ? -infinity : nan;
  return bessel(nu, x, [](auto... a) { return boost::math::cyl_neumann(a...); });
}
double normal_pdf(double x) { return std::exp(-x * x / 2) * 0.39894228040143267794; } // 1 / sqrt(2 pi)
double normal_cdf(double x) { return std::erfc(-x * 0.70710678118654752440) / 2; }    // 1 / sqrt(2)
double sinc(double x) { return x == 0 ? 1 : std::sin(x) / x; }
double heaviside(double x) {
  if (x == 0) return 0.5;
  return std::isnan(x) ? x : x > 0;
}
double remainder_of(double x, double y) { return std::fmod(x, y); }
double ceiling(double x) { return std::ceil(x); }
double cube_root(double x) { return std::cbrt(x); }
double exp_minus_1(double x) { return std::expm1(x); }
double log_of_1_plus(double x) { return std::log1p(x); }
double hypotenuse(double x, double y) { return std::hypot(x, y); }

constexpr NamedFunction table[] = {
    {"ceil", "(x)", ceiling, ""},
    {"cbrt", "(x)", cube_root, ""},
    {"expm1", "(x)", exp_minus_1, ""},
    {"log1p", "(x)", log_of_1_plus, ""},
    {"hypot", "(x, y)", hypotenuse, ""},
    {"fmod", "(x, y)", remainder_of, "x minus a multiple of y, with the sign of x"},
    {"erf", "(x)", erf_of, ""},
    {"erfc", "(x)", erfc_of, ""},
    {"gamma", "(x)", gamma_of, ""},
    {"lgamma", "(x)", lgamma_of, "log |gamma(x)|"},
    {"beta", "(a, b)", beta_of, "gamma(a) gamma(b) / gamma(a + b), a, b > 0"},
    {"besselj", "(nu, x)", bessel_j, "Bessel function of the first kind, |nu| <= 1e6, nu whole if x < 0"},
    {"bessely", "(nu, x)", bessel_y, "Bessel function of the second kind, x > 0"},
    {"normal_pdf", "(x)", normal_pdf, "density of the normal variable of mean 0, variance 1"},
    {"normal_cdf", "(x)", normal_cdf, "P(Z <= x) of the same variable Z"},
    {"normal_quantile", "(p)", normal_quantile_of, "the x with P(Z <= x) = p"},
    {"sinc", "(x)", sinc, "sin(x) / x"},
    {"heaviside", "(x)", heaviside, "1/2 at 0"},
};

} // namespace

std::span<const NamedFunction> special_functions() { return table; }

double normal_quantile_of(double p) {
  if (p == 0) return -infinity;
  if (p == 1) return infinity;
  if (!(p > 0 && p < 1)) return nan;
  return p < 0.5 ? -1.4142135623730950488 * boost::math::erfc_inv(2 * p, Silent())
                 : 1.4142135623730950488 * boost::math::erfc_inv(2 * (1 - p), Silent());
}

} // namespace carlo
