#include <mc/check/subject/timing.h>

#include <gtest/gtest.h>

namespace {

TEST(NsPerSample, IncreasesWithWork) {
  const std::vector<double> inputs(mc::timing_inputs, 0.5);
  const auto work = [](int rounds) {
    return [rounds](double x) {
      for (int i = 0; i < rounds; ++i) x = std::sqrt(x + 0.1);
      return x;
    };
  };
  const double little = mc::ns_per_sample(inputs, work(2)), much = mc::ns_per_sample(inputs, work(200));
  EXPECT_GT(little, 0);
  EXPECT_GE(much, 10 * little) << "a hundred times the work";
}

} // namespace
