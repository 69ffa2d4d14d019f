#include <mc/random/pcg.h>

#include <gtest/gtest.h>

#include <vector>

namespace {

TEST(Pcg, EngineMatchesItsReferenceOutput) {
  // Output of pcg32-demo of pcg-cpp for seed 42 and stream 54.
  pcg32 engine(42u, 54u);
  for (const std::uint32_t expected : {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
    EXPECT_EQ(engine(), expected);
}

TEST(Pcg, SameSeedSameBits) {
  mc::Pcg a(5, 6), b(5, 6), other_seed(6, 6), other_stream(5, 7);
  int same_seed = 0, same_stream = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t x = a.next32();
    EXPECT_EQ(x, b.next32());
    same_seed += x == other_seed.next32();
    same_stream += x == other_stream.next32();
  }
  EXPECT_LE(same_seed, 1);
  EXPECT_LE(same_stream, 1);
}

TEST(Pcg, StreamsThatDifferInUpperBitsAloneAreIndependent) {
  // Increments 2^62 apart would give equal numbers in every other draw.
  for (const int bit : {32, 40, 48, 56, 62, 63}) {
    mc::Pcg a(1, 5), b(1, 5 + (std::uint64_t{1} << bit));
    constexpr int n = 1 << 16;
    double sum = 0;
    int same = 0;
    for (int i = 0; i < n; ++i) {
      const std::uint32_t x = a.next32(), y = b.next32();
      same += x == y;
      sum += (double(x) * 0x1p-32 - 0.5) * (double(y) * 0x1p-32 - 0.5);
    }
    EXPECT_LE(same, 2) << "2^" << bit;
    EXPECT_LE(std::abs(sum / n), 5 * (1.0 / 12) / std::sqrt(double(n))) << "2^" << bit;
  }
}

TEST(Pcg, AdvanceIsRepeatedDrawing) {
  mc::Pcg a(9), b(9);
  for (int i = 0; i < 12345; ++i) a.next32();
  b.advance(12345);
  EXPECT_EQ(a.next64(), b.next64());
}

TEST(Pcg, UniformMoments) {
  // Mean and second moment of 1e6 numbers within 5 sd: alpha is 1e-6 for each.
  mc::Pcg r(1);
  double sum = 0, squares = 0;
  constexpr int n = 1'000'000;
  for (int i = 0; i < n; ++i) {
    const double u = i % 2 ? double(r.uniform<float>()) : r.uniform<double>();
    EXPECT_LT(u, 1);
    sum += u;
    squares += u * u;
  }
  EXPECT_LE(std::abs(sum / n - 0.5), 5 * std::sqrt(1.0 / 12 / n));
  EXPECT_LE(std::abs(squares / n - 1.0 / 3), 5 * std::sqrt(4.0 / 45 / n));
}

template <class S> void expect_fill_is_uniform() {
  mc::Pcg one_by_one(3, 4), filled(3, 4);
  for (const std::size_t n : {0, 1, 63, 64, 65, 96, 1000}) {
    std::vector<S> out(n);
    filled.fill<S>(out);
    for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(out[i], one_by_one.uniform<S>()) << i << " of " << n;
  }
  EXPECT_EQ(filled.next64(), one_by_one.next64());
}

TEST(Pcg, FillHasTheBitsOfUniform) {
  expect_fill_is_uniform<float>();
  expect_fill_is_uniform<double>();
}

} // namespace
