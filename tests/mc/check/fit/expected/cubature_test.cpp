#include <mc/check/fit/expected/cubature.h>

#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/random/pcg.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

namespace {

using Point = mc::PerAxis<double>;

struct Case {
  const char* name;
  int dim;
  std::function<double(const Point&)> f;
  double exact;
};

std::vector<Case> cases() {
  using std::sqrt, std::exp, std::abs;
  return {
      {"smooth", 2, [](const Point& v) { return exp(-v[0] - 2 * v[1]); }, (1 - exp(-1)) * (1 - exp(-2)) / 2},
      {"square root at a face", 1, [](const Point& v) { return sqrt(v[0]); }, 2.0 / 3},
      {"singular at a face", 1, [](const Point& v) { return 0.5 / sqrt(v[0]); }, 1},
      {"kink", 2, [](const Point& v) { return abs(v[0] - 0.3); }, (0.09 + 0.49) / 2},
      {"step beside a dyadic place", 1, [](const Point& v) { return v[0] < 0.501 ? 1.0 : 0.0; }, 0.501},
      {"disk", 2, [](const Point& v) { return v[0] * v[0] + v[1] * v[1] < 1 ? 1.0 : 0.0; }, mc::pi<double> / 4},
      {"half sphere", 2, [](const Point& v) { return mc::safe_sqrt(1 - v[0] * v[0] - v[1] * v[1]); },
       mc::pi<double> / 6},
      {"edge with a root", 2, [](const Point& v) { return mc::safe_sqrt(0.37 - v[0]); }, 2.0 / 3 * std::pow(0.37, 1.5)},
      {"narrow lobe at the face", 2, [](const Point& v) { return exp(-v[0] * 1e4) * 1e4; }, 1},
      {"300 random steps", 1,
       [](const Point& v) { return mc::hash_uniform<double>(1, static_cast<std::uint64_t>(v[0] * 300)); },
       [] {
         double sum = 0;
         for (std::uint64_t i = 0; i < 300; ++i) sum += mc::hash_uniform<double>(1, i);
         return sum / 300;
       }()},
      {"smooth in three dimensions", 3, [](const Point& v) { return exp(v[0] + v[1] + v[2]); },
       std::pow(std::exp(1) - 1, 3)},
  };
}

TEST(Cubature, Error_IsWithinStatedBound) {
  for (const Case& c : cases())
    for (const double goal : {1e-3, 1e-4, 1e-5}) {
      mc::CubatureGoal g;
      g.total_error = goal;
      const mc::CubatureResult r = integrate_boxes(c.f, c.dim, {mc::UnitBox{}}, g);
      // For the curved edge of a disk the number of evaluations grows as 1 / error.
      if (std::string(c.name) == "disk" && goal < 1e-4) continue;
      EXPECT_TRUE(r.converged) << c.name << " " << r.evaluations;
      EXPECT_LE(r.total.error, goal) << c.name;
      EXPECT_LE(std::abs(r.total.value - c.exact), r.total.error + 1e-14) << c.name << " goal " << goal;
    }
}

// A factor f(x) on [0,1] with its integral.
struct Factor {
  std::function<double(double)> f;
  double integral;
};

Factor random_factor(mc::Pcg& random) {
  const double a = random.uniform<double>(), b = random.uniform<double>();
  const double rate = std::exp(7 * b - 1); // 0.4 to 400
  switch (random.next32() % 7) {
  case 0: return {[=](double x) { return std::exp(-rate * x); }, -std::expm1(-rate) / rate};
  case 1: { // Gaussian lobe, no narrower than the gap between two nodes
    const double inverse = std::min(rate, 12.0);
    const auto antiderivative = [=](double x) {
      return std::sqrt(mc::pi<double>) / (2 * inverse) * std::erf(inverse * (x - a));
    };
    return {[=](double x) { return std::exp(-mc::sqr(inverse * (x - a))); }, antiderivative(1) - antiderivative(0)};
  }
  case 2: return {[=](double x) { return x < a ? 1.0 : b; }, a + (1 - a) * b};
  case 3: return {[=](double x) { return std::abs(x - a) + 0.1 * b; }, (a * a + (1 - a) * (1 - a)) / 2 + 0.1 * b};
  case 4: return {[=](double x) { return std::pow(x, 3 * a - 0.5); }, 1 / (3 * a + 0.5)};
  case 5:
    return {[=](double x) { return 1 + std::cos(rate / 4 * x + a); },
            1 + (std::sin(rate / 4 + a) - std::sin(a)) / (rate / 4)};
  default: return {[=](double x) { return mc::safe_sqrt(a - x); }, std::pow(a, 1.5) * 2 / 3};
  }
}

// The bound holds for 300 products of random factors: lobes, steps, kinks, singular powers, oscillations and edges with
// a root.
TEST(Cubature, Error_RandomProducts_IsWithinStatedBound) {
  mc::Pcg random(77);
  for (int k = 0; k < 300; ++k) {
    const int dim = k % 10 == 0 ? 3 : 1 + k % 2;
    std::vector<Factor> factors;
    double exact = 1;
    for (int d = 0; d < dim; ++d) {
      factors.push_back(random_factor(random));
      exact *= factors.back().integral;
    }
    mc::CubatureGoal goal;
    goal.total_error = 1e-4 * exact;
    goal.max_evaluations = 200'000;
    const auto r = mc::integrate_boxes(
        [&](const Point& v) {
          double product = 1;
          for (std::size_t d = 0; d < factors.size(); ++d) product *= factors[d].f(v[d]);
          return product;
        },
        dim, {mc::UnitBox{}}, goal);
    EXPECT_LE(std::abs(r.total.value - exact), r.total.error + 1e-14) << k << ", dim " << dim;
  }
}

TEST(Cubature, BoxIntegrals_AddUpToTotal) {
  std::vector<mc::UnitBox> boxes(4);
  for (std::size_t i = 0; i < 4; ++i) {
    boxes[i].lo[0] = static_cast<double>(i) / 4;
    boxes[i].hi[0] = static_cast<double>(i + 1) / 4;
  }
  const auto r = mc::integrate_boxes([](const Point& v) { return 3 * v[0] * v[0]; }, 2, boxes);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(r.boxes[i].value,
                std::pow((static_cast<double>(i) + 1) / 4, 3) - std::pow(static_cast<double>(i) / 4, 3), 1e-7);
  EXPECT_NEAR(r.total.value, 1, 3e-7);
}

TEST(Cubature, BudgetExhausted_ReportsNotConverged) {
  mc::CubatureGoal g;
  g.total_error = 1e-9;
  g.max_evaluations = 1000;
  const auto r = mc::integrate_boxes([](const Point& v) { return v[0] * v[0] + v[1] * v[1] < 1 ? 1.0 : 0.0; }, 2,
                                     {mc::UnitBox{}}, g);
  EXPECT_FALSE(r.converged);
  EXPECT_LE(std::abs(r.total.value - mc::pi<double> / 4), r.total.error);
}

TEST(Cubature, InvalidDensity_KeepsFirstPoint) {
  const auto r =
      mc::integrate_boxes([](const Point& v) { return v[0] > 0.9 ? std::nan("") : 1.0; }, 1, {mc::UnitBox{}});
  ASSERT_TRUE(r.invalid_point.has_value());
  EXPECT_GT((*r.invalid_point)[0], 0.9);
  EXPECT_TRUE(mc::integrate_boxes([](const Point&) { return -1.0; }, 1, {mc::UnitBox{}}).invalid_point.has_value());
  EXPECT_THROW(mc::integrate_boxes([](const Point&) { return 1.0; }, 4, {mc::UnitBox{}}), mc::Error);
}

} // namespace
