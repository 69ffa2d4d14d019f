#include <integrate/sweep.h>

#include <mc/core/file.h>
#include <support/files.h>
#include <tools/run_carlo.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>

namespace {

using support::error_of;
using testing::HasSubstr;

TEST(SweepPoints, AreAllCombinations) {
  const std::vector<carlo::SweepPoint> one = carlo::sweep_points({"a=2", "b=sqrt(2)"});
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].settings, (std::vector<std::string>{"a=2", "b=sqrt(2)"}));
  EXPECT_TRUE(one[0].swept.empty());
  const std::vector<carlo::SweepPoint> grid = carlo::sweep_points({"a=1:3:0.5", "c=7", "b=1:-1:-2"});
  ASSERT_EQ(grid.size(), 10u);
  EXPECT_EQ(grid[3].settings, (std::vector<std::string>{"a=1.5", "c=7", "b=-1"}));
  EXPECT_EQ(grid[3].swept, (carlo::SweptValues{{"a", 1.5}, {"b", -1}}));
  EXPECT_EQ(carlo::sweep_points({"a=0:1:0.1"}).size(), 11u) << "the end belongs to the range";
  EXPECT_EQ(carlo::sweep_points({"a=0:2*_pi:_pi/4"}).size(), 9u);
  EXPECT_EQ(carlo::sweep_points({"a=1:1:1"}).size(), 1u);
}

TEST(SweepPoints, BadInput_IsRefused) {
  const auto refused = [](const std::string& text) { return error_of([&] { carlo::sweep_points({text}); }); };
  EXPECT_THAT(refused("a=1:2"), HasSubstr("must be NAME=VALUE or NAME=LO:HI:STEP"));
  EXPECT_THAT(refused("a"), HasSubstr("not of the form name=value"));
  EXPECT_THAT(refused("a=1:2:0"), HasSubstr("the step 0 does not lead from 1 to 2"));
  EXPECT_THAT(refused("a=1:2:-1"), HasSubstr("does not lead from 1 to 2"));
  EXPECT_THAT(refused("a=1:2:1e-9"), HasSubstr("at most 500"));
  EXPECT_THAT(refused("a=1:inf:1"), HasSubstr("must be finite"));
  EXPECT_THAT(refused("a=1:b:1"), HasSubstr("--set 'a=1:b:1': expression 'b'"));
}

struct Sweep : support::ScratchTest {};

TEST_F(Sweep, HasTheIntegralsOfItsValues) {
  const support::ProcessResult r =
      support::run_carlo("integrate 'x^a' 'b*x' -d x=0:1 --set a=1:3:0.5 --set b=1:2:1 --name p --name q --derive p/q "
                         "--rel-error 1e-4 --json " +
                         path("r.json") + " -o " + path("out"));
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, testing::AllOf(HasSubstr("All rows use the same points."), HasSubstr("correlation with"),
                                       HasSubstr("data and plot: ")));
  const nlohmann::json j = nlohmann::json::parse(mc::read_file(path("r.json")));
  ASSERT_EQ(j["outputs"].size(), 20u);
  ASSERT_EQ(j["derived"].size(), 10u);
  for (std::size_t p = 0; p < 10; ++p) {
    const nlohmann::json &x = j["outputs"][2 * p], &y = j["outputs"][2 * p + 1], &ratio = j["derived"][p];
    const double a = x["set"]["a"], b = x["set"]["b"];
    EXPECT_EQ(ratio["set"], x["set"]);
    // Student's t of 23 degrees of freedom: each bound fails for 1e-5 of the choices of seeds.
    EXPECT_NEAR(x["value"], 1 / (a + 1), 5.5 * x["std_error"].get<double>());
    EXPECT_NEAR(y["value"], b / 2, 5.5 * y["std_error"].get<double>());
    EXPECT_NEAR(ratio["value"], 2 / b / (a + 1), 5.5 * ratio["std_error"].get<double>() + 1e-12);
  }
  EXPECT_GT(j["correlation"][0][2], 0.999) << "the integrals of x^1 with two values of b";
  const std::string csv = mc::read_file(path("out") + "/sweep.csv");
  EXPECT_THAT(csv, testing::StartsWith("a,b,series,title,value,std_error,lo,hi,error_bar,correlation_with_row_before\n"
                                       "1,1,1,\"p\",0."));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 31);
  EXPECT_TRUE(std::filesystem::exists(path("out") + "/sweep.svg") || r.output.find("gnuplot is not") != r.output.npos);
}

TEST_F(Sweep, BoundsMayUseItsParameter) {
  const support::ProcessResult r =
      support::run_carlo("integrate 1 -d x=0:a,y=0:x --set a=1:2:1 --json " + path("r.json"));
  const nlohmann::json j = nlohmann::json::parse(mc::read_file(path("r.json")));
  EXPECT_NEAR(j["outputs"][0]["value"], 0.5, 1e-3);
  EXPECT_NEAR(j["outputs"][1]["value"], 2, 4e-3);
  EXPECT_THAT(support::run_carlo("integrate 'log(a*x-1)' -d x=1:2 --set a=0.5:1:0.25").output,
              HasSubstr("the first at x = 1."));
  EXPECT_THAT(support::run_carlo("integrate a*k -d k=1..3 --set a=1:2:1").output, HasSubstr("12             ± 0"));
}

// The integral at a = 0 is 0 at every point: its error stays unknown, but it does not cost all calls at each value.
TEST_F(Sweep, SharesItsCalls) {
  const support::ProcessResult r = support::run_carlo(
      "integrate a*x -d x=0:1 --method rqmc --max-calls 1e5 --set a=0:10:1 --json " + path("r.json"));
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_THAT(r.output, testing::AllOf(HasSubstr("all_zero"), HasSubstr("stopped: max_calls")));
  const nlohmann::json j = nlohmann::json::parse(mc::read_file(path("r.json")));
  EXPECT_LE(j["calls"], 11 * 16384);
  EXPECT_EQ(j["outputs"][0]["rounds"].back()["calls"], j["calls"]);
}

TEST_F(Sweep, BadCombinations_AreRefused) {
  const auto says = [](const std::string& arguments) { return support::run_carlo("integrate " + arguments).output; };
  EXPECT_THAT(says("a*x -d x=0:1 --set a=1:2:1 --histogram x=4"), HasSubstr("of one integrand; 2 were given"));
  EXPECT_THAT(says("x -d x=0:1 --output " + path("o")), HasSubstr("--output is for a sweep"));
  EXPECT_THAT(says("a*x a -d x=0:1 --set a=1:400:1"), HasSubstr("800 integrals; at most 500"));
  EXPECT_THAT(says("1 -d k=1..n --set n=500:2500:1000"), HasSubstr("sweep within 1000 terms"));
}

} // namespace
