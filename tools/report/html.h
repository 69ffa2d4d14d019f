#pragma once
/// Text in pages.

#include <string>
#include <string_view>

namespace carlo {

/// A text as HTML that shows it, in an attribute too.
std::string escaped(std::string_view text);

} // namespace carlo
