// The rows of the table of rates, where they are known by heart.

#include <sampling/theory.h>
#include <sampling/ways.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using carlo::Smoothness, carlo::theory;
using Class = Smoothness::Class;

double exponent(const char* way, Class of, int dim, double a = 0) { return theory(way, {of, a}, dim)->exponent; }

TEST(Theory, OfEachClass) {
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
  EXPECT_TRUE(theory("halton", {Class::smooth}, 3)->at_most);
}

TEST(Theory, LogarithmsBendTheCurve) {
  const auto rate = theory("sobol", {Class::smooth}, 3);
  EXPECT_EQ(rate->log_power, 1);
  EXPECT_DOUBLE_EQ(rate->local(std::exp(10)), 1.4);
}

TEST(Theory, IsSilentWhereNothingIsStated) {
  EXPECT_FALSE(theory("vegas", {Class::smooth}, 2));
  EXPECT_FALSE(theory("sobol", {}, 2));
  EXPECT_FALSE(theory("lattice", {Class::periodic}, 2));
  for (const carlo::Way& w : carlo::ways()) // a rate is positive and no faster than any that is known
    for (const Class c : {Class::smooth, Class::additive, Class::periodic, Class::axis_kink, Class::kink,
                          Class::axis_jump, Class::jump, Class::corner})
      for (const int d : {1, 2, 3, 5, 8})
        if (const auto rate = theory(w.name, {c, 0.15}, d)) {
          EXPECT_GE(rate->exponent, 0.5) << w.name << d;
          EXPECT_LE(rate->exponent, 2.5) << w.name << d;
          EXPECT_FALSE(rate->source.empty());
        }
}

} // namespace
