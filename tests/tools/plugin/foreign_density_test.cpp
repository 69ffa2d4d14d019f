// carlo integrate --importance-plugin and --importance-command.

#include <support/files.h>
#include <tools/run_carlo.h>

#include <mc/core/file.h>
#include <mc/core/types.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace {

using support::ProcessResult, support::run_carlo;
using testing::HasSubstr;

const std::string of_integrands = std::string("--importance-plugin '") + PLUGIN_DIR + "/integrands.so' ",
                  of_samplers = std::string("--importance-plugin '") + PLUGIN_DIR + "/samplers.so' ",
                  disk = "--importance-command \"python3 '" MC_SOURCE_DIR "/examples/program-python/sampler.py'\" ";

struct ForeignDensity : support::ScratchTest {
  nlohmann::json integrated(const std::string& arguments) const {
    const ProcessResult r = run_carlo("integrate " + arguments + " --json '" + path("r.json") + "'");
    EXPECT_EQ(r.exit_code, 0) << r.output;
    return nlohmann::json::parse(mc::read_file(path("r.json")));
  }
  void expect_value(const std::string& arguments, double truth) const {
    const nlohmann::json r = integrated(arguments);
    EXPECT_NEAR(r["value"].get<double>(), truth, 5 * r["std_error"].get<double>()) << arguments;
  }
};

TEST_F(ForeignDensity, ProgramDrawsThePoints) {
  // The integral over the disk, since the density is 0 outside.
  expect_value("'x*x+y*y' -d x=-1:1,y=-1:1 " + disk, mc::pi<double> / 2);
  expect_value("'x*x+y*y' -d x=0:1,y=0:1 " + disk, mc::pi<double> / 8);
}

TEST_F(ForeignDensity, PluginDrawsThePoints) {
  expect_value("'1/sqrt(x*y)' -d x=0:1,y=0:1 " + of_integrands +
                   "--importance-name Singular --max-calls 4000 --abs-error 0.1",
               4);
  // An integrand with a pole where the density has one, beside a smooth part.
  expect_value("'exp(x)/sqrt(y)+1' -d x=0:1,y=0:1 " + of_integrands + "--importance-name Singular",
               2 * (std::exp(1) - 1) + 1);
}

TEST_F(ForeignDensity, BadDensityIsOneLine) {
  const auto expect_refused = [](const std::string& arguments, const std::string& message) {
    const ProcessResult r = run_carlo("integrate " + arguments);
    EXPECT_EQ(r.exit_code, 2) << arguments << "\n" << r.output;
    EXPECT_THAT(r.output, HasSubstr(message)) << arguments;
  };
  const std::string box = "x -d x=0:1 ";
  expect_refused(box + of_integrands, "it contains 4 densities; choose one of Singular, Beyond, NoDensity, NoPoint by "
                                      "--importance-name");
  expect_refused(box + of_integrands + "--importance-name Beyon", "unknown density 'Beyon'; did you mean 'Beyond'?");
  expect_refused(box + of_integrands + "--importance-name Singular",
                 "the density Singular has 2 coordinates, the integrand 1 variables");
  expect_refused(box + of_integrands + "--importance-name NoDensity", "the density is 0 at its own sample x = (");
  expect_refused(box + of_integrands + "--importance-name NoPoint", "the sample at u = (");
  expect_refused(box + disk, "the program ended with code 1 instead of answering 'sample'");
  expect_refused(box + disk + "--peak 'x=.5 width 1'", "the density is that of one of them");
  expect_refused(box + "--importance-name a", "--importance-name is for --importance-plugin");
  expect_refused(box + "--uniforms 3", "--uniforms is for --importance-command");
  expect_refused(box + "--importance-command 'exit 5'", "ended with code 5 instead of answering 'sample'");
}

TEST_F(ForeignDensity, SamplersOfAPluginServeToo) {
  // Points of the disk; the integral of 1 over the disk is pi.
  expect_value("'1' -d x=-1:1,y=-1:1 " + of_samplers + "--importance-name Rejection --abs-error 0.01", mc::pi<double>);
}

} // namespace
