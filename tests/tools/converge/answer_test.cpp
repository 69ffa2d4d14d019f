#include <converge/answer.h>

#include <gtest/gtest.h>

namespace {

using namespace carlo;

struct Answer : testing::Test {
  SamplingMethod lattice, sobol;
  ConvergenceCurve first, second;
  Measurement m;
  TradeResults trade_results;

  Answer() {
    lattice.name = "lattice";
    sobol.name = "sobol";
    first.method = &lattice;
    second.method = &sobol;
  }
  static std::vector<TradeCandidate> won_by(const ConvergenceCurve& c) {
    return {{&c, 64, {1, 1, 1}, {0.1, 0.1, 0.1}}};
  }
};

TEST_F(Answer, WantedErrorsWithOneWinnerShareASentence) {
  trade_results.by_error = {{0.2, won_by(first), {}, IntervalEstimate{9.96, 9, 11}},
                            {0.1, won_by(first), {}, IntervalEstimate{62.5, 60, 70}},
                            {0.05, won_by(second), {}, {}},
                            {0.01, {}, {}, {}}};
  EXPECT_EQ(answer_text(m, trade_results),
            "The cheapest method for an RMS error of 0.2 and 0.1 is lattice; plain Monte Carlo costs 10 to 62 times as "
            "much. The cheapest method for an RMS error of 0.05 is sobol. No method reached an RMS error of 0.01.");
}

TEST_F(Answer, WantedCostsNameTheMostAccurateMethod) {
  trade_results.by_time = {{0.5, won_by(second), IntervalEstimate{3.21, 3, 4}}, {1e-9, {}, {}}};
  EXPECT_EQ(answer_text(m, trade_results),
            "The most accurate method for 0.5 s of CPU is sobol; the error of plain Monte Carlo is 3.2 times as large. "
            "1e-09 s of CPU is too little for any method.");
}

TEST_F(Answer, GainsThatAreNotKnownAreLeftOut) {
  trade_results.by_error = {{0.2, won_by(first), {}, IntervalEstimate{1, 1, 1}},
                            {0.1, won_by(first), {}, IntervalEstimate{5, 0, 9}}};
  EXPECT_EQ(answer_text(m, trade_results), "The cheapest method for an RMS error of 0.2 and 0.1 is lattice.");
}

} // namespace
