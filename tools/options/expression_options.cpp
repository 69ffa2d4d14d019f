#include <options/expression_options.h>

namespace carlo {

Option domain_option(ExpressionContext& context) {
  return {
      "-d,--domain", "BOUNDS", &context.domain,
      "Variables of an expression with their bounds, e.g. \"x=0:2*_pi,y=-inf:inf\". Bounds may use variables before "
      "them: \"x=0:1,y=0:x\". \"z=normal\" or \"z=normal(MEAN,SIGMA)\" is a normal variable; the integral is its "
      "expectation. \"k=1..6\" sums over whole numbers."};
}

OptionGroup expression_group(ExpressionContext& context) {
  return {
      "Expressions",
      {
          {"--where", "CONDITION", &context.conditions,
           "Integrate only where this holds, e.g. \"x*x+y*y<1\". Elsewhere the integrand counts as 0 and is not "
           "evaluated. Several: where all hold."},
          {"--let", "NAME=EXPR", &context.lets,
           "Name a part, e.g. \"r=sqrt(x*x+y*y)\", for the integrand, bounds, conditions and other parts. Can be "
           "given several times."},
          {"--set", "NAME=VALUE", &context.settings, "Give a parameter a value, e.g. a=2. Can be given several times."},
          {"--nan", "VALUE", &context.nan,
           "Take this value, such as 0, where an expression is not a number. Default: the run ends with the place."},
      }};
}

} // namespace carlo
