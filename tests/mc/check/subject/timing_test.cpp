#include <mc/check/subject/timing.h>

#include <gtest/gtest.h>

#include <array>

namespace {

const std::vector<double> inputs(mc::timing_inputs, 0.5);

// So many square roots, each of which waits for the one before.
double work(int rounds, double x) {
  for (int i = 0; i < rounds; ++i) x = std::sqrt(x + 0.1);
  return x;
}

TEST(NsPerSample, IncreasesWithWork) {
  const double little = mc::ns_per_sample(inputs, [](double x) { return work(2, x); }),
               much = mc::ns_per_sample(inputs, [](double x) { return work(200, x); });
  EXPECT_GT(little, 0);
  EXPECT_GE(much, 10 * little) << "a hundred times the work";
}

TEST(NsPerSample, IncludesEveryPartOfASample) {
  const double fast = mc::ns_per_sample(inputs,
                                        [](double x) {
                                          return std::array{x, x};
                                        }),
               slow = mc::ns_per_sample(inputs, [](double x) {
                 return std::array{x, work(200, x)};
               });
  EXPECT_GE(slow, 10 * fast);
}

} // namespace
