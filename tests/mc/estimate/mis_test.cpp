#include <mc/estimate/mis.h>

#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>
#include <mc/warp/cone.h>
#include <mc/warp/hemisphere.h>

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace {

template <class S> class Mis : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Mis, Scalars);

template <class S> std::vector<mc::Heuristic<S>> heuristics() {
  using H = mc::Heuristic<S>;
  return {H::balance(), H::power(2), H::power(S(1.5)), H::power(S(0.5)), H::cutoff(S(0.1)), H::cutoff(1), H::maximum()};
}

// For every triple of these densities and every heuristic, the weights must sum to 1 within (n + 2) eps.
TYPED_TEST(Mis, WeightsSumToOneOverTheWholeRange) {
  using S = TypeParam;
  const S inf = std::numeric_limits<S>::infinity();
  const std::vector<S> values = {S(0),    std::numeric_limits<S>::denorm_min(), S(1e-30), S(1e-24), S(1), S(1e20),
                                 S(1e30), std::numeric_limits<S>::max(),        inf};
  for (const S a : values)
    for (const S b : values)
      for (const S c : values)
        for (const mc::Heuristic<S>& h : heuristics<S>()) {
          const std::vector<S> p = {a, b, c}, n = {S(1), S(4), S(2)};
          S sum(0);
          for (std::size_t i = 0; i < 3; ++i) {
            const S w = mc::mis_weight<S>(i, p, n, h);
            EXPECT_TRUE(w >= 0 && w <= 1) << w;
            sum += w;
          }
          const S wanted = std::max({a, b, c}) > 0 ? S(1) : S(0);
          EXPECT_LE(std::abs(sum - wanted), 5 * std::numeric_limits<S>::epsilon())
              << a << ' ' << b << ' ' << c << ' ' << h.beta << ' ' << h.alpha;
        }
}

// Same for 100 techniques, with densities spread over the range.
TYPED_TEST(Mis, WeightsOfAHundredTechniquesSumToOne) {
  using S = TypeParam;
  std::vector<S> p, n;
  for (int j = 0; j < 100; ++j) {
    p.push_back(static_cast<S>(std::pow(10.0, 0.7 * j - 35)));
    n.push_back(static_cast<S>(1 + j % 7));
  }
  for (const mc::Heuristic<S>& h : heuristics<S>()) {
    S sum(0);
    for (std::size_t i = 0; i < p.size(); ++i) sum += mc::mis_weight<S>(i, p, n, h);
    EXPECT_LE(std::abs(sum - 1), 102 * std::numeric_limits<S>::epsilon());
  }
}

// The closed forms for two techniques must equal the general weights within 4 eps, also for zeros, deltas and counts of
// 0.
TYPED_TEST(Mis, TwoTechniquesWeighAsManyDo) {
  using S = TypeParam;
  using H = mc::Heuristic<S>;
  using Limits = std::numeric_limits<S>;
  const S eps = Limits::epsilon();
  std::vector<S> densities = {S(0), Limits::denorm_min(), S(1e-30), S(1), S(1e30), Limits::max(), Limits::infinity()};
  mc::Pcg random(5);
  for (int k = 0; k < 60; ++k) densities.push_back(S(std::pow(10.0, 60 * random.uniform<double>() - 30)));
  for (const S f : densities)
    for (const S g : densities)
      for (const S n_f : {S(0), S(0.3), S(1), S(64)})
        for (const S n_g : {S(0), S(0.7), S(1), S(16)}) {
          const std::vector<S> p = {f, g}, n = {n_f, n_g};
          const auto where = [&] { return fmt::format("f {} g {} n {} {}", f, g, n_f, n_g); };
          EXPECT_LE(std::abs(mc::balance_heuristic(n_f, f, n_g, g) - mc::mis_weight<S>(0, p, n, H::balance())), 4 * eps)
              << where();
          EXPECT_LE(std::abs(mc::power_heuristic(n_f, f, n_g, g) - mc::mis_weight<S>(0, p, n, H::power(2))), 4 * eps)
              << where();
        }
  EXPECT_NEAR(mc::power_heuristic(S(3), S(1)), S(0.9), eps);
  EXPECT_EQ(mc::balance_heuristic(S(3), S(1)), S(0.75));
}

TYPED_TEST(Mis, HeuristicsAsVeachDefinesThem) {
  using S = TypeParam;
  using H = mc::Heuristic<S>;
  const S eps = std::numeric_limits<S>::epsilon();
  const std::vector<S> p = {S(8), S(4), S(0.5)}, n = {S(1), S(4), S(2)}; // n p = 8, 16, 1
  const auto weight = [&](std::size_t i, const H& h) { return mc::mis_weight<S>(i, p, n, h); };
  EXPECT_NEAR(weight(0, H::balance()), S(8) / 25, eps);
  EXPECT_NEAR(weight(1, H::power(2)), S(256) / 321, eps);
  EXPECT_NEAR(weight(0, H::cutoff(S(0.1))), S(8) / 24, eps);
  EXPECT_EQ(weight(2, H::cutoff(S(0.1))), S(0));
  EXPECT_EQ(weight(1, H::maximum()), S(1));
  EXPECT_EQ(weight(0, H::maximum()), S(0));
}

