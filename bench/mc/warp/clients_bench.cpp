// Warps as a renderer uses them, compared with handwritten code: a warp must not cost more than its formula.
#include "../../speed.h"

#include <mc/estimate/mis.h>
#include <mc/table/discrete.h>
#include <mc/table/table_dist_1d.h>
#include <mc/warp/ball.h>
#include <mc/warp/isotropic_normal.h>
#include <mc/warp/mixture_n.h>
#include <mc/warp/product.h>
#include <mc/warp/sphere_light.h>
#include <mc/warp/uniform.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using mc::Vec2, mc::Vec3;
constexpr float pi = std::numbers::pi_v<float>;

template <class F> void measure(const std::string& name, F f) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    const auto points = bench::random_points<float>();
    for ([[maybe_unused]] const auto _ : state)
      for (const Vec2<float>& u : points) benchmark::DoNotOptimize(f(u));
    bench::set_counters(state, static_cast<double>(points.size()));
  });
}

float tent(float u) { return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u); }

void heuristics() {
  measure("power_heuristic", [](const Vec2<float>& u) { return mc::power_heuristic(u[0], u[1]); });
  measure("power_heuristic, by hand", [](const Vec2<float>& u) {
    const float ratio = u[1] / u[0];
    return 1 / (1 + ratio * ratio);
  });
}

void filters() {
  const mc::UniformBox<float, 2> box(Vec2<float>(-0.5f, -0.5f), Vec2<float>(0.5f, 0.5f));
  measure("UniformBox", [box](const Vec2<float>& u) { return box.sample(u); });
  measure("UniformBox, by hand",
          [r = 0.5f](const Vec2<float>& u) -> Vec2<float> { return r * (2 * u - Vec2<float>::Ones()); });
  const mc::Tent2D<float> tents{{0, 1.5f}, {0, 1.5f}};
  measure("Tent2D", [tents](const Vec2<float>& u) { return tents.sample(u); });
  measure("Tent2D, by hand", [r = 1.5f](const Vec2<float>& u) { return Vec2<float>(r * tent(u[0]), r * tent(u[1])); });
  const mc::IsotropicNormal<float> gaussian(0.5f);
  measure("IsotropicNormal", [gaussian](const Vec2<float>& u) { return gaussian.sample(u); });
  measure("IsotropicNormal, by hand", [sigma = 0.5f](const Vec2<float>& u) {
    const float r = sigma * std::sqrt(-2 * std::log(1 - u[0])), phi = 2 * pi * u[1];
    return Vec2<float>(r * std::cos(phi), r * std::sin(phi));
  });
  const mc::MixtureN axis(mc::Interval<float>(-1, 1), mc::UniformDiscrete<float>(2),
                          std::vector<mc::Tent<float>>{{-0.25f, 0.5f}, {0.25f, 0.5f}});
  const mc::Product four{axis, axis};
  measure("2 x 2 tents", [four](const Vec2<float>& u) { return four.sample(u); });
  const auto by_hand = [n = 2, r = 0.5f](float u) {
    const float cell = std::min(std::floor(u * float(n)), float(n - 1));
    return (cell + 0.5f) / float(n) - 0.5f + r * tent(u * float(n) - cell);
  };
  measure("2 x 2 tents, by hand",
          [by_hand](const Vec2<float>& u) { return Vec2<float>(by_hand(u[0]), by_hand(u[1])); });
}

void balls_and_spheres() {
  measure("UniformBall", [](const Vec2<float>& u) { return mc::UniformBall<float>{}.sample({u[1], u[0], u[1]}); });
  measure("UniformBall, by hand", [](const Vec2<float>& u) -> Vec3<float> {
    const float z = 1 - 2 * u[0];
    return std::cbrt(u[1]) *
           mc::spherical_direction<float>(2 * mc::safe_sqrt<float>(u[0] * (1 - u[0])), z, 2 * pi * u[1]);
  });
  // Constructed at each point, in double as in the shapes, with the density of the direction.
  const auto toward = [](const Vec2<float>& u) { return Vec3<double>(u[0], u[1], 5); };
  measure("SphereLight, made anew", [toward](const Vec2<float>& u) {
    const mc::SphereLight<double> light(toward(u), 1);
    const Vec3<double> w = light.frame().to_world(light.sample(u.cast<double>()));
    return Vec3<double>(w * (1 / light.solid_angle()));
  });
  measure("SphereLight, made anew, by hand", [toward](const Vec2<float>& u) {
    const Vec3<double> t = toward(u);
    const double d2 = t.squaredNorm(), sin2 = 1 / d2, h = sin2 / (1 + std::sqrt(1 - sin2)), v = double(u[0]) * h;
    const float phi = 2 * pi * u[1];
    const double s = std::sqrt(v * (2 - v));
    const auto frame = mc::Frame<double>::from_z(t / std::sqrt(d2));
    const Vec3<double> w = frame.to_world({s * double(std::cos(phi)), s * double(std::sin(phi)), 1 - v});
    return Vec3<double>(w * (1 / (2 * mc::pi<double> * h)));
  });
}

void choices() {
  for (const std::size_t n : {1, 2, 4, 16}) {
    std::vector<double> weights(n);
    std::vector<float> ends(n), pmf(n);
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      weights[i] = 1 + double(i % 3);
      sum += weights[i];
    }
    double below = 0;
    for (std::size_t i = 0; i < n; ++i) {
      below += weights[i];
      ends[i] = float(below / sum);
      pmf[i] = float(weights[i] / sum);
    }
    const mc::TableDist1D<float> table(weights);
    measure(fmt::format("TableDist1D {}, index + pmf", n), [table](const Vec2<float>& u) {
      const auto s = table.sample_index(u[0]);
      return std::pair(s.index, s.pmf);
    });
    measure(fmt::format("TableDist1D {}, index + pmf, by hand", n), [=](const Vec2<float>& u) {
      auto i = std::size_t(std::upper_bound(ends.begin(), ends.end(), u[0]) - ends.begin());
      i = std::min(i, n - 1);
      while (i > 0 && pmf[i] == 0) --i;
      return std::pair(i, pmf[i]);
    });
  }
  measure("UniformDiscrete 5", [choice = mc::UniformDiscrete<float>(5)](const Vec2<float>& u) {
    const auto s = choice.sample_index(u[0]);
    return std::pair(s.index, s.u_remapped);
  });
  measure("UniformDiscrete 5, by hand", [n = 5.0f](const Vec2<float>& u) {
    const float i = std::floor(u[0] * n);
    return std::pair(std::size_t(i), u[0] * n - i);
  });
  measure("Bernoulli", [choice = mc::Bernoulli<float>(0.25f)](const Vec2<float>& u) {
    const auto s = choice.sample_index(u[0]);
    return std::pair(s.index, s.u_remapped);
  });
  measure("Bernoulli, by hand", [share = 0.25f](const Vec2<float>& u) {
    if (u[0] < share) return std::pair(std::size_t(1), std::min(u[0] / share, mc::one_minus_epsilon<float>));
    return std::pair(std::size_t(0), std::min((u[0] - share) / (1 - share), mc::one_minus_epsilon<float>));
  });
}

const bool registered = [] {
  heuristics();
  filters();
  balls_and_spheres();
  choices();
  return true;
}();

} // namespace
