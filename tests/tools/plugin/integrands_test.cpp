// carlo integrate --plugin.

#include <support/files.h>
#include <tools/run_carlo.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using support::ProcessResult, support::run_carlo;
using testing::HasSubstr;

const std::string of_plugin = std::string("--plugin '") + PLUGIN_DIR + "/integrands.so' ";

struct PluginIntegrand : support::ScratchTest {
  static void expect_refused(const std::string& arguments, const std::string& message) {
    const ProcessResult r = run_carlo("integrate " + arguments);
    EXPECT_EQ(r.exit_code, 2) << arguments << "\n" << r.output;
    EXPECT_THAT(r.output, HasSubstr(message)) << arguments;
    EXPECT_EQ(std::count(r.output.begin(), r.output.end(), '\n'), 1) << r.output;
  }
  nlohmann::json integrated(const std::string& arguments, int code = 0) const {
    const ProcessResult r = run_carlo("integrate " + arguments + " --json '" + path("r.json") + "'");
    EXPECT_EQ(r.exit_code, code) << r.output;
    return nlohmann::json::parse(mc::read_file(path("r.json")));
  }
};

TEST_F(PluginIntegrand, IsIntegratedOverItsBounds) {
  const nlohmann::json sum = integrated(of_plugin + "Sum"), batch = integrated(of_plugin + "Batch");
  EXPECT_NEAR(sum["value"].get<double>(), 3, 0.02);
  EXPECT_EQ(sum["truth"], 3);
  EXPECT_EQ(sum["value"], batch["value"]);
  EXPECT_EQ(sum["value"], integrated("'x+y' -d x=0:1,y=-1:2")["value"]);
  EXPECT_THAT(run_carlo("integrate " + of_plugin + "Sum --max-calls 3000 --histogram x1=3").output,
              HasSubstr("x1 in [1, 2)"));
}

TEST_F(PluginIntegrand, SeveralOutputs) {
  const nlohmann::json r = integrated(of_plugin + "Moments Sum");
  ASSERT_EQ(r["outputs"].size(), 4u);
  const double truths[] = {3, 1.5, 0.75};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(r["outputs"][k + 1]["truth"], truths[k]);
    EXPECT_NEAR(r["outputs"][k + 1]["value"].get<double>(), truths[k], 0.02);
  }
  EXPECT_EQ(r["outputs"][0]["integrand"], "Sum");
  EXPECT_EQ(r["outputs"][2]["integrand"], "Moments.mean");
}

TEST_F(PluginIntegrand, ManyDimensions) {
  EXPECT_NEAR(integrated(of_plugin + "Wide --max-calls 10000")["value"].get<double>(), 512, 0.2);
  EXPECT_EQ(run_carlo("converge " + of_plugin + "Wide --max-n 64 -o '" + path("out") + "'").exit_code, 0);
}

// Its own density makes the integrand constant.
TEST_F(PluginIntegrand, OwnDensityIsUsed) {
  const nlohmann::json r = integrated(of_plugin + "Singular --method rqmc --max-calls 4000 --abs-error 0.01");
  EXPECT_NEAR(r["value"].get<double>(), 4, 1e-9);
  EXPECT_NEAR(integrated(of_plugin + "Beyond --max-calls 50000")["value"].get<double>(), 1, 0.02);
  EXPECT_EQ(run_carlo("converge " + of_plugin + "Singular --max-n 64 -o '" + path("out") + "'").exit_code, 0);
}

TEST_F(PluginIntegrand, OlderVersionStillLoads) {
  EXPECT_NEAR(integrated(std::string("--plugin '") + PLUGIN_DIR + "/second_version.so'")["value"].get<double>(), 0.5,
              0.01);
}

TEST_F(PluginIntegrand, MisbehaviourIsOneLine) {
  expect_refused(of_plugin + "Crash", "it crashed in eval at x = (");
  expect_refused(of_plugin + "Hang --timeout 1", "it hangs in eval at x = (");
  expect_refused(of_plugin + "NaN", "at x0 = 0.9");
  expect_refused(of_plugin + "Remembers", "; it must depend on x alone, on nothing before");
  expect_refused(of_plugin + "Pairs", "eval_many, as point 252 of 253, nan");
  expect_refused(of_plugin + "NoDensity", "the density is 0 at its own sample x = (");
  expect_refused(of_plugin + "NoPoint", "the sample at u = (");
  expect_refused(of_plugin, "it contains 15 integrands; name one of Sum, Batch");
  expect_refused(of_plugin + "Sum Wide", "they must be the same");
  expect_refused(of_plugin + "Sum -d x=0:1",
                 "--domain is for an expression or a --command; a plugin states its own bounds");
}

} // namespace
