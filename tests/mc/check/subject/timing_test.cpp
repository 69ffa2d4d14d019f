#include <mc/check/subject/timing.h>

#include <gtest/gtest.h>

namespace {

const std::vector<double> inputs(mc::timing_inputs, 0.5);

// Steps that wait for each other. Without its result the compiler may leave them out.
double work(int steps, double x) {
  for (int i = 0; i < steps; ++i) x = 0.5 * x + 0.1;
  return x;
}

TEST(NsPerSample, IncreasesWithWork) {
  const double little = mc::ns_per_sample(inputs, [](double x) { return work(2, x); }),
               much = mc::ns_per_sample(inputs, [](double x) { return work(200, x); });
  EXPECT_GT(little, 0);
  EXPECT_GE(much, 10 * little) << "a hundred times the work";
}

TEST(NsPerSample, IncludesEveryPartOfASample) {
  struct Sample {
    double first, second;
  };
  const double unused = mc::ns_per_sample(inputs, [](double x) { return Sample{x, work(200, x)}; });
  const double used = mc::ns_per_sample(inputs, [](double x) {
    volatile double second = work(200, x);
    return Sample{x, second};
  });
  EXPECT_GE(unused, used / 2);
}

} // namespace
