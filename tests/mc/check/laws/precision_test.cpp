#include <mc/check/laws.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/mixture.h>
#include <mc/warp/uniform.h>

#include <gtest/gtest.h>

#include <array>

namespace {

std::string of_sample(const mc::Report& report) {
  for (const mc::Check& c : report.checks)
    if (c.name.starts_with("sample against 50 digits")) return c.verdict == mc::Verdict::pass ? "pass" : c.detail;
  return "no check";
}

// Near the rim, one step of u changes z by a hundred steps. A mixture rounds u once more, which is no fault.
TEST(PrecisionLaw, ErrorWithinRoundingOfU_Passes) {
  const mc::Mixture mixture(std::array<double, 2>{1e-4, 1 - 1e-4}, mc::UniformHemisphere<double>{},
                            mc::CosineHemisphere<double>{});
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    EXPECT_EQ(of_sample(check_laws(mixture, {.statistics = {.samples = 0, .seed = seed}})), "pass") << seed;
}

// Off by 64 steps, although the sample changes as fast as u.
struct Shifted : mc::UniformInterval<double> {
  using mc::UniformInterval<double>::UniformInterval;
  double sample(double u) const { return u + 64 * 0x1p-52; }
  template <mc::Real T> mc::UniformInterval<T> cast() const { return {T(0), T(1)}; }
};

TEST(PrecisionLaw, ErrorBeyondRoundingOfU_Fails) {
  EXPECT_NE(of_sample(check_laws(Shifted(0, 1), {.statistics = {.samples = 0}})), "pass");
}

} // namespace
