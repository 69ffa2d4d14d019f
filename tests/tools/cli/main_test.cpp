#include <tools/run_carlo.h>

#include <gmock/gmock.h>

namespace {

using support::run_carlo;

TEST(Main, UnknownArgument_IsNamed) {
  const auto says = [](const std::string& arguments, const std::string& line) {
    const support::ProcessResult r = run_carlo(arguments);
    EXPECT_EQ(r.exit_code, 2) << arguments;
    EXPECT_EQ(r.output, "carlo: " + line + "\n") << arguments;
  };
  says("rendr cbox", "unknown argument 'rendr'; did you mean 'render'? (see carlo --help)");
  says("--verison", "unknown argument '--verison'; did you mean '--version'? (see carlo --help)");
  says("render cbox --sppp 4 --sede 3", "unknown argument '--sppp'; did you mean '--spp'? (see carlo render --help)");
  says("integrate x -z", "unknown argument '-z' (see carlo integrate --help)");
  says("integrate -x^2 -d x=0:1",
       "unknown argument '-x^2'; an expression that begins with - goes into parentheses: \"(-x^2)\" "
       "(see carlo integrate --help)");
  says("render cbox --outptu=/tmp/a.exr", "unknown argument '--outptu=/tmp/a.exr' (see carlo render --help)");
  says("render a b", "unknown argument 'b' (see carlo render --help)");
  says("converge --max-n 64 --max-n 128", "--max-n is given 2 times; give it once (see carlo converge --help)");
  says("integrate pi --seed 99999999999999999999",
       "--seed: 99999999999999999999 is too large; at most 18446744073709551615 (see carlo integrate --help)");
  says("render a --spp 5e9", "--spp: 5e9 is too large; at most 2147483647 (see carlo render --help)");
  says("render a --spp -1e10", "--spp: -1e10 is too small; at least -2147483648 (see carlo render --help)");
  says("render a --spp 2.5", "--spp: '2.5' is not a whole number (see carlo render --help)");
  says("render a --spp inf", "--spp: 'inf' is not a whole number (see carlo render --help)");
  says("validate --samples -1", "--samples: -1 must be >= 0 (see carlo validate --help)");
  says("render a --time 1s", "--time: '1s' is not a number (see carlo render --help)");
  says("validate Linear --plugin ''",
       "--plugin: '' is empty; give a value or leave it out (see carlo validate --help)");
  says("render a --spp", "--spp needs a value: --spp N (see carlo render --help)");
}

} // namespace
