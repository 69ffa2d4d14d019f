// Integrals over a box, over a domain with its measure, and with points of a density that fits.
#include <mc/domain/box.h>
#include <mc/domain/hemisphere.h>
#include <mc/estimate/integrate.h>
#include <mc/warp/normal.h>

#include <cmath>
#include <iostream>

int main() {
  const mc::Box<double, 2> box({0, -1}, {1, 2});
  std::cout << mc::integrate([](const mc::Vec2<double>& x) { return std::exp(-x[0] * x[0]) * std::cos(x[1]); }, box,
                             {.rel_error = 1e-4})
            << '\n';
  std::cout << mc::integrate([](const mc::Vec3<double>& w) { return w.z() * w.z(); }, mc::Hemisphere<double>()) << '\n';
  const mc::Integral r = mc::integrate([](double x) { return x * x * std::exp(-x * x / 2); }, mc::Normal<double>(0, 1));
  std::cout << r << '\n';
  return r.interval.lo <= std::sqrt(2 * mc::pi<double>) && std::sqrt(2 * mc::pi<double>) <= r.interval.hi ? 0 : 1;
}
