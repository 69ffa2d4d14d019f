// The integrand of a program: integrate, converge and trade.

#include <support/files.h>
#include <tools/run_carlo.h>

#include <mc/core/file.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace {

using support::ProcessResult, support::run_carlo;
using testing::AllOf, testing::HasSubstr;

struct CommandIntegrand : support::ScratchTest {
  // The example with another body of `eval`.
  std::string program(const std::string& body = "return (x[0] * x[1] ** 2,)") const {
    std::string text = mc::read_file(MC_SOURCE_DIR "/examples/program-python/integrand.py");
    const std::string own = "return (x[0] * x[1] ** 2,)";
    text.replace(text.find(own), own.size(), body);
    return "--command \"python3 '" + write("mine.py", text) + "'\" ";
  }
  void expect_refused(const std::string& arguments, const std::string& message) const {
    const ProcessResult r = run_carlo("integrate " + arguments);
    EXPECT_EQ(r.exit_code, 2) << arguments << "\n" << r.output;
    EXPECT_THAT(r.output, HasSubstr(message)) << arguments;
    const std::size_t line = r.output.rfind("carlo: ");
    ASSERT_NE(line, std::string::npos);
    EXPECT_EQ(std::count(r.output.begin() + std::ptrdiff_t(line), r.output.end(), '\n'), 1) << r.output;
  }
  nlohmann::json integrated(const std::string& arguments) const {
    const ProcessResult r = run_carlo("integrate " + arguments + " --json '" + path("r.json") + "'");
    EXPECT_EQ(r.exit_code, 0) << r.output;
    return nlohmann::json::parse(mc::read_file(path("r.json")));
  }
};

TEST_F(CommandIntegrand, EqualsItsExpression) {
  const nlohmann::json a = integrated(program() + "-d x=0:1,y=0:2"), b = integrated("'x*y^2' -d x=0:1,y=0:2");
  EXPECT_NEAR(a["value"].get<double>(), b["value"].get<double>(), 1e-12);
  EXPECT_EQ(a["calls"], b["calls"]);
  const nlohmann::json c = integrated(program("return (math.exp(-x[0] ** 2 / 2),)\nimport math") + "-d x=-inf:inf");
  EXPECT_NEAR(c["value"].get<double>(), std::sqrt(2 * 3.14159265358979), 5 * c["std_error"].get<double>());
}

// The number of processes does not matter.
TEST_F(CommandIntegrand, SameBitsForAnyThreads) {
  const std::string arguments = program() + "-d x=0:1,y=0:2 --rel-error 1e-5 --threads ";
  EXPECT_EQ(integrated(arguments + "1")["value"], integrated(arguments + "5")["value"]);
}

TEST_F(CommandIntegrand, OutputsShareThePoints) {
  const nlohmann::json r =
      integrated("one mean " + program("return (1.0 + 0 * x[0], x[0])") + "-d x=0:4 --max-calls 10000")["outputs"];
  ASSERT_EQ(r.size(), 2u);
  EXPECT_EQ(r[0]["integrand"], "one");
  EXPECT_NEAR(r[0]["value"].get<double>(), 4, 1e-9);
  EXPECT_NEAR(r[1]["value"].get<double>(), 8, 0.05);
}

TEST_F(CommandIntegrand, ManyVariables) {
  const nlohmann::json r = integrated(program("return (sum(x),)") + "--dim 1024 --max-calls 20000");
  EXPECT_NEAR(r["value"].get<double>(), 512, 0.5);
}

TEST_F(CommandIntegrand, HistogramAndQuantiles) {
  const ProcessResult r =
      run_carlo("integrate " + program() + "-d x=0:1,y=0:2 --max-calls 3000 --histogram y=2 --quantiles 0.5");
  EXPECT_THAT(r.output, AllOf(HasSubstr("y in [1, 2)"), HasSubstr("quantile 0.5: "))) << r.output;
}

TEST_F(CommandIntegrand, MisbehaviourIsOneLine) {
  const std::string box = "-d x=0:1,y=0:2";
  expect_refused(program("return (float('nan') if x[0] > 0.5 else 1.0,)") + box, "the integrand is not finite at ");
  expect_refused(program("return (float('nan') if x[0] > 0.5 else 1.0,)") + box, "x = 0.");
  expect_refused(program("return (1.0 / 0,)") + box, "the program ended with code 1 instead of answering 'eval'");
  expect_refused(program("return ()") + box + " --timeout 1", "it hangs in eval at x = (");
  expect_refused(program("return (1.0, 2.0)") + box, "it wrote 8 bytes more than the answer");
  expect_refused("a b " + program() + box + " --timeout 8", "where 1 of 2 numbers have come");
  expect_refused(program("import time; time.sleep(100)") + box + " --timeout 1", "it hangs in eval at x = (");
  expect_refused(program("import random; return (random.random(),)") + box, "it must depend on x alone");
  expect_refused("--command 'echo ready; cat' " + box, "bytes more than the answer");
  expect_refused("--command 'no-such-program 2>/dev/null' " + box, "ended with code 127");
}

TEST_F(CommandIntegrand, BadOptionsAreOneLine) {
  expect_refused(program(), "--command needs the variables: --domain \"x=0:1,y=-1:2\", or --dim N");
  expect_refused(program() + "--dim 0", "--dim 0 must lie in 1 to 1024");
  expect_refused(program() + "--dim 1025", "--dim 1025 must lie in 1 to 1024");
  expect_refused(program() + "--dim 2 -d x=0:1", "give --dim or --domain");
  expect_refused(program() + "--dim 2 --plugin a.so", "the integrand comes from one of them");
  expect_refused("a a " + program() + "--dim 2", "the output 'a' is named twice");
  expect_refused("'x+y' " + program() + "--dim 2", "'x+y' names no output");
  expect_refused("x -d x=0:1 --dim 2", "--dim is for a --command");
  expect_refused("x -d x=0:1 --timeout 2", "--timeout is for foreign code: a --plugin or a --command");
}

TEST_F(CommandIntegrand, ConvergeAndTrade) {
  const std::string out = " -o '" + path("out") + "'";
  ProcessResult r = run_carlo("converge " + program() + "-d x=0:1,y=0:2 --max-n 256 --replicates 8" + out);
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, AllOf(HasSubstr("  random "), HasSubstr("  sobol ")));
  r = run_carlo("converge a b " + program("return (x[0], x[1])") + "--dim 2 --max-n 64 --replicates 8" + out);
  EXPECT_THAT(r.output, AllOf(HasSubstr("a\n  random"), HasSubstr("b\n  random"))) << r.output;
  r = run_carlo("trade " + program() + "-d x=0:1,y=0:2 --max-n 64 --error 0.5" + out);
  EXPECT_EQ(r.exit_code, 0) << r.output;
  EXPECT_THAT(r.output, HasSubstr("error 0.5: "));
}

} // namespace
