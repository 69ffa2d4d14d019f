#pragma once
/// Messages on standard error.

#include <fmt/format.h>

#include <string_view>

namespace carlo {

/// Prints "carlo: " and the text on standard error; each line of the text with mc::printable, since a text may contain
/// bytes of files and plugins.
void print_message(std::string_view text);

/// Prints "carlo: warning: " and the formatted text in the same way.
template <class... Args> void warn(fmt::format_string<Args...> text, Args&&... args) {
  print_message("warning: " + fmt::format(text, std::forward<Args>(args)...));
}

} // namespace carlo
