#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/points/spectrum.h>

#include <cmath>
#include <complex>

namespace mc {

namespace {

// Mean of power(x, y) over each ring. Visits half of the plane, because the power at -f equals the power at f.
template <class Power> std::vector<double> ring_means(int rings, Power power) {
  std::vector<double> sum(static_cast<std::size_t>(rings), 0.0), count = sum;
  for (int x = 0; x <= rings; ++x)
    for (int y = x == 0 ? 1 : -rings; y <= rings; ++y) {
      const auto ring = std::lround(std::hypot(x, y));
      if (ring > rings) continue;
      sum[static_cast<std::size_t>(ring - 1)] += power(x, y);
      count[static_cast<std::size_t>(ring - 1)] += 1;
    }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= count[k];
  return sum;
}

double sinc(double x) { return x == 0 ? 1.0 : std::sin(pi<double> * x) / (pi<double> * x); }

} // namespace

std::vector<double> radial_power_spectrum(PointList p, int rings) {
  require_unit_points(p);
  require(p.dim >= 2 && rings >= 1, "radial_power_spectrum: {} dimensions and {} rings; 2 and 1 are needed", p.dim,
          rings);
  using Complex = std::complex<double>;
  const std::size_t radius = static_cast<std::size_t>(rings), side = 2 * radius + 1;
  std::vector<Complex> wave((radius + 1) * side), along_y(side);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t y = 0; y < side; ++y)
      along_y[y] = std::polar(1.0, -2 * pi<double> * (static_cast<double>(y) - rings) * p[i][1]);
    for (int x = 0; x <= rings; ++x) {
      const Complex along_x = std::polar(1.0, -2 * pi<double> * x * p[i][0]);
      Complex* row = wave.data() + static_cast<std::size_t>(x) * side;
      for (std::size_t y = 0; y < side; ++y) // operator* of std::complex would check for NaN
        row[y] += Complex(along_x.real() * along_y[y].real() - along_x.imag() * along_y[y].imag(),
                          along_x.real() * along_y[y].imag() + along_x.imag() * along_y[y].real());
    }
  }
  return ring_means(rings, [&](int x, int y) {
    return std::norm(wave[static_cast<std::size_t>(x) * side + static_cast<std::size_t>(y + rings)]) /
           static_cast<double>(p.size());
  });
}

std::vector<double> jittered_radial_spectrum(double m, int rings) {
  return ring_means(rings, [&](int x, int y) {
    const double w = sinc(x / m) * sinc(y / m);
    return 1 - w * w;
  });
}

} // namespace mc
