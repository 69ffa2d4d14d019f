// Output of carlo integrate beyond the estimate.

#include <tools/run_carlo.h>

#include <mc/core/file.h>

#include <support/files.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace {

using testing::HasSubstr;
const std::string peak = "integrate '1/((1e-2+(x-.4)^2)*(1e-2+(y-.7)^2))' -d x=0:1,y=0:1 ";

struct IntegrateOutput : support::ScratchTest {
  nlohmann::json run(const std::string& arguments) const {
    const support::ProcessResult r = support::run_carlo(arguments + " --json " + path("r.json"));
    EXPECT_EQ(r.exit_code, 0) << r.output;
    return nlohmann::json::parse(mc::read_file(path("r.json")));
  }
};

TEST_F(IntegrateOutput, SeveralIntegrandsShareTheirCalls) {
  const nlohmann::json j = run("integrate 'x*y' 'x*y + 1e-3*x' -d x=0:1,y=0:2 --rel-error 1e-3 --method plain");
  ASSERT_EQ(j["outputs"].size(), 2u);
  EXPECT_GT(j["correlation"][0][1], 0.99);
  for (std::size_t i = 0; i < 2; ++i) {
    const double error = j["outputs"][i]["std_error"];
    EXPECT_NEAR(j["covariance"][i][i].get<double>(), error * error, 1e-12 * error * error);
    EXPECT_EQ(j["correlation"][i][i], 1);
  }
  const support::ProcessResult r = support::run_carlo("integrate genz_c0_2d genz_gaussian_2d --rel-error 1e-2");
  EXPECT_THAT(r.output, testing::AllOf(HasSubstr("Genz: c0 in 2"), HasSubstr("Genz: gaussian in 2"),
                                       HasSubstr("correlations of the errors\n  1.000")));
  EXPECT_THAT(support::run_carlo("integrate genz_c0_2d genz_c0_5d").output, HasSubstr("must be the same"));
}

// One integral has the keys of several, and its own at the top as well.
TEST_F(IntegrateOutput, JsonHasOneShape) {
  const nlohmann::json one = run("integrate 'x*y' -d x=0:1,y=0:2 --name area"),
                       two = run("integrate 'x*y' x -d x=0:1,y=0:2 --name area --name side");
  for (const nlohmann::json& j : {one, two}) {
    ASSERT_EQ(j["outputs"].size(), j["correlation"].size());
    EXPECT_EQ(j["outputs"][0]["integrand"], "x*y");
    EXPECT_EQ(j["outputs"][0]["name"], "area");
    EXPECT_NEAR(j["outputs"][0]["value"], 1, 1e-2);
  }
  for (const auto& [key, value] : one["outputs"][0].items()) EXPECT_EQ(one[key], value) << key;
  EXPECT_EQ(two["outputs"][1]["name"], "side");
}

TEST_F(IntegrateOutput, NamesStandForExpressions) {
  EXPECT_THAT(support::run_carlo("integrate 'x*y' -d x=0:1,y=0:2 --name area").output, testing::StartsWith("area = "));
  EXPECT_THAT(support::run_carlo("integrate x -d x=0:1 --name a --name b").output,
              HasSubstr("--name is given 2 times for 1 integrands"));
  EXPECT_THAT(support::run_carlo("integrate x -d x=0:1 --name 3").output, HasSubstr("is no name of a variable"));
  EXPECT_THAT(support::run_carlo("integrate x x -d x=0:1 --name a --name a").output, HasSubstr("'a' is given twice"));
}

TEST_F(IntegrateOutput, ReplacedValuesAreCounted) {
  const std::string arguments = "integrate 'sqrt(x)' -d x=-1:1 --nan 0";
  const nlohmann::json j = run(arguments);
  EXPECT_NEAR(j["value"], 2.0 / 3, 5 * j["std_error"].get<double>());
  EXPECT_NEAR(j["replaced"].get<double>() / j["calls"].get<double>(), 0.5, 0.05);
  EXPECT_THAT(support::run_carlo(arguments).output,
              testing::ContainsRegex("\n[0-9]+ values were not a number and count as 0 \\(--nan\\)"));
}

// The error of each part is relative to the modulus: the imaginary part of the second integral is 0.
TEST_F(IntegrateOutput, ComplexIntegralsHaveTwoParts) {
  const nlohmann::json j =
      run("integrate 'exp(i*x)' 'exp(i*x-x*x/2)/sqrt(2*_pi)' -d x=-8:9 --name f --name g --derive 'hypot(g_re, g_im)'");
  ASSERT_EQ(j["outputs"].size(), 4u);
  const double truths[] = {std::sin(9) + std::sin(8), std::cos(8) - std::cos(9), std::exp(-0.5), 0};
  for (std::size_t k = 0; k < 4; ++k) {
    const double error = j["outputs"][k]["std_error"], modulus = k < 2 ? std::hypot(truths[0], truths[1]) : truths[2];
    EXPECT_NEAR(j["outputs"][k]["value"], truths[k], 5.5 * error) << k;
    EXPECT_LE(error, 1.02e-3 * modulus) << k;
  }
  EXPECT_EQ(j["outputs"][3]["name"], "g_im");
  EXPECT_EQ(j["outputs"][3]["integrand"], "im(exp(i*x-x*x/2)/sqrt(2*_pi))");
  EXPECT_NEAR(j["derived"][0]["value"], truths[2], 1e-2);
}

