#pragma once
/// Pages that are made from a text with marks.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carlo {

/// The text with every mark replaced by its text. Marks in these texts stay as they are.
std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string>>& marks);

/// JSON that may stand within a script element: "</script>" in a string would end the element.
std::string script_safe(std::string_view json);

} // namespace carlo
