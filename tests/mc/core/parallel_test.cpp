#include <mc/core/parallel.h>

#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/random/uniform.h>

#include <gtest/gtest.h>

#include <atomic>

namespace {

TEST(Parallel, VisitsEveryIndexOnce) {
  for (const int threads : {0, 1, 2, 7}) {
    std::vector<std::atomic<int>> visits(1000);
    mc::parallel_for(visits.size(), threads, [&](std::size_t i) { ++visits[i]; });
    for (const auto& v : visits) EXPECT_EQ(v, 1);
  }
  mc::parallel_for(0, 2, [](std::size_t) { FAIL() << "an empty loop has no body"; });
}

TEST(Parallel, PartsCoverTheRangeInOrder) {
  for (const std::size_t n : {0, 1, 7, 8, 9, 1000})
    for (const int threads : {1, 2}) {
      std::vector<std::atomic<int>> visits(n);
      mc::parallel_parts(n, 8, threads, [&](std::size_t begin, std::size_t end) {
        EXPECT_EQ(begin % 8, 0u);
        EXPECT_EQ(end, std::min(begin + 8, n));
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const auto& v : visits) EXPECT_EQ(v, 1);
    }
}

TEST(Parallel, ReductionHasTheSameBitsForAnyThreadCount) {
  const auto run = [](int threads) {
    return mc::parallel_reduce<mc::Moments>(64, threads, [](std::size_t chunk) {
      mc::Moments m;
      for (std::uint64_t i = 0; i < 1000; ++i) m.add(mc::hash_uniform<double>(1, chunk, i));
      return m;
    });
  };
  const mc::Moments one = run(1);
  for (const int threads : {2, 3, 8}) {
    const mc::Moments many = run(threads);
    EXPECT_EQ(one.mean(), many.mean());
    EXPECT_EQ(one.variance(), many.variance());
  }
}

// A waiting thread that ran outer tasks could lock a mutex of the loop body twice, and its stack would grow with the
// loop.
TEST(Parallel, NestedLoop_WhileWaiting_RunsNoOuterTask) {
  thread_local int depth = 0;
  std::atomic<int> deepest = 0;
  mc::parallel_for(200, 0, [&](std::size_t) {
    if (++depth > deepest) deepest = depth;
    mc::parallel_for(8, 0, [](std::size_t) {
      volatile double x = 0;
      for (int k = 0; k < 2000; ++k) x = x + k;
    });
    --depth;
  });
  EXPECT_EQ(deepest, 1);
}

TEST(Parallel, RejectsNegativeThreadCount) {
  EXPECT_THROW(mc::parallel_for(1, -1, [](std::size_t) {}), mc::Error);
}

TEST(Parallel, FirstExceptionStopsTheLoopAndIsRethrown) {
  for (const int threads : {1, 2, 4}) {
    std::atomic<int> started = 0;
    EXPECT_THROW(mc::parallel_for(1'000'000, threads,
                                  [&](std::size_t i) {
                                    ++started;
                                    mc::require(i != 10, "chunk {} is broken", i);
                                  }),
                 mc::Error);
    EXPECT_LE(started, 999'999);
  }
}

} // namespace
