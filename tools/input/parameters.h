#pragma once
/// Values of parameters on the command line, and sweeps over them.

#include <string>
#include <utility>
#include <vector>

namespace carlo {

using ParameterSet = std::vector<std::pair<std::string, double>>; ///< in the order of the text

/// "alpha=0.1,n=3" is one set. A parameter may have several values, a list "alpha=0.1,0.2,0.5" or a range with both its
/// ends "alpha=0.1:0.5:0.1" (first : last : step), or both in one list: then every combination is a set, the last
/// parameter changing fastest. Values of a range are rounded to 12 digits, so that 0.3 is 0.3.
///   throws : Error that names --params for anything else, a name that stands twice, or more than 10000 sets
std::vector<ParameterSet> parse_parameters(const std::string& text);

} // namespace carlo