TYPED_TEST(Mis, PowerHeuristicWhereSquaresLeaveTheRange) {
  using S = TypeParam;
  EXPECT_EQ(mc::power_heuristic<S>(1, S(1e20), 1, S(1e20)), S(0.5));
  EXPECT_EQ(mc::power_heuristic<S>(1, S(1e-24), 1, S(1e-24)), S(0.5));
  EXPECT_EQ(mc::power_heuristic<S>(1, std::numeric_limits<S>::infinity(), 1, S(1)), S(1));
  EXPECT_NEAR(mc::power_heuristic<S>(1, S(3e-24), 1, S(1e-24)), S(0.9), S(1e-6));
}

TYPED_TEST(Mis, BalanceCountsSamples) {
  using S = TypeParam;
  EXPECT_NEAR(mc::balance_heuristic<S>(1, S(2), 3, S(2)), S(0.25), S(1e-6));
  EXPECT_EQ(mc::balance_heuristic<S>(0, S(2), 3, S(2)), S(0));
}

TEST(Heuristic, RefusesNonsense) {
  using H = mc::Heuristic<double>;
  for (const double bad : {0.0, -1.0, double(NAN)}) EXPECT_THROW(H::power(bad), mc::Error) << bad;
  for (const double bad : {-0.1, 1.1, double(NAN)}) EXPECT_THROW(H::cutoff(bad), mc::Error) << bad;
}

// A cone is a warp onto its cap. As a technique it must use the common domain.
struct ConeOnHemisphere {
  using Scalar = double;
  using Domain = mc::Hemisphere<double>;
  mc::UniformCone<double> cone;
  Domain domain() const { return {}; }
  mc::Vec3<double> sample(const mc::Vec2<double>& u) const { return cone.sample(u); }
  double pdf(const mc::Vec3<double>& w) const { return cone.pdf(w); }
  template <mc::Real T> ConeOnHemisphere cast() const { return *this; }
};

// A narrow light of 1e-2 rad in a wide glow: integral over the hemisphere of cos times 1000 in a cone and 1 elsewhere.
// Both estimators are unbiased for every heuristic. 5 standard errors are a false alarm in 6e-7 of seeds; the seeds are
// fixed.
TEST(MultipleImportance, IsUnbiasedWithEveryHeuristic) {
  using V = mc::Vec3<double>;
  const auto cone = mc::UniformCone<double>::from_angle(0.01);
  const mc::CosineHemisphere<double> cosine;
  const mc::UniformHemisphere<double> uniform;
  const auto f = [&](const V& w) { return w.z() * (w.z() > std::cos(0.01) ? 1000 : 1); };
  const double truth = mc::pi<double> * (1 + 999 * mc::sqr(std::sin(0.01)));
  for (const auto& h : heuristics<double>()) {
    const mc::MultipleImportance techniques(std::array{2.0, 1.0, 1.0}, h, ConeOnHemisphere{cone}, cosine, uniform);
    mc::Pcg random(4);
    mc::Moments many, one;
    for (int i = 0; i < 20000; ++i) {
      many.add(techniques.multi_sample(f, [&] { return random.point<double, 2>(); }));
      const double uc = random.uniform<double>();
      one.add(techniques.one_sample(f, uc, random.point<double, 2>()));
    }
    EXPECT_LE(std::abs(many.mean() - truth), 5 * many.std_error()) << h.beta << ' ' << h.alpha;
    EXPECT_LE(std::abs(one.mean() - truth), 5 * one.std_error()) << h.beta << ' ' << h.alpha;
    EXPECT_LT(many.variance(), one.variance()); // four samples against one
  }
}

TEST(MultipleImportance, NeverDrawsFromATechniqueOfCountZero) {
  const mc::UniformHemisphere<double> uniform;
  const mc::CosineHemisphere<double> cosine;
  const auto f = [](const mc::Vec3<double>& w) { return w.z(); };
  for (const double uc : {0.0, 0.5, mc::one_minus_epsilon<double>}) {
    EXPECT_NEAR(
        mc::MultipleImportance(std::array{0.0, 3.0, 0.0}, {}, uniform, cosine, uniform).one_sample(f, uc, {0.3, 0.4}),
        mc::pi<double>, 1e-14);
  }
  EXPECT_NEAR(mc::MultipleImportance(std::array{0.0, 3.0}, {}, uniform, cosine)
                  .multi_sample(f, [] { return mc::Vec2<double>(0.1, 0.2); }),
              mc::pi<double>, 1e-14);
}

TEST(MultipleImportance, RefusesNonsense) {
  const mc::UniformHemisphere<double> uniform;
  const auto make = [&](double a, double b) {
    return mc::MultipleImportance(std::array{a, b}, mc::Heuristic<double>{}, uniform, uniform);
  };
  EXPECT_THROW(make(0, 0), mc::Error);
  EXPECT_THROW(make(-1, 2), mc::Error);
  EXPECT_THROW(make(1, NAN), mc::Error);
}

TEST(MultipleImportance, CountsBeyondTheScalar) {
  using Cosine = mc::CosineHemisphere<float>;
  const auto of = [](float a, float b) {
    return mc::MultipleImportance(std::array{a, b}, mc::Heuristic<float>::balance(), Cosine(), Cosine());
  };
  EXPECT_THROW(of(3e38f, 3e38f), mc::Error);
  // A float counter with steps of 1 stops at 2^24.
  std::uint64_t asked = 0;
  of(17'000'000, 0)
      .multi_sample([](const auto&) { return 0.0; },
                    [&] {
                      ++asked;
                      return mc::Vec2<float>(0.5f, 0.5f);
                    });
  EXPECT_EQ(asked, 17'000'000u);
}

} // namespace
