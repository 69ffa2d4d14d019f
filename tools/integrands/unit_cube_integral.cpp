#include <integrands/unit_cube_integral.h>

#include <mc/core/error.h>
#include <mc/random/uniform.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/sphere.h>

#include <cmath>
#include <limits>

namespace carlo {

namespace {

using UnitPoint = std::span<const double>;

// Hit-or-miss in the cube [-1,1]^d: the volume of the cube for points in the unit ball, otherwise 0.
double ball(UnitPoint u) {
  double r2 = 0;
  for (const double x : u) r2 += mc::sqr(2 * x - 1);
  return r2 <= 1 ? std::ldexp(1.0, static_cast<int>(u.size())) : 0.0;
}

mc::Vec2<double> pair(UnitPoint u) { return {u[0], u[1]}; }

double x2_uniform(UnitPoint u) { return 2 * mc::sqr(2 * u[0]); }
double x2_linear(UnitPoint u) {
  const double x = 2 * std::sqrt(u[0]);
  return 2 * x; // x^2 / (x / 2)
}
double x2_quadratic(UnitPoint u) {
  const double x = 2 * std::cbrt(1 - u[0]); // 1 - u, so that x > 0
  return x * x / (3 * x * x / 8);
}
double cos2_sphere(UnitPoint u) {
  const mc::UniformSphere<double> warp;
  const auto w = warp.sample(pair(u));
  return mc::sqr(w.z()) / warp.pdf(w);
}
template <class Warp> double cos3(UnitPoint u) {
  const auto w = Warp{}.sample(pair(u));
  return w.z() * w.z() * w.z() / Warp{}.pdf(w);
}
double adversarial(UnitPoint u) { return -100 * std::cos(200 * mc::pi<double> * u[0]); }

std::vector<UnitCubeIntegral> make() {
  const double pi = mc::pi<double>;
  const std::string week3 = "Ray Tracing: The Rest of Your Life (P. Shirley), chapter ";
  const std::string codex = "The Graphics Codex (M. McGuire)";
  using Class = Smoothness::Class;
  const auto cos3_uniform = cos3<mc::UniformHemisphere<double>>;
  const auto cos3_cosine = cos3<mc::CosineHemisphere<double>>;
  return {
      {"pi", "pi by darts at a square", week3 + "2", 2, pi, {Class::jump}, 64, ball},
      {"x2_uniform", "x^2 on [0,2], uniform density", week3 + "3", 1, 8.0 / 3, {Class::smooth}, 16, x2_uniform},
      {"x2_linear", "x^2 on [0,2], density x/2", week3 + "3", 1, 8.0 / 3, {Class::corner, -0.5}, 16, x2_linear},
      {"x2_quadratic",
       "x^2 on [0,2], density 3 x^2 / 8: no error at all",
       week3 + "3",
       1,
       8.0 / 3,
       {Class::smooth},
       16,
       x2_quadratic},
      {"cos2_sphere", "cos^2 over the sphere", week3 + "4", 2, 4 * pi / 3, {Class::additive, 0, true}, 64, cos2_sphere},
      {"cos3_hemisphere_uniform",
       "cos^3 over the hemisphere, uniform density",
       week3 + "7",
       2,
       pi / 2,
       {Class::additive},
       64,
       cos3_uniform},
      {"cos3_hemisphere_cosine",
       "cos^3 over the hemisphere, density cos/pi",
       week3 + "7",
       2,
       pi / 2,
       {Class::kink}, // the concentric map of the disk has a kink along the diagonals
       64,
       cos3_cosine},
      {"ball_3d", "volume of the ball in 3 dimensions by darts", week3 + "2", 3, 4 * pi / 3, {Class::jump}, 64, ball},
      {"ball_5d",
       "volume of the ball in 5 dimensions by darts",
       week3 + "2",
       5,
       8 * pi * pi / 15,
       {Class::jump},
       64,
       ball},
      {"adversarial",
       "-cos(2 pi x) on [0,100]: a regular grid sees only the crests",
       codex,
       1,
       0,
       {Class::periodic},
       1024,
       adversarial},
  };
}

} // namespace

const std::vector<UnitCubeIntegral>& textbook_integrals() {
  static const std::vector<UnitCubeIntegral> list = make();
  return list;
}

std::string_view name(Smoothness::Class c) {
  using Class = Smoothness::Class;
  switch (c) {
  case Class::unknown: return "unknown";
  case Class::smooth: return "smooth";
  case Class::additive: return "additive";
  case Class::periodic: return "periodic";
  case Class::axis_kink: return "kink along axes";
  case Class::kink: return "kink";
  case Class::axis_jump: return "jump along axes";
  case Class::jump: return "jump";
  case Class::corner: return "singular";
  }
  return "";
}

void evaluate(const UnitCubeIntegral& e, UnitCubeIntegral::UnitPoint points, std::span<double> values) {
  const auto dim = static_cast<std::size_t>(e.dim);
  const auto point = [&](std::size_t i) { return points.subspan(i * dim, dim); };
  if (e.f_batch) e.f_batch(points, values);
  else
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = e.f(point(i));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    const std::string place =
        e.describe_point ? e.describe_point(point(i)) : fmt::format("u = ({})", fmt::join(point(i), ", "));
    throw mc::Error(fmt::format("{}: the integrand is {} at {}", e.name,
                                std::isnan(values[i]) ? std::string("nan") : fmt::format("{}", values[i]), place));
  }
}

void refuse_underflow(const UnitCubeIntegral& e) {
  if (!e.underflows_at) return;
  std::vector<double> u(static_cast<std::size_t>(e.dim));
  bool any = false;
  for (std::uint64_t i = 0; i < 4096; ++i) {
    for (std::size_t d = 0; d < u.size(); ++d) u[d] = mc::hash_uniform<double>(i, d);
    if (e.f(u) != 0) return;
    any = any || e.underflows_at(u);
  }
  mc::require(!any,
              "'{}': its values times the volume of '{}' are below {:.2g}, the smallest double; multiply it "
              "by a large number, or rescale its variables",
              e.name, e.source, std::numeric_limits<double>::denorm_min());
}

} // namespace carlo
