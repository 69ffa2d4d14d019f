#pragma once
/// Values of parameters on the command line, and sweeps over them.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carlo {

/// Values by name, both in the order of the text.
using ParameterLists = std::vector<std::pair<std::string, std::vector<double>>>;

/// "alpha=0.1,0.2,0.5" or a range with both its ends "alpha=0.1:0.5:0.1" (first : last : step), or both in one list;
/// more names follow after commas. Values of a range are rounded to 12 digits, so that 0.3 is 0.3.
///   option : what errors name, "--params"
///   throws : Error for anything else, a name that stands twice, or a range of more than 10000 values
ParameterLists parse_lists(const std::string& text, std::string_view option);

using ParameterSet = std::vector<std::pair<std::string, double>>; ///< in the order of the text

/// The sets of --params: "alpha=0.1,n=3" is one. Of parameters with several values every combination is a set, the last
/// parameter changing fastest.
///   throws : Error, see parse_lists, or for more than 10000 sets
std::vector<ParameterSet> parse_parameters(const std::string& text);

} // namespace carlo
