#pragma once
/// One way to refuse bad input, and one to assert what only a programmer can break.

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace mc {

/// Bad data, a bad file or a bad argument. what() is one line: what, which, its value, what is needed.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

namespace detail {
template <class... Args>
[[noreturn, gnu::cold, gnu::noinline]] void refuse(fmt::format_string<Args...> message, Args&&... args) {
  throw Error(fmt::format(message, std::forward<Args>(args)...));
}
} // namespace detail

/// Throws Error with the formatted message unless `ok`. Write the condition so that NaN fails it: `x >= 0`, never `!(x
/// < 0)`.
template <class... Args>
[[gnu::always_inline]] inline void require(bool ok, fmt::format_string<Args...> message, Args&&... args) {
  if (!ok) [[unlikely]]
    detail::refuse(message, std::forward<Args>(args)...); // out of line: callers are hot and small
}

/// Runs f; an Error that leaves it gains "where: " in front.
template <class F> decltype(auto) with_context(std::string_view where, F&& f) {
  try {
    return std::forward<F>(f)();
  } catch (const Error& e) {
    throw Error(fmt::format("{}: {}", where, e.what()));
  }
}

namespace detail {
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line);
}

} // namespace mc

#if defined(MC_CHECKED) || !defined(NDEBUG)
#define MC_ASSERT(x) ((x) ? void() : ::mc::detail::assertion_failed(#x, __FILE__, __LINE__))
#else
#define MC_ASSERT(x) void()
#endif
