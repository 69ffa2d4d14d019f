#include <integrands/expression.h>
#include <integrate/derived.h>

#include <mc/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace carlo {

DerivedValue derived_value(const std::string& expression, const std::vector<std::string>& names,
                           const mc::VectorIntegral& r, std::size_t first) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto f = mc::with_context("--derive", [&] { return parse_function(expression, names); });
  const std::vector<std::string> used = variables_of(expression);
  std::vector<double> at;
  for (std::size_t i = 0; i < names.size(); ++i) at.push_back(r.outputs[first + i].estimate.value);
  DerivedValue d{expression, f(at), infinity, {-infinity, infinity}};

  const std::size_t n = names.size();
  std::vector<double> errors(n);
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
  const auto moved = [&](std::size_t i, double by_i, std::size_t k, double by_k) {
    std::vector<double> x = at;
    x[i] += by_i * errors[i];
    x[k] += by_k * errors[k];
    return f(x);
  };
  // First and second differences of f, for one standard error of each integral.
  std::vector<double> first_order(n), second_order(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) {
      if (errors[i] == 0 || errors[k] == 0) continue;
      if (i == k) {
        const double up = moved(i, 1, i, 0), down = moved(i, -1, i, 0);
        first_order[i] = (up - down) / 2;
        second_order[i * n + i] = up - 2 * d.value + down;
      } else
        second_order[i * n + k] =
            (moved(i, 1, k, 1) - moved(i, 1, k, -1) - moved(i, -1, k, 1) + moved(i, -1, k, -1)) / 4;
    }
  std::vector<double> form(n * n); // second_order times the correlations
  double variance = 0, bias = 0, spread = 0, sizes = std::abs(d.value);
  for (std::size_t i = 0; i < n; ++i) {
    sizes += std::abs(first_order[i]);
    for (std::size_t k = 0; k < n; ++k) {
      variance += first_order[i] * first_order[k] * r.correlation(first + i, first + k);
      for (std::size_t j = 0; j < n; ++j)
        form[i * n + k] += second_order[i * n + j] * r.correlation(first + j, first + k);
    }
    bias += form[i * n + i] / 2;
  }
  // Bias and variance of half the quadratic form of normal errors.
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) spread += form[i * n + k] * form[k * n + i] / 2;
  d.std_error = std::sqrt(std::max(variance, 0.0));
  const double rounding = 1e-14 * sizes;
  d.is_linear = std::hypot(bias, std::sqrt(std::max(spread, 0.0))) <= d.std_error / 2 + rounding;
  if (!std::isfinite(d.std_error) || !std::isfinite(d.value)) {
    d.std_error = infinity;
    d.has_pole = true;
    return d;
  }
  d.interval = {d.value - widest * d.std_error, d.value + widest * d.std_error};
  return d;
}

} // namespace carlo
