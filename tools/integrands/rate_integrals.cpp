#include <integrands/rate_integrals.h>

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <numbers>

namespace carlo {

namespace {

using UnitPoint = std::span<const double>;
using Class = Smoothness::Class;

constexpr double edge = 2.0 / 3, corner = 0.15;
// The normal of the plane and its offset. No two components have a simple ratio.
constexpr double normal[] = {
    1,     0.7548776662466927, 0.5698402909980532, 0.8191725133961645, 0.6710436067037893, 0.9243, 0.6180339887498949,
    0.8650};

double place(int d) {
  double sum = 0;
  for (int i = 0; i < d; ++i) sum += normal[i];
  return 0.46 * sum;
}
double along(UnitPoint u) {
  double sum = 0;
  for (std::size_t i = 0; i < u.size(); ++i) sum += normal[i] * u[i];
  return sum;
}

// The mean over the cube of the d-th derivative of g at a . x - b: the signed sum of g over the corners.
template <class G> double mean_over_cube(int d, G&& g) {
  double sum = 0, product = 1;
  for (int i = 0; i < d; ++i) product *= normal[i];
  for (unsigned corners = 0; corners < 1u << d; ++corners) {
    double t = -place(d);
    for (int i = 0; i < d; ++i)
      if (corners >> i & 1) t += normal[i];
    sum += ((d - std::popcount(corners)) % 2 == 0 ? 1 : -1) * g(t);
  }
  return sum / product;
}

double kink_truth(int d) {
  return mean_over_cube(d, [d](double t) { return std::abs(t) * std::pow(t, d) / std::tgamma(d + 2); });
}
// The mean of 1 where a . x < b is 1 minus the mean of the step function at b.
double jump_truth(int d) {
  return 1 - mean_over_cube(d, [d](double t) { return t > 0 ? std::pow(t, d) / std::tgamma(d + 1) : 0.0; });
}

double exponentials(UnitPoint u) {
  double sum = 0;
  for (const double x : u) sum += x;
  return std::exp(sum);
}
double box(UnitPoint u) {
  for (const double x : u)
    if (!(x < edge)) return 0;
  return 1;
}
double bent(UnitPoint u) { return std::abs(along(u) - place(static_cast<int>(u.size()))); }
double half_space(UnitPoint u) { return along(u) < place(static_cast<int>(u.size())) ? 1 : 0; }
double root(UnitPoint u) {
  double product = 1;
  for (const double x : u) product *= x;
  return std::pow(std::max(product, 1e-300), -corner);
}

struct Kind {
  const char *name, *title;
  Smoothness smoothness;
  double (*truth)(int d);
  double (*f)(UnitPoint u);
};

constexpr Kind kinds[] = {
    {"smooth", "product of e^x", {Class::smooth}, [](int d) { return std::pow(std::numbers::e - 1, d); }, exponentials},
    {"axis_jump", "1 where all x < 2/3", {Class::axis_jump}, [](int d) { return std::pow(edge, d); }, box},
    {"kink", "|a.x - b|, a turned", {Class::kink}, kink_truth, bent},
    {"jump", "1 where a.x < b, a turned", {Class::jump}, jump_truth, half_space},
    {"corner", "product of x^-0.15", {Class::corner, corner}, [](int d) { return std::pow(1 - corner, -d); }, root},
};

std::vector<UnitCubeIntegral> make() {
  std::vector<UnitCubeIntegral> list;
  for (const Kind& kind : kinds)
    for (const int d : {1, 2, 3, 5, 8})
      list.push_back({fmt::format("rate_{}_{}d", kind.name, d),
                      fmt::format("{}, {} dimension{}", kind.title, d, d == 1 ? "" : "s"), "", d, kind.truth(d),
                      kind.smoothness, 256, kind.f});
  return list;
}

} // namespace

const std::vector<UnitCubeIntegral>& rate_integrals() {
  static const std::vector<UnitCubeIntegral> list = make();
  return list;
}

} // namespace carlo
