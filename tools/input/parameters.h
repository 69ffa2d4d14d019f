#pragma once
/// Parameter values from the command line, and sweeps over them.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carlo {

/// Lists of values with their names, in the order of the text.
using ParameterLists = std::vector<std::pair<std::string, std::vector<double>>>;

/// Parses "alpha=0.1,0.2,0.5", or a range with both ends "alpha=0.1:0.5:0.1" (first : last : step), or both in one
/// list. Further names follow after commas. Values of a range are rounded to 12 digits, so that 0.3 is exactly 0.3.
///   option : option name for errors, "--params".
///   throws : Error for anything else, for a repeated name, or for a range of more than 10000 values.
ParameterLists parse_lists(const std::string& text, std::string_view option);

using ParameterSet = std::vector<std::pair<std::string, double>>; ///< in the order of the text

/// The parameter sets of --params, for example "alpha=0.1,n=3". If parameters have several values, every combination is
/// a set; the last parameter varies fastest.
///   throws : the errors of parse_lists, and Error for more than 10000 sets.
std::vector<ParameterSet> parse_parameters(const std::string& text);

} // namespace carlo
