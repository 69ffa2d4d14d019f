#include <mc/core/error.h>

#include <cstdio>

namespace mc {

void detail::assertion_failed(const char* expression, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, expression);
  std::abort();
}

} // namespace mc
