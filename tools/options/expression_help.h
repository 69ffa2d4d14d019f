#pragma once
/// The section of --help about expressions.

#include <options/subcommand.h>

namespace carlo {

inline HelpSection expression_section() {
  return {
      "Expressions",
      {{"operators", "+ - * / ^, < <= == != >= >, and, or, not(), c ? a : b, if(c, a, b)"},
       {"functions", "abs sign floor rint min max sum avg sqrt exp ln log (= ln) log2 log10 sin cos tan asin acos atan "
                     "atan2 sinh cosh tanh asinh acosh atanh"},
       {"constants", "_pi, _e"}}};
}

} // namespace carlo
