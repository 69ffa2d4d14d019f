// Built with the flags of pkg-config only. A minimal program that fails if the alignment of types differs from the
// library.
#include <mc/estimate/control_variate.h>
#include <mc/random/pcg.h>

#include <fmt/format.h>

#include <array>
#include <cmath>

int main() {
  mc::Pcg random(1);
  mc::ControlVariates first(std::array{0.5}), second(std::array{0.5}); // the mean of u over [0,1)
  for (int i = 0; i < 10000; ++i) {
    const double u = random.uniform<double>();
    (i % 2 == 0 ? first : second).add(std::exp(u), std::array{u});
  }
  const mc::Estimate e = mc::cross_fitted_estimate(first, second);
  fmt::print("e - 1 = {:.4f} +- {:.4f}\n", e.value, e.std_error);
  return std::abs(e.value - (std::exp(1.0) - 1)) <= 5 * e.std_error ? 0 : 1;
}
