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

  std::vector<double> change(names.size()); // of f, for one standard error
  double curvature = 0, widest = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::find(used.begin(), used.end(), names[i]) == used.end()) continue;
    const mc::Integral& integral = r.outputs[first + i];
    if (integral.error_bar != mc::ErrorBar::known) {
      d.error_bar = integral.error_bar;
      return d;
    }
    const double h = integral.estimate.std_error;
    if (h == 0) continue;
    std::vector<double> above = at, below = at;
    above[i] += h;
    below[i] -= h;
    const double up = f(above), down = f(below);
    change[i] = (up - down) / 2;
    curvature += std::abs((up + down) / 2 - d.value);
    widest = std::max(widest, (integral.interval.hi - integral.interval.lo) / (2 * h));
  }
  double variance = 0;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t k = 0; k < names.size(); ++k)
      variance += change[i] * change[k] * r.correlation(first + i, first + k);
  d.std_error = std::sqrt(std::max(variance, 0.0));
  d.is_linear = curvature <= d.std_error / 2;
  if (!std::isfinite(d.std_error) || !std::isfinite(d.value)) {
    d.std_error = infinity;
    d.has_pole = true;
    return d;
  }
  d.interval = {d.value - widest * d.std_error, d.value + widest * d.std_error};
  return d;
}

} // namespace carlo
