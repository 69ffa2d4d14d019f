// Errors measured against a truth, and without one.

#include <converge/measure.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using carlo::Experiment, carlo::Measurement;

Experiment ramp(double truth) {
  Experiment e;
  e.name = e.title = "ramp";
  e.dim = 1;
  e.truth = truth;
  e.smoothness = {carlo::Smoothness::Class::smooth};
  e.fit_from = 16;
  e.f = [](Experiment::Unit u) { return u[0]; };
  return e;
}

std::vector<carlo::Way> ways(std::initializer_list<const char*> names) {
  std::vector<carlo::Way> all;
  for (const char* name : names) all.push_back(carlo::way(name));
  return all;
}

// Var = 1 / (12 N) and 1 / (12 N^3). The 95 % intervals of 7 N and 2 ways: fewer than 10 hits of 14 has probability
// 4e-4.
TEST(Measure, ErrorsAreTheVariancesOfTheBooks) {
  const auto list = ways({"random", "stratified"});
  for (const double truth : {0.5, std::numeric_limits<double>::quiet_NaN()}) {
    const Measurement m = measure(here(ramp(truth)), list, {.max_n = 1024, .seed = 3});
    ASSERT_EQ(m.curves.size(), 2u);
    int hits = 0;
    for (const carlo::Curve& c : m.curves)
      for (const mc::RmsError& e : c.errors) {
        const double exact = std::sqrt(1 / (12 * std::pow(e.n, c.way->name == "random" ? 1 : 3)));
        hits += e.lo <= exact && exact <= e.hi;
      }
    EXPECT_GE(hits, 10);
    EXPECT_TRUE(m.curves[0].agrees() && m.curves[1].agrees());
    EXPECT_EQ(m.truth_error > 0, std::isnan(truth));
    EXPECT_NEAR(m.truth, 0.5, 6 * m.truth_error);
    EXPECT_TRUE(m.doubt.empty());
  }
}

// The reference is ten times surer than the smallest error.
TEST(Measure, TheReferenceIsSurerThanWhatIsShown) {
  const auto list = ways({"random", "sobol"});
  const Measurement m = measure(here(ramp(std::numeric_limits<double>::quiet_NaN())), list, {.max_n = 256, .seed = 4});
  EXPECT_LE(m.truth_error, 0.12 * m.curves[1].errors.back().rms);
  EXPECT_LT(m.curves[1].errors.back().lo, m.curves[1].errors.back().rms);
}

TEST(Measure, AWrongTruthIsDoubtedAndARightOneIsNot) {
  const auto list = ways({"random", "stratified", "sobol"});
  EXPECT_FALSE(measure(here(ramp(0.5001)), list, {.max_n = 1024}).doubt.empty());
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_EQ(measure(here(ramp(0.5)), list, {.max_n = 256, .replicates = 16, .seed = seed}).doubt, "");
}

TEST(Measure, ConstantsAreExact) {
  Experiment e = ramp(2);
  e.f = [](Experiment::Unit) { return 2; };
  const auto list = ways({"random"});
  const Measurement m = measure(here(e), list, {.max_n = 64});
  EXPECT_TRUE(m.curves[0].exact);
  EXPECT_FALSE(m.curves[0].law);
}

// A reference of replicates is doubted where one of them holds over half of their variance again and again: of 1/x, not
// of 1/sqrt(x), whose variance is infinite too but only just, nor of what is smooth.
TEST(Measure, TheReferenceOfADivergentIntegralIsDoubted) {
  const auto list = ways({"random", "stratified", "sobol"});
  const auto doubt = [&](double power) {
    Experiment e = ramp(std::numeric_limits<double>::quiet_NaN());
    e.f = [power](Experiment::Unit u) { return std::pow(u[0], power); };
    return measure(here(e), list, {.max_n = 4096, .seed = 5}).doubt;
  };
  EXPECT_NE(doubt(-1).find("one holds over half of the variance"), std::string::npos) << doubt(-1);
  EXPECT_NE(doubt(-0.9), "");
  EXPECT_EQ(doubt(-0.5), "");
  EXPECT_EQ(doubt(2), "");
}

} // namespace
