// Rows of the table of rates with textbook values, and combinations that must have a row.

#include <integrands/find.h>
#include <sampling/sampling_methods.h>
#include <sampling/theory.h>

#include <mc/core/file.h>
#include <mc/core/types.h>

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>

namespace {

using carlo::RateBound, carlo::ConvergenceRate, carlo::Smoothness, carlo::theoretical_rate;
using Class = Smoothness::Class;

constexpr Class classes[] = {Class::smooth, Class::additive,  Class::periodic, Class::axis_kink,
                             Class::kink,   Class::axis_jump, Class::jump,     Class::corner};
constexpr int dimensions[] = {1, 2, 3, 5, 8};

double exponent(const char* method, Class of, int dim, double a = 0) {
  return theoretical_rate(method, {of, a}, dim)->exponent;
}

TEST(Theory, RatesOfEachClass) {
  EXPECT_EQ(exponent("random", Class::jump, 5), 0.5);
  EXPECT_EQ(exponent("stratified", Class::smooth, 2), 1);
  EXPECT_EQ(exponent("stratified", Class::jump, 2), 0.75);
  EXPECT_EQ(exponent("stratified", Class::axis_jump, 1), 1);
  EXPECT_EQ(exponent("sobol", Class::smooth, 8), 1.5);
  EXPECT_EQ(exponent("sobol", Class::kink, 2), 1.25);
  EXPECT_EQ(exponent("sobol", Class::jump, 3), 0.5 + 1.0 / 6);
  EXPECT_EQ(exponent("sobol", Class::corner, 3, 0.15), 0.85);
  EXPECT_EQ(exponent("latin_hypercube", Class::additive, 5), 1.5);
  EXPECT_EQ(exponent("latin_hypercube", Class::smooth, 5), 0.5);
  EXPECT_EQ(exponent("multi_jittered", Class::smooth, 2), 0.75);
  EXPECT_EQ(exponent("rqmc", Class::smooth, 2), 2.5);
  EXPECT_EQ(exponent("multi_jittered", Class::kink, 2), 0.75);
  EXPECT_EQ(exponent("multi_jittered", Class::corner, 2, 0.15), 0.675);
  EXPECT_EQ(exponent("stratified_rounds", Class::jump, 8), 0.5 + 1.0 / 16);
  EXPECT_EQ(theoretical_rate("halton", {Class::smooth}, 3)->bound, RateBound::at_most);
  EXPECT_EQ(theoretical_rate("sobol", {Class::corner, 0.15}, 3)->bound, RateBound::at_most);
  EXPECT_EQ(theoretical_rate("sobol", {Class::corner, 0.15}, 1)->bound, RateBound::exact);
}

// In one dimension, a power of two of Halton points is a net.
TEST(Theory, HaltonIn1DHasTheRateOfSobol) {
  for (const Class c : classes) EXPECT_EQ(exponent("halton", c, 1, 0.15), exponent("sobol", c, 1, 0.15));
}

// The error of a shifted lattice of N points consists of every N-th frequency of each coordinate. The squared cosine
// over the sphere is 4 pi (1 - 2 u)^2. Its series is 4 pi / 3 plus 16 / (pi k^2) cos(2 pi k u) for every k. The terms k
// = N, 2 N, ... remain.
TEST(Theory, LatticeRatesForMatchingFaces) {
  const auto rate = theoretical_rate("lattice", {Class::additive, 0, true}, 2);
  EXPECT_EQ(rate->exponent, 2);
  EXPECT_EQ(rate->bound, RateBound::exact);
  EXPECT_EQ(exponent("lattice", Class::additive, 2), 1);
  EXPECT_EQ(theoretical_rate("sobol", {Class::additive, 0, true}, 2)->exponent, 1.5);
  const carlo::UnitCubeIntegral sphere = carlo::find_integrand("cos2_sphere", {});
  for (const std::uint64_t n : {16, 256}) {
    double squares = 0;
    constexpr int shifts = 4000;
    for (std::uint64_t seed = 0; seed < shifts; ++seed)
      squares += mc::sqr(carlo::sampling_method("lattice").estimate(sphere, n, seed).value - sphere.truth) / shifts;
    double sum = 0; // squares of the coefficients of m N, each halved by the mean over shifts
    for (double m = 1; m < 1000; ++m) sum += mc::sqr(16 / mc::pi<double> / mc::sqr(m * static_cast<double>(n))) / 2;
    EXPECT_NEAR(std::sqrt(squares / sum), 1, 0.05) << n;
  }
}

TEST(Theory, AdaptiveMethodsHaveOnlyABound) {
  for (const char* method : {"vegas", "tree", "auto"})
    for (const Class c : classes)
      for (const int d : dimensions) {
        const auto rate = theoretical_rate(method, {c, 0.15}, d);
        ASSERT_TRUE(rate) << method << d;
        EXPECT_EQ(rate->exponent, 0.5);
        EXPECT_EQ(rate->bound, RateBound::at_least);
      }
}

TEST(Theory, LogarithmsChangeTheLocalExponent) {
  const auto rate = theoretical_rate("sobol", {Class::smooth}, 3);
  EXPECT_EQ(rate->log_power, 1);
  EXPECT_DOUBLE_EQ(rate->local_exponent(std::exp(10)), 1.4);
}

TEST(Theory, BoundsAreOneSided) {
  struct Case {
    RateBound bound;
    const char* text;
    bool faster, slower;
  };
  for (const Case& c :
       {Case{RateBound::exact, "-1.00", false, false}, Case{RateBound::at_most, "no steeper than -1.00", false, true},
        Case{RateBound::at_least, "at least as steep as -1.00", true, false}}) {
    const ConvergenceRate rate{1, 0, "a source", c.bound};
    EXPECT_EQ(rate.to_string(2), c.text);
    EXPECT_TRUE(rate.is_consistent_with(-1.1, -0.9, 1000));
    EXPECT_EQ(rate.is_consistent_with(-1.3, -1.2, 1000), c.faster);
    EXPECT_EQ(rate.is_consistent_with(-0.8, -0.7, 1000), c.slower);
  }
  EXPECT_TRUE((ConvergenceRate{1.5, 1, "a source"}.is_consistent_with(-1.41, -1.39, std::exp(10))));
}

TEST(Theory, UnknownMethodOrClass_HasNoRate) {
  EXPECT_FALSE(theoretical_rate("sobol", {}, 2));
  EXPECT_FALSE(theoretical_rate("points.csv", {Class::smooth}, 2));
  EXPECT_FALSE(theoretical_rate("random", {Class::corner, 0.5}, 2)); // the variance is infinite
}

// A rate is positive and not faster than the fastest in the table.
TEST(Theory, EveryMethodAndClassHasARate) {
  for (const carlo::SamplingMethod& w : carlo::sampling_methods())
    for (const Class c : classes)
      for (const int d : dimensions) {
        const auto rate = theoretical_rate(w.name, {c, 0.15}, d);
        ASSERT_TRUE(rate) << w.name << ' ' << name(c) << ' ' << d;
        EXPECT_GE(rate->exponent, 0.5) << w.name << d;
        EXPECT_LE(rate->exponent, 2.5) << w.name << d;
        EXPECT_FALSE(rate->source.empty()) << w.name << d;
      }
}

TEST(Theory, SourcesAreInTheReferences) {
  const std::string references = mc::read_file(MC_SOURCE_DIR "/libmc/mc/REFERENCES.md");
  const std::regex key("\\[[A-Za-z]+[0-9]+\\]");
  int keys = 0;
  for (const carlo::SamplingMethod& w : carlo::sampling_methods())
    for (const Class c : classes)
      for (const int d : dimensions) {
        const std::string source(theoretical_rate(w.name, {c, 0.15}, d)->source);
        for (std::sregex_iterator i(source.begin(), source.end(), key), end; i != end; ++i, ++keys)
          EXPECT_NE(references.find("| " + i->str() + " |"), std::string::npos) << i->str();
      }
  EXPECT_GT(keys, 100);
}

} // namespace
