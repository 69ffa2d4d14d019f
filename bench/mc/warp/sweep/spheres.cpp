// Warps of directions.
#include "sweep.h"

#include <mc/warp/ball.h>
#include <mc/warp/cone.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/mixture.h>
#include <mc/warp/rotated.h>
#include <mc/warp/sphere.h>
#include <mc/warp/sphere_light.h>

namespace sweep {
namespace {

double d(const auto& x) { return static_cast<double>(x); }

// A cone from each of three constructors.
template <class S> mc::UniformCone<S> cone(int form, S x) {
  if (form == 0) return mc::UniformCone<S>::from_one_minus_cos(x);
  if (form == 1) return mc::UniformCone<S>::from_angle(x);
  return mc::UniformCone<S>::from_sin2(x);
}

template <class S> void add(std::vector<Row>& rows, const std::string& scalar, const Effort& effort) {
  rows.push_back(run(
      "UniformSphere " + scalar, effort, [](Draw&, std::string&) { return mc::UniformSphere<S>{}; },
      constant({.invert = 8})));
  rows.push_back(run(
      "UniformHemisphere " + scalar, effort, [](Draw&, std::string&) { return mc::UniformHemisphere<S>{}; },
      constant({.invert = 8})));
  rows.push_back(run(
      "CosineHemisphere " + scalar, effort, [](Draw&, std::string&) { return mc::CosineHemisphere<S>{}; },
      constant({.invert = 8})));
  rows.push_back(run(
      "UniformBall " + scalar, effort, [](Draw&, std::string&) { return mc::UniformBall<S>{}; },
      constant({.pdf = 4, .invert = 8})));
  rows.push_back(run(
      "UniformCone " + scalar, effort,
      [](Draw& r, std::string& p) {
        const int form = r.below(3);
        const S x = S(r.log(denormal<S>, 2));
        p = fmt::format("form {} of {}", form, x);
        return cone(form, x);
      },
      constant({})));
  rows.push_back(run(
      "SphereLight " + scalar, effort,
      [](Draw& r, std::string& p) {
        const double distance = r.log(denormal<S>, largest<S>);
        const double ratio = r.often(0.5) ? 1 + r.sign() * r.log(1e-18, 1) : r.log(1e-20, 1e20);
        const mc::Vec3<S> center = r.direction<S>() * S(distance);
        const S radius = S(distance * ratio);
        p = fmt::format("center {} radius {}", detail::text(center), radius);
        return mc::SphereLight<S>(center, radius);
      },
      constant({})));
  rows.push_back(run(
      "Mixture " + scalar, effort,
      [](Draw& r, std::string& p) {
        const S a = S(r.log(denormal<S>, largest<S>)), b = r.often(0.2) ? a : S(r.log(denormal<S>, largest<S>));
        p = fmt::format("weights {} {}", a, b);
        return mc::Mixture(std::array<S, 2>{a, b}, mc::UniformHemisphere<S>{}, mc::UniformHemisphere<S>{});
      },
      constant({.sample = HUGE_VAL})));
  rows.push_back(run(
      "Rotated cone " + scalar, effort,
      [](Draw& r, std::string& p) {
        const S h = S(r.log(1e-3, 2));
        const mc::Vec3<S> axis = r.direction<S>();
        p = fmt::format("1 - cos {} axis {}", h, detail::text(axis));
        return mc::Rotated(mc::UniformCone<S>::from_one_minus_cos(h), axis);
      },
      [](const auto& w) {
        const double h = d(w.warp.domain().h);
        return [h](const auto& u, const auto&) { // u0 to eps / h, u1 to eps / sin
          const double sine = std::sqrt(d(u[0]) * h * std::max(2 - d(u[0]) * h, 1e-30));
          return Bounds{.invert = 16 + 16 / std::sqrt(h) + 4 / std::max(sine, 1e-30)};
        };
      }));
}

} // namespace

std::vector<Row> spheres(const Effort& effort) {
  std::vector<Row> rows;
  add<float>(rows, "float", effort);
  add<double>(rows, "double", effort);
  return rows;
}

} // namespace sweep