TEST_F(IntegrateOutput, FiniteSumIsExact) {
  const nlohmann::json j = run("integrate 1/k^2 -d k=1..6 --histogram k=0.5:3.5:3");
  EXPECT_DOUBLE_EQ(j["value"], 1 + 1.0 / 4 + 1.0 / 9 + 1.0 / 16 + 1.0 / 25 + 1.0 / 36);
  EXPECT_EQ(j["std_error"], 0);
  EXPECT_EQ(j["histogram"][1]["value"], 0.25);
}

TEST_F(IntegrateOutput, RoundsSumToTheRun) {
  const nlohmann::json j = run(peak + "--rel-error 1e-5 --method vegas");
  double chi2 = 0;
  std::uint64_t learning = 0;
  for (const nlohmann::json& round : j["rounds"]) {
    learning += round["learning"].get<bool>();
    if (!round["chi2"].is_null()) chi2 += round["chi2"].get<double>();
  }
  EXPECT_GE(learning, 2u);
  EXPECT_NEAR(chi2, j["chi2"].get<double>(), 1e-9 * chi2);
  EXPECT_EQ(j["rounds"].back()["calls"], j["calls"]);
  EXPECT_THAT(support::run_carlo(peak + "--rounds --method vegas").output,
              testing::AllOf(HasSubstr("vegas, learning"), HasSubstr("sum of chi2: ")));
}

TEST_F(IntegrateOutput, DensityIsSavedAndReused) {
  const std::string file = path("density");
  const nlohmann::json first = run(peak + "--rel-error 1e-5 --method vegas --save-density " + file),
                       second = run(peak + "--rel-error 1e-5 --method vegas --seed 2 --load-density " + file);
  int learning = 0;
  for (const nlohmann::json& round : second["rounds"]) learning += round["learning"].get<bool>();
  EXPECT_LE(learning, 1) << "the density is already good";
  EXPECT_LE(second["calls"], first["calls"]);
  const double difference = first["value"].get<double>() - second["value"].get<double>();
  // Two errors of 23 degrees of freedom: the bound fails for 5e-5 of the choices of seeds.
  EXPECT_LE(std::abs(difference), 5 * std::hypot(first["std_error"].get<double>(), second["std_error"].get<double>()));
  mc::write_file(path("cut"), mc::read_file(file).substr(0, 1000));
  const support::ProcessResult cut = support::run_carlo(peak + "--load-density " + path("cut"));
  EXPECT_EQ(cut.exit_code, 2);
  EXPECT_THAT(cut.output, HasSubstr("cut: density: the checksum at the end is missing"));
  EXPECT_THAT(support::run_carlo("integrate x -d x=0:1 --load-density " + file).output, HasSubstr("has 2 dimensions"));
  const support::ProcessResult none =
      support::run_carlo("integrate x -d x=0:1 --method rqmc --save-density " + path("none"));
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.output, testing::AllOf(HasSubstr("95 % in [0.49999"), HasSubstr("nothing was learned by rqmc")));
}

TEST_F(IntegrateOutput, HistogramSumsToTheIntegral) {
  for (const char* axis : {"x=10", "y=7", "value=6"}) {
    const nlohmann::json j = run(peak + "--histogram " + axis);
    double sum = 0;
    for (const nlohmann::json& bin : j["histogram"]) sum += bin["value"].get<double>();
    EXPECT_NEAR(sum, j["value"].get<double>(), 1e-9 * sum) << axis;
  }
  // e^x over x < 1: the integral over every bin has a closed form, also over the first bin, which is infinite below.
  const nlohmann::json j = run("integrate 'exp(x)' -d x=-inf:1 --histogram x=4");
  EXPECT_TRUE(j["histogram"][0]["lo"].is_null());
  for (const nlohmann::json& bin : j["histogram"]) {
    const double below = bin["lo"].is_null() ? 0 : std::exp(bin["lo"].get<double>());
    EXPECT_NEAR(bin["value"].get<double>(), std::exp(bin["hi"].get<double>()) - below,
                5 * bin["std_error"].get<double>());
  }
  EXPECT_THAT(
      support::run_carlo("integrate 'sin(x)' -d x=-1:1 --method rqmc --max-calls 1e5 --histogram x=4").output,
      testing::AllOf(HasSubstr("x in [0.5, 1)"),
                     testing::Not(testing::ContainsRegex("[0-9] % [-#]")))); // the total is 0, so no shares are printed
  EXPECT_THAT(support::run_carlo(peak + "--histogram z=10").output, HasSubstr("unknown name 'z'; use one of x, y"));
  EXPECT_THAT(support::run_carlo(peak + "--histogram x").output, HasSubstr("must be AXIS=BINS"));
  EXPECT_THAT(support::run_carlo("integrate 'exp(x)' -d x=-inf:1 --histogram value=9").output,
              HasSubstr("infinite along x"));
}

TEST_F(IntegrateOutput, PrintsQuantilesOfTheExpression) {
  const nlohmann::json j = run("integrate 'x*x' -d x=1:3 --quantiles 0.25,0.5");
  ASSERT_EQ(j["quantiles"].size(), 2u);
  for (const nlohmann::json& q : j["quantiles"]) {
    const double x = 1 + 2 * q["probability"].get<double>();
    EXPECT_NEAR(q["value"].get<double>(), x * x, 1e-3);
    EXPECT_LE(q["lo"], q["value"]);
    EXPECT_GE(q["hi"], q["value"]);
  }
  EXPECT_THAT(support::run_carlo(peak + "--quantiles 0.5,1").output, HasSubstr("must lie between 0 and 1"));
  EXPECT_THAT(support::run_carlo(peak + "--quantiles x").output, HasSubstr("'x' is not a number"));
}

} // namespace
