#include <mc/warp/cone.h>

#include <mc/gtest/matchers.h>

namespace mc {
namespace {

template <class S> class ConeOver : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ConeOver, Scalars);

TYPED_TEST(ConeOver, ObeysTheLawsAtAnyAngle) {
  using S = TypeParam;
  for (const double angle : {1e-9, 1e-5, 0.01, 1.0, 3.0, 3.14159})
    EXPECT_WARP_LAWS(
        UniformCone<S>::from_angle(S(angle)),
        {.name = fmt::format("angle {}", angle), .statistics = {.samples = 0}, .invert_eps = 16, .pdf_eps = 16});
}

// A cone of 1e-9 rad has a solid angle of pi 1e-18 sr. A cone stored by its rounded cosine would have none.
TYPED_TEST(ConeOver, NarrowConesKeepTheirSolidAngle) {
  using S = TypeParam;
  const auto cone = UniformCone<S>::from_angle(S(1e-9));
  EXPECT_NEAR(double(cone.pdf({S(0), S(0), S(1)})) * 3.14159265358979e-18, 1, 1e-6);
  const auto same = UniformCone<S>::from_sin2(S(1e-18));
  EXPECT_NEAR(double(same.pdf({S(0), S(0), S(1)})) / double(cone.pdf({S(0), S(0), S(1)})), 1, 1e-6);
}

TYPED_TEST(ConeOver, PdfWithoutACone) {
  using S = TypeParam;
  const Vec3<S> z(S(0), S(0), S(1));
  for (S sin2 = 1; sin2 > S(1e-36); sin2 *= S(0.37)) {
    const S pdf = UniformCone<S>::from_sin2(sin2).pdf(z);
    EXPECT_LE(std::abs(UniformCone<S>::pdf_from_sin2(sin2) - pdf), 4 * std::numeric_limits<S>::epsilon() * pdf) << sin2;
  }
}

TEST(UniformCone, FormsAgree) {
  const Vec3<double> z(0, 0, 1);
  const double angle = 0.7, pdf = UniformCone<double>::from_angle(angle).pdf(z);
  EXPECT_NEAR(UniformCone<double>::from_cos(std::cos(angle)).pdf(z) / pdf, 1, 1e-14);
  EXPECT_NEAR(UniformCone<double>::from_one_minus_cos(1 - std::cos(angle)).pdf(z) / pdf, 1, 1e-14);
  EXPECT_NEAR(UniformCone<double>::from_sin2(sqr(std::sin(angle))).pdf(z) / pdf, 1, 1e-14);
  EXPECT_EQ(UniformCone<double>::from_angle(angle).pdf({std::sin(0.71), 0, std::cos(0.71)}), 0);
  // Solid angles of the sphere in the Cornell box, from the origin and from the floor below the light, and of a sphere
  // that subtends a sixth of a turn.
  EXPECT_NEAR(1 / UniformCone<double>::from_sin2(0.25).pdf(z), 0.841787214477, 1e-12);
}

TEST(UniformCone, RefusesNonsense) {
  for (const double bad : {0.0, -1.0, 3.2, double(NAN)})
    EXPECT_THROW(UniformCone<double>::from_angle(bad), Error) << bad;
  EXPECT_THROW(UniformCone<double>::from_cos(1), Error);
  EXPECT_THROW(UniformCone<double>::from_sin2(1.1), Error);
  EXPECT_THROW(UniformCone<double>::from_one_minus_cos(0), Error);
}

} // namespace
} // namespace mc
