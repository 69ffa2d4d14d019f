#include <render/bsdf/rough_fresnel.h>

#include <render/bsdf/bsdf.h>

#include <mc/estimate/moments.h>
#include <mc/random/pcg.h>

#include <gtest/gtest.h>

namespace {

using namespace render;

double random_log_uniform(mc::Pcg& random, double low, double high) {
  return low * std::pow(high / low, random.uniform<double>());
}

CoatFacets trowbridge_reitz(double alpha) { return TrowbridgeReitzFacets(Float(alpha)); }

// 120 coats against samples of rough glass, which do not use the table. The bound is five standard errors plus the
// errors stated in the header.
TEST(RoughFresnel, AgreesWithRoughDielectric) {
  mc::Pcg random(21);
  for (int k = 0; k < 120; ++k) {
    const double eta = k % 4 ? random_log_uniform(random, 1.01, 3) : random_log_uniform(random, 0.4, 0.99);
    const double alpha = random_log_uniform(random, 1e-4, 1), cosine = random_log_uniform(random, 1e-3, 1);
    const bool beckmann = k % 2;
    const CoatFacets facets = beckmann ? CoatFacets(BeckmannFacets(Float(alpha))) : trowbridge_reitz(alpha);
    const RoughFresnel::Albedos shares = RoughFresnel(Float(eta), facets).eval(Float(cosine));
    const Bsdf glass = beckmann ? Bsdf(RoughDielectric<BeckmannFacets>(Float(eta), Float(alpha)))
                                : Bsdf(RoughDielectric<>(Float(eta), Float(alpha)));
    const Vec3 wo = Vec3d(std::sqrt(1 - cosine * cosine), 0, cosine).cast<Float>();
    mc::Moments reflected, transmitted;
    for (int i = 0; i < 8000; ++i) {
      const Float uc = random.uniform<Float>(), u0 = random.uniform<Float>(), u1 = random.uniform<Float>();
      const auto s = glass.sample(wo, uc, Vec2(u0, u1));
      const double share =
          s ? double(s->f[0]) * std::abs(double(s->wi.z())) * mc::sqr(double(s->eta)) / double(s->pdf) : 0;
      reflected.add(s && s->wi.z() > 0 ? share : 0);
      transmitted.add(s && s->wi.z() < 0 ? share : 0);
    }
    const auto where = [&] { return fmt::format("eta {}, alpha {}, cosine {}", eta, alpha, cosine); };
    EXPECT_NEAR(shares.reflected, reflected.mean(), 5 * reflected.std_error() + (eta > 1 ? 0.02 : 0.07)) << where();
    EXPECT_NEAR(shares.transmitted, transmitted.mean(), 5 * transmitted.std_error() + (eta > 1 ? 0.002 : 0.02))
        << where();
    EXPECT_LE(shares.reflected + shares.transmitted, 1 + 3e-4) << where();
  }
}

// Between the tables of two roughnesses, against a table of the roughness itself.
TEST(RoughFresnel, InterpolatesRoughness) {
  mc::Pcg random(22);
  for (const double eta : {0.6, 1.01, 1.5, 3.0})
    for (const bool beckmann : {false, true}) {
      const auto facets_of = [&](Float alpha) {
        return beckmann ? CoatFacets(BeckmannFacets(alpha)) : CoatFacets(TrowbridgeReitzFacets(alpha));
      };
      RoughFresnel coats = RoughFresnel::of_all_roughnesses(Float(eta), facets_of);
      for (int k = 0; k < 12; ++k) {
        const auto alpha = k ? Float(random_log_uniform(random, 1e-4, 1)) : Float(1);
        const RoughFresnel coat(Float(eta), facets_of(alpha));
        coats.set_alpha(alpha);
        EXPECT_NEAR(coats.mean_transmitted(), coat.mean_transmitted(), 0.001) << eta << ", " << alpha;
        for (double cosine = 0.005; cosine < 1; cosine += 0.005) {
          const RoughFresnel::Albedos a = coats.eval(Float(cosine)), b = coat.eval(Float(cosine));
          EXPECT_NEAR(a.transmitted, b.transmitted, 0.022) << eta << ", " << alpha << ", " << cosine;
          EXPECT_NEAR(a.reflected, b.reflected, 0.022) << eta << ", " << alpha << ", " << cosine;
        }
      }
    }
}

TEST(RoughFresnel, MeanTransmittanceIsExactForTable) {
  for (const double eta : {0.7, 1.0, 1.5})
    for (const double alpha : {1e-4, 0.1, 1.0}) {
      const RoughFresnel coat{Float(eta), trowbridge_reitz(alpha)};
      const int n = 200'000;
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += 2 * (i + 0.5) / n * double(coat.eval(Float((i + 0.5) / n)).transmitted) / n;
      EXPECT_NEAR(coat.mean_transmitted(), sum, 1e-5) << eta << ", " << alpha;
    }
  // The hemispherical reflectance of smooth glass.
  EXPECT_NEAR(RoughFresnel(Float(1.5), trowbridge_reitz(1e-4)).mean_transmitted(), 1 - 0.091777959342, 2e-4);
}

// The table of a smooth coat contains the Fresnel equations.
TEST(RoughFresnel, ZeroRoughness_IsExactAtNodes) {
  for (const double eta : {0.7, 1.0, 1.5, 3.0}) {
    const RoughFresnel coat{Float(eta), {}};
    for (double cosine = 0.001; cosine < 1; cosine += 0.001) {
      const Float f = fresnel_dielectric(Float(cosine), Float(eta)).reflectance;
      const RoughFresnel::Albedos shares = coat.eval(Float(cosine));
      EXPECT_NEAR(shares.reflected, f, eta < 1 ? 0.02 : 0.002) << eta << ", " << cosine;
      EXPECT_NEAR(shares.reflected + shares.transmitted, 1, 1e-6) << eta << ", " << cosine;
    }
  }
  EXPECT_NEAR(RoughFresnel(Float(1.5), {}).mean_transmitted(), 1 - 0.091777959342, 2e-4);
}

// Uniform light has the same transmittance in both directions through a boundary, except for the squared index. So the
// mean from the outside determines the light that the coat returns to the base.
TEST(RoughFresnel, TransmittanceIsReciprocal) {
  for (const double eta : {1.2, 1.5, 2.0})
    for (const double alpha : {1e-4, 0.1, 0.5, 1.0})
      EXPECT_NEAR(RoughFresnel(Float(eta), trowbridge_reitz(alpha)).mean_transmitted(),
                  eta * eta * RoughFresnel(Float(1 / eta), trowbridge_reitz(alpha)).mean_transmitted(), 0.004)
          << eta << ", " << alpha;
}

// Extreme indices give shares in [0, 1], not NaN.
TEST(RoughFresnel, AnyIndex_StaysWithinStatedError) {
  for (const double eta : {1e-6, 1e-3, 0.04, 0.999999, 1.000001, 100.0, 1e6})
    for (const double alpha : {1e-4, 1.0})
      for (const double cosine : {0.0, 1e-6, 0.5, 0.9989, 0.999, 0.9999, 1.0}) {
        const auto [r, t] = RoughFresnel(Float(eta), trowbridge_reitz(alpha)).eval(Float(cosine));
        EXPECT_TRUE(r >= 0 && t >= 0 && r + t <= Float(1.0003))
            << eta << ", " << alpha << ", " << cosine << ": " << r << ' ' << t;
      }
}

} // namespace
