#include <mc/check/subject/quantization.h>

#include <mc/check/laws.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/domain/sphere.h>
#include <mc/warp/blinn_phong.h>
#include <mc/warp/disk.h>
#include <mc/warp/hemisphere.h>

#include <gmock/gmock.h>

namespace {

using testing::HasSubstr;

// A lobe cos^n about +z computed from the cosine, which is rounded to 1 in float for large n.
template <class S> auto lobe_from_cosine(S n) {
  return mc::make_distribution(
      "lobe", mc::Hemisphere<S>(),
      [n](const mc::Vec2<S>& u) {
        const S z = std::pow(S(1) - u[0], 1 / (n + 1)), phi = 2 * mc::pi<S> * u[1];
        const S r = std::sqrt(std::max(S(0), 1 - z * z));
        return mc::Vec3<S>(r * std::cos(phi), r * std::sin(phi), z);
      },
      [n](const mc::Vec3<S>& w) { return (n + 1) / (2 * mc::pi<S>)*std::pow(w.z(), n); });
}

TEST(Quantization, NarrowLobeFromFloatCosine_IsReported) {
  EXPECT_EQ(mc::describe_quantization(lobe_from_cosine(1e6f), 1),
            "cos theta is rounded to float near the pole; compute 1 - cos theta instead");
  EXPECT_EQ(mc::describe_quantization(lobe_from_cosine(1e6), 1), "");
  const mc::Report report = check_laws(lobe_from_cosine(1e6f), {.statistics = {.samples = 100'000}});
  EXPECT_THAT(report.to_string(), HasSubstr("cos theta has steps of"));
}

TEST(Quantization, FloatAngleInDouble_IsReported) {
  const auto disk = [](auto angle) {
    return mc::make_distribution(
        "disk", mc::Disk<double>(),
        [angle](const mc::Vec2<double>& u) {
          const double phi = angle(u[1]), r = std::sqrt(u[0]);
          return mc::Vec2<double>(r * std::cos(phi), r * std::sin(phi));
        },
        [](const mc::Vec2<double>&) { return 1 / mc::pi<double>; });
  };
  EXPECT_THAT(mc::describe_quantization(disk([](double u) { return double(float(2 * mc::pi<double> * u)); }), 1),
              HasSubstr("phi is rounded to float; compute it in double"));
  EXPECT_EQ(mc::describe_quantization(disk([](double u) { return 2 * mc::pi<double> * u; }), 1), "");
}

TEST(Quantization, OwnScalar_IsNotReported) {
  EXPECT_EQ(mc::describe_quantization(mc::make_distribution("cosine", mc::CosineHemisphere<float>()), 1), "");
  EXPECT_EQ(mc::describe_quantization(mc::make_distribution("cosine", mc::CosineHemisphere<double>()), 1), "");
  EXPECT_EQ(mc::describe_quantization(mc::make_distribution("disk", mc::UniformDisk<float>()), 1), "");
}

// x with the given number of random bits, times `scale`.
template <class S> mc::AnyDistribution of_bits(int bits, S scale = 1) {
  return mc::make_distribution(
      "x", mc::Interval<S>(0, scale), [=](S u) { return scale * std::ldexp(std::floor(std::ldexp(u, bits)), -bits); },
      [=](S) { return 1 / scale; });
}

TEST(Quantization, CoarseSteps_AreReportedWithTheirWidth) {
  EXPECT_EQ(mc::describe_quantization(of_bits<double>(16), 1), "x has only multiples of 1.5e-05 (2^-16)");
  EXPECT_EQ(mc::describe_quantization(of_bits<float>(16), 1), "x has only multiples of 1.5e-05 (2^-16)");
  EXPECT_EQ(mc::describe_quantization(of_bits<double>(20, 1024), 1), "x has only multiples of 0.00098 (2^-10)");
  for (const int bits : {23, 24}) {
    EXPECT_THAT(mc::describe_quantization(of_bits<double>(bits), 1), HasSubstr("x is rounded to float"));
    EXPECT_EQ(mc::describe_quantization(of_bits<float>(bits), 1), "");
  }
  EXPECT_EQ(mc::describe_quantization(of_bits<double>(32), 1), "") << "no floats";
}

TEST(Quantization, CoarseAngleSteps_HaveUnit) {
  const auto sphere = [](auto z, auto turns) {
    return mc::make_distribution(
        "sphere", mc::Sphere<double>(),
        [=](const mc::Vec2<double>& u) {
          return mc::polar_direction<double>(std::sqrt(1 - z(u[0]) * z(u[0])), z(u[0]), turns(u[1]));
        },
        [](const auto&) { return 1 / (4 * mc::pi<double>); });
  };
  const auto smooth = [](double u) { return 1 - u; };
  EXPECT_EQ(mc::describe_quantization(sphere(smooth, smooth), 1), "");
  EXPECT_EQ(mc::describe_quantization(sphere([](double u) { return std::floor(1024 * u) / 1024; }, smooth), 1),
            "cos theta has only multiples of 0.00098 (2^-10)");
  EXPECT_EQ(mc::describe_quantization(sphere(smooth, [](double u) { return std::floor(1024 * u) / 1024; }), 1),
            "phi has only multiples of 0.00098 turns (2^-10)");
  // In a narrow lobe, where float steps are 2^-24.
  EXPECT_EQ(mc::describe_quantization(sphere([](double u) { return 1 - std::floor(256 * u) / 65536; }, smooth), 1),
            "cos theta has only multiples of 1.5e-05 (2^-16)");
}

const std::string excess =
    ", off by the rounding error of float: compute it in double, or declare the distribution as float";

// The cosine hemisphere over float, declared as double.
TEST(Quantization, PointOutsideByFloatRounding_IsReported) {
  const mc::CosineHemisphere<float> warp;
  const auto in_float = [=](const mc::Vec2<double>& u) {
    return mc::Vec3<double>(warp.sample(u.cast<float>()).cast<double>());
  };
  const auto s = mc::make_distribution("w", mc::Hemisphere<double>(), in_float,
                                       [](const mc::Vec3<double>& w) { return w.z() / mc::pi<double>; });
  const mc::Report report = check_laws(s, {.statistics = {.samples = 20'000}});
  EXPECT_EQ(report.verdict(), mc::Verdict::fail);
  EXPECT_THAT(report.to_string(), testing::ContainsRegex("of length 1 [+-] [0-9.]+e-0[78]" + excess.substr(0, 30)));
}

TEST(Quantization, OtherPointsOutside_AreNotReported) {
  const auto disk = mc::make_distribution("disk", mc::UniformDisk<double>());
  const double cosine = static_cast<double>(std::cos(mc::pi<float> / 2));
  EXPECT_EQ(mc::describe_float_rounding(disk, {cosine, 1}), excess);
  EXPECT_EQ(mc::describe_float_rounding(disk, {1e-8 * std::sqrt(2.0), 1}), "") << "no float";
  EXPECT_EQ(mc::describe_float_rounding(disk, {static_cast<double>(1.1f), 0}), "") << "too far off";
  EXPECT_EQ(mc::describe_float_rounding(disk, {1 + 0x1p-52, 0}), "");
  EXPECT_EQ(mc::describe_float_rounding(mc::make_distribution("disk", mc::UniformDisk<float>()), {cosine, 1}), "");
}

} // namespace
