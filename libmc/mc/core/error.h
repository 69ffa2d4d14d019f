#pragma once
/// Errors for bad input, and assertions for programming errors.

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace mc {

/// Exception for bad data, a bad file or a bad argument. The message is one line that names the value, its place and
/// the allowed range.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Exception for work that needs more memory than is allowed; see memory.h.
struct MemoryError : Error {
  using Error::Error;
};

namespace detail {
template <class... Args>
[[noreturn, gnu::cold, gnu::noinline]] void refuse(fmt::format_string<Args...> message, Args&&... args) {
  throw Error(fmt::format(message, std::forward<Args>(args)...));
}
} // namespace detail

/// Throws Error with the formatted message unless `ok` is true. Write conditions that NaN fails: `x >= 0`, never `!(x <
/// 0)`.
template <class... Args>
[[gnu::always_inline]] inline void require(bool ok, fmt::format_string<Args...> message, Args&&... args) {
  if (!ok) [[unlikely]]
    detail::refuse(message, std::forward<Args>(args)...); // out of line: callers are hot and small
}

/// Runs f and returns its result. Prefixes the message of an Error or MemoryError that f throws with "where: ".
template <class F> decltype(auto) with_context(std::string_view where, F&& f) {
  try {
    return std::forward<F>(f)();
  } catch (const MemoryError& e) {
    throw MemoryError(fmt::format("{}: {}", where, e.what()));
  } catch (const Error& e) {
    throw Error(fmt::format("{}: {}", where, e.what()));
  }
}

namespace detail {
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line);
}

} // namespace mc

#if defined(MC_CHECKED) || !defined(NDEBUG)
/// Aborts with the expression and its place if x is false. Active in checked and debug builds only.
#define MC_ASSERT(x) ((x) ? void() : ::mc::detail::assertion_failed(#x, __FILE__, __LINE__))
#else
#define MC_ASSERT(x) void()
#endif
