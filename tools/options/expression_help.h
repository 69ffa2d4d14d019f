#pragma once
/// The section of --help about expressions.

#include <integrands/special_functions.h>
#include <options/subcommand.h>

namespace carlo {

inline HelpSection expression_section() {
  HelpSection section{
      "Expressions",
      {{"operators", "+ - * / ^, < <= == != >= >, and, or, not(), c ? a : b, if(c, a, b)"},
       {"functions", "abs sign floor rint min max sum avg sqrt exp ln log (= ln) log2 log10 sin cos tan asin acos atan "
                     "atan2 sinh cosh tanh asinh acosh atanh"},
       {"constants", "_pi, _e; i, the imaginary unit"}}};
  for (const NamedFunction& f : special_functions()) {
    if (*f.help) section.entries.push_back({std::string(f.name) + f.arguments, f.help});
    else section.entries[1].text += std::string(" ") + f.name;
  }
  return section;
}

} // namespace carlo
