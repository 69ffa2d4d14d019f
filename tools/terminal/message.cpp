#include <terminal/message.h>

#include <mc/core/text.h>

#include <cstdio>

namespace carlo {

void print_message(std::string_view text) {
  for (bool more = true; more;) {
    const std::size_t end = text.find('\n');
    std::fprintf(stderr, "carlo: %s\n", mc::printable(text.substr(0, end)).c_str());
    more = end != std::string_view::npos;
    if (more) text.remove_prefix(end + 1);
  }
}

} // namespace carlo
