#include <integrands/experiments.h>

#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/sphere.h>

#include <cmath>

namespace carlo {

namespace {

using Unit = std::span<const double>;

// Darts at the cube [-1,1]^d: volume of the cube where they hit the unit ball.
double ball(Unit u) {
  double r2 = 0;
  for (const double x : u) r2 += mc::sqr(2 * x - 1);
  return r2 <= 1 ? std::ldexp(1.0, static_cast<int>(u.size())) : 0.0;
}

mc::Vec2<double> pair(Unit u) { return {u[0], u[1]}; }

std::vector<Experiment> make() {
  const double pi = mc::pi<double>;
  const std::string week3 = "Ray Tracing: The Rest of Your Life (P. Shirley)";
  const std::string codex = "The Graphics Codex (M. McGuire)";
  std::vector<Experiment> list;
  list.push_back({"pi", "pi by darts at a square", week3 + ", chapter 2", 2, pi, -0.75, 64, ball});
  list.push_back({"x2_uniform", "x^2 on [0,2], uniform density", week3 + ", chapter 3", 1, 8.0 / 3, -1.5, 16,
                  [](Unit u) { return 2 * mc::sqr(2 * u[0]); }});
  list.push_back({"x2_linear", "x^2 on [0,2], density x/2", week3 + ", chapter 3", 1, 8.0 / 3, 0, 16, [](Unit u) {
                    const double x = 2 * std::sqrt(u[0]);
                    return 2 * x; // x^2 / (x / 2)
                  }});
  list.push_back({"x2_quadratic", "x^2 on [0,2], density 3 x^2 / 8: no error at all", week3 + ", chapter 3", 1, 8.0 / 3,
                  0, 16, [](Unit u) {
                    const double x = 2 * std::cbrt(1 - u[0]); // 1 - u, so that x > 0
                    return x * x / (3 * x * x / 8);
                  }});
  list.push_back({"cos2_sphere", "cos^2 over the sphere", week3 + ", chapter 4", 2, 4 * pi / 3, -1.0, 64, [](Unit u) {
                    const mc::UniformSphere<double> warp;
                    const auto w = warp.sample(pair(u));
                    return mc::sqr(w.z()) / warp.pdf(w);
                  }});
  list.push_back({"cos3_hemisphere_uniform", "cos^3 over the hemisphere, uniform density", week3 + ", chapter 7", 2,
                  pi / 2, -1.0, 64, [](Unit u) {
                    const mc::UniformHemisphere<double> warp;
                    const auto w = warp.sample(pair(u));
                    return w.z() * w.z() * w.z() / warp.pdf(w);
                  }});
  list.push_back({"cos3_hemisphere_cosine", "cos^3 over the hemisphere, density cos/pi", week3 + ", chapter 7", 2,
                  pi / 2, -1.0, 64, [](Unit u) {
                    const mc::CosineHemisphere<double> warp;
                    const auto w = warp.sample(pair(u));
                    return w.z() * w.z() * w.z() / warp.pdf(w);
                  }});
  list.push_back({"ball_3d", "volume of the ball in 3 dimensions by darts", week3 + ", chapter 2", 3, 4 * pi / 3,
                  -0.5 - 1.0 / 6, 64, ball});
  list.push_back({"ball_5d", "volume of the ball in 5 dimensions by darts", week3 + ", chapter 2", 5, 8 * pi * pi / 15,
                  -0.6, 64, ball});
  list.push_back({"adversarial", "-cos(2 pi x) on [0,100]: a regular grid sees only the crests", codex, 1, 0, -1.5,
                  1024, [](Unit u) { return -100 * std::cos(200 * mc::pi<double> * u[0]); }});
  return list;
}

} // namespace

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> list = make();
  return list;
}

const Experiment& experiment(const std::string& name) {
  std::vector<std::string_view> names;
  for (const Experiment& e : experiments()) {
    if (e.name == name) return e;
    names.push_back(e.name);
  }
  throw mc::Error(fmt::format("unknown experiment '{}'{}; --list shows them all", name, mc::did_you_mean(name, names)));
}

} // namespace carlo
