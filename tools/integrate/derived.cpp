#include <integrands/expression.h>
#include <integrate/derived.h>

#include <mc/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace carlo {

namespace {

// Differences of a function for one standard error of each integral: half of the first, and the matrix of the second.
struct Differences {
  std::vector<double> first, second;
};

template <class F>
Differences differences(const F& f, const std::vector<double>& at, double value, const std::vector<double>& errors) {
  const std::size_t n = at.size();
  const auto moved = [&](std::size_t i, double by_i, std::size_t k, double by_k) {
    std::vector<double> x = at;
    x[i] += by_i * errors[i];
    x[k] += by_k * errors[k];
    return f(x);
  };
  Differences d{std::vector<double>(n), std::vector<double>(n * n)};
  for (std::size_t i = 0; i < n; ++i) {
    if (errors[i] == 0) continue;
    const double up = moved(i, 1, i, 0), down = moved(i, -1, i, 0);
    d.first[i] = (up - down) / 2;
    d.second[i * n + i] = up - 2 * value + down;
    for (std::size_t k = 0; k < i; ++k)
      if (errors[k] > 0)
        d.second[i * n + k] = d.second[k * n + i] =
            (moved(i, 1, k, 1) - moved(i, 1, k, -1) - moved(i, -1, k, 1) + moved(i, -1, k, -1)) / 4;
  }
  return d;
}

// The root mean square of half the quadratic form of the second differences, for normal errors.
template <class Correlation> double second_order_size(const Differences& d, const Correlation& correlation) {
  const std::size_t n = d.first.size();
  std::vector<double> product(n * n); // of the matrix and the correlations
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j) product[i * n + k] += d.second[i * n + j] * correlation(j, k);
  double mean = 0, variance = 0;
  for (std::size_t i = 0; i < n; ++i) {
    mean += product[i * n + i] / 2;
    for (std::size_t k = 0; k < n; ++k) variance += product[i * n + k] * product[k * n + i] / 2;
  }
  return std::hypot(mean, std::sqrt(std::max(variance, 0.0)));
}

} // namespace

DerivedValue derived_value(const std::string& expression, const std::vector<std::string>& names,
                           const mc::VectorIntegral& r, std::size_t first) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto f = mc::with_context("--derive", [&] { return parse_function(expression, names); });
  const std::vector<std::string> used = variables_of(expression);
  std::vector<double> at;
  for (std::size_t i = 0; i < names.size(); ++i) at.push_back(r.outputs[first + i].estimate.value);
  DerivedValue d{expression, f(at), infinity, {-infinity, infinity}};

  std::vector<double> errors(names.size());
  double widest = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::find(used.begin(), used.end(), names[i]) == used.end()) continue;
    const mc::Integral& integral = r.outputs[first + i];
    if (integral.error_bar != mc::ErrorBar::known) {
      d.error_bar = integral.error_bar;
      return d;
    }
    errors[i] = integral.estimate.std_error;
    if (errors[i] > 0) widest = std::max(widest, (integral.interval.hi - integral.interval.lo) / (2 * errors[i]));
  }
  const Differences change = differences(f, at, d.value, errors);
  const auto correlation = [&](std::size_t i, std::size_t k) { return r.correlation(first + i, first + k); };
  double variance = 0, sizes = std::abs(d.value);
  for (std::size_t i = 0; i < names.size(); ++i) {
    sizes += std::abs(change.first[i]);
    for (std::size_t k = 0; k < names.size(); ++k) variance += change.first[i] * change.first[k] * correlation(i, k);
  }
  d.std_error = std::sqrt(std::max(variance, 0.0));
  constexpr double rounding = 1e-14;
  d.is_linear = second_order_size(change, correlation) <= d.std_error / 2 + rounding * sizes;
  if (!std::isfinite(d.std_error) || !std::isfinite(d.value)) {
    d.std_error = infinity;
    d.has_pole = true;
    return d;
  }
  d.interval = {d.value - widest * d.std_error, d.value + widest * d.std_error};
  return d;
}

} // namespace carlo
