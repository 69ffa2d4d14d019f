#pragma once
/// Manual pages from the help texts.

#include <options/help.h>

#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// A page for man(1), in the macros of man(7).
///   name    : "carlo" or "carlo-render"
///   version : "0.2.0"
///   others  : names of related pages
std::string manual_page(std::string_view name, const HelpPage& page, std::string_view version,
                        const std::vector<std::string>& others);

} // namespace carlo
