#pragma once
/// Lists in one argument of the command line.

#include <string_view>
#include <vector>

namespace carlo {

/// The words between the separators, trimmed: "a, b,,c" is "a", "b", "", "c".
std::vector<std::string_view> split(std::string_view text, char separator);

} // namespace carlo
