#include <integrands/genz.h>

#include <mc/core/types.h>

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <complex>

namespace carlo {

namespace {

using UnitPoint = std::span<const double>;
using Parameters = std::vector<double>; // c: difficulty for each axis, w: position

struct Family {
  const char* name;
  double (*f)(UnitPoint x, UnitPoint c, UnitPoint w);
  double (*truth)(UnitPoint c, UnitPoint w);
  Smoothness::Class smoothness;
};

template <class Term> double product(UnitPoint c, UnitPoint w, Term&& term) {
  double p = 1;
  for (std::size_t i = 0; i < c.size(); ++i) p *= term(c[i], w[i], i);
  return p;
}

double dot(UnitPoint c, UnitPoint x) {
  double s = 0;
  for (std::size_t i = 0; i < c.size(); ++i) s += c[i] * x[i];
  return s;
}

double oscillatory(UnitPoint x, UnitPoint c, UnitPoint w) { return std::cos(2 * mc::pi<double> * w[0] + dot(c, x)); }
double oscillatory_truth(UnitPoint c, UnitPoint w) {
  using namespace std::complex_literals;
  std::complex<double> p = std::exp(2i * mc::pi<double> * w[0]);
  for (const double a : c) p *= (std::exp(1i * a) - 1.0) / (1i * a);
  return p.real();
}

double product_peak(UnitPoint x, UnitPoint c, UnitPoint w) {
  return product(c, w, [&](double a, double b, std::size_t i) { return 1 / (1 / (a * a) + mc::sqr(x[i] - b)); });
}
double product_peak_truth(UnitPoint c, UnitPoint w) {
  return product(c, w, [](double a, double b, std::size_t) { return a * (std::atan(a * (1 - b)) + std::atan(a * b)); });
}

double corner_peak(UnitPoint x, UnitPoint c, UnitPoint) {
  return std::pow(1 + dot(c, x), -static_cast<double>(c.size() + 1));
}
double corner_peak_truth(UnitPoint c, UnitPoint) {
  double sum = 0, scale = 1;
  for (std::uint32_t corner = 0; corner < 1u << c.size(); ++corner) {
    double s = 1;
    for (std::size_t i = 0; i < c.size(); ++i)
      if (corner >> i & 1) s += c[i];
    sum += (std::popcount(corner) % 2 ? -1 : 1) / s;
  }
  for (std::size_t i = 0; i < c.size(); ++i) scale *= c[i] * static_cast<double>(i + 1);
  return sum / scale;
}

double gaussian(UnitPoint x, UnitPoint c, UnitPoint w) {
  double s = 0;
  for (std::size_t i = 0; i < c.size(); ++i) s += mc::sqr(c[i] * (x[i] - w[i]));
  return std::exp(-s);
}
double gaussian_truth(UnitPoint c, UnitPoint w) {
  return product(c, w, [](double a, double b, std::size_t) {
    return std::sqrt(mc::pi<double>) / (2 * a) * (std::erf(a * (1 - b)) + std::erf(a * b));
  });
}

double c0(UnitPoint x, UnitPoint c, UnitPoint w) {
  double s = 0;
  for (std::size_t i = 0; i < c.size(); ++i) s += c[i] * std::abs(x[i] - w[i]);
  return std::exp(-s);
}
double c0_truth(UnitPoint c, UnitPoint w) {
  return product(c, w,
                 [](double a, double b, std::size_t) { return -(std::expm1(-a * b) + std::expm1(-a * (1 - b))) / a; });
}

double discontinuous(UnitPoint x, UnitPoint c, UnitPoint w) {
  return x[0] > w[0] || x[1] > w[1] ? 0 : std::exp(dot(c, x));
}
double discontinuous_truth(UnitPoint c, UnitPoint w) {
  return product(c, w, [](double a, double b, std::size_t i) { return std::expm1(i < 2 ? a * b : a) / a; });
}

constexpr Family families[] = {{"oscillatory", oscillatory, oscillatory_truth, Smoothness::Class::smooth},
                               {"product_peak", product_peak, product_peak_truth, Smoothness::Class::smooth},
                               {"corner_peak", corner_peak, corner_peak_truth, Smoothness::Class::smooth},
                               {"gaussian", gaussian, gaussian_truth, Smoothness::Class::smooth},
                               {"c0", c0, c0_truth, Smoothness::Class::axis_kink},
                               {"discontinuous", discontinuous, discontinuous_truth, Smoothness::Class::axis_jump}};

// Drawn once: w uniform in [.1, .9], c uniform and scaled to the family's difficulty.
const Parameters parameters[][2] = {
    {{2.76145, 3.23855}, {0.154403, 0.154583}},
    {{0.614206, 2.21876, 1.21907, 1.30479, 0.64318}, {0.6921, 0.583664, 0.58794, 0.230606, 0.31177}},
    {{1.38868, 1.22534, 0.353297, 0.620997, 0.658875, 0.251448, 1.19314, 0.308229},
     {0.842604, 0.361709, 0.779718, 0.684838, 0.498743, 0.870947, 0.528648, 0.795139}},
    {{12.3409, 5.6591}, {0.89357, 0.754564}},
    {{2.98141, 1.27811, 3.97991, 6.86109, 2.89948}, {0.838805, 0.289488, 0.428757, 0.591649, 0.485742}},
    {{1.63548, 1.39315, 4.45615, 0.808173, 4.22265, 1.55009, 2.43702, 1.49729},
     {0.459507, 0.606022, 0.52592, 0.371868, 0.441698, 0.572913, 0.553067, 0.248525}},
    {{0.602641, 1.59736}, {0.848401, 0.848786}},
    {{0.732825, 0.490556, 0.241075, 0.340875, 0.39467}, {0.407127, 0.640791, 0.345292, 0.873491, 0.53282}},
    {{0.324095, 0.325696, 0.176039, 0.294298, 0.354595, 0.268165, 0.161102, 0.296009},
     {0.745156, 0.208294, 0.463496, 0.791529, 0.328093, 0.617163, 0.668999, 0.159911}},
    {{7.59148, 7.60852}, {0.36803, 0.314745}},
    {{0.638254, 4.45479, 3.97934, 4.57236, 1.55526}, {0.577054, 0.700992, 0.181598, 0.613855, 0.456318}},
    {{0.717099, 3.53793, 2.05722, 1.22454, 2.13887, 3.0439, 0.920449, 1.55998},
     {0.421479, 0.156873, 0.233798, 0.340751, 0.350461, 0.571044, 0.604537, 0.837167}},
    {{12.8103, 3.28974}, {0.652649, 0.402499}},
    {{5.89417, 5.51101, 0.853616, 2.53533, 1.30587}, {0.60829, 0.619188, 0.884604, 0.331134, 0.805802}},
    {{2.75075, 2.11647, 2.91615, 2.75696, 0.851065, 2.66745, 1.52934, 0.511817},
     {0.18713, 0.272468, 0.899702, 0.401662, 0.440354, 0.503171, 0.105389, 0.60592}},
    {{7.55754, 8.84246}, {0.574983, 0.71435}},
    {{3.29077, 4.07375, 3.40335, 1.20963, 4.42249}, {0.891931, 0.362302, 0.897891, 0.101856, 0.156226}},
    {{2.59139, 1.389, 2.28691, 1.3804, 2.42779, 1.31869, 2.42957, 2.57624},
     {0.8173, 0.689164, 0.136461, 0.717283, 0.745699, 0.354077, 0.485065, 0.686489}},
};

std::vector<UnitCubeIntegral> make() {
  std::vector<UnitCubeIntegral> list;
  for (std::size_t k = 0; k < std::size(parameters); ++k) {
    const Family& family = families[k / 3];
    const Parameters &c = parameters[k][0], &w = parameters[k][1];
    const int dim = static_cast<int>(c.size());
    list.push_back({fmt::format("genz_{}_{}d", family.name, dim),
                    fmt::format("Genz: {} in {} dimensions", family.name, dim),
                    "A. Genz 1987",
                    dim,
                    family.truth(c, w),
                    {family.smoothness},
                    256,
                    [&family, &c, &w](UnitPoint x) { return family.f(x, c, w); }});
  }
  return list;
}

} // namespace

const std::vector<UnitCubeIntegral>& genz_integrals() {
  static const std::vector<UnitCubeIntegral> list = make();
  return list;
}

} // namespace carlo
