#include <integrands/expression.h>
#include <integrate/derived.h>

#include <mc/core/error.h>

#include <Eigen/Core>

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

  // First and second differences of f, for one standard error of each integral.
  const auto size = static_cast<Eigen::Index>(names.size());
  Eigen::VectorXd first_order = Eigen::VectorXd::Zero(size);
  Eigen::MatrixXd second_order = Eigen::MatrixXd::Zero(size, size), correlations(size, size);
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
  const auto moved = [&](std::size_t i, double by_i, std::size_t k, double by_k) {
    std::vector<double> x = at;
    x[i] += by_i * errors[i];
    x[k] += by_k * errors[k];
    return f(x);
  };
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(k);
      correlations(row, column) = r.correlation(first + i, first + k);
      if (errors[i] == 0 || errors[k] == 0) continue;
      if (i == k) {
        const double up = moved(i, 1, i, 0), down = moved(i, -1, i, 0);
        first_order(row) = (up - down) / 2;
        second_order(row, row) = up - 2 * d.value + down;
      } else
        second_order(row, column) =
            (moved(i, 1, k, 1) - moved(i, 1, k, -1) - moved(i, -1, k, 1) + moved(i, -1, k, -1)) / 4;
    }
  d.std_error = std::sqrt(std::max(first_order.dot(correlations * first_order), 0.0));
  // Bias and variance of half the quadratic form of normal errors.
  const Eigen::MatrixXd form = second_order * correlations;
  const double bias = form.trace() / 2, spread = std::sqrt(std::max((form * form).trace() / 2, 0.0));
  const double rounding = 1e-14 * std::abs(d.value);
  d.is_linear = std::hypot(bias, spread) <= d.std_error / 2 + rounding;
  if (!std::isfinite(d.std_error) || !std::isfinite(d.value)) {
    d.std_error = infinity;
    d.has_pole = true;
    return d;
  }
  d.interval = {d.value - widest * d.std_error, d.value + widest * d.std_error};
  return d;
}

} // namespace carlo
