#pragma once
/// Calls on the alternatives of a closed set.

#include <utility>
#include <variant>

namespace render {

/// Calls f with the alternative of a struct that inherits from its variant; the variant must hold a value. Like
/// std::visit, but with comparisons instead of a table of functions, so that the calls are inlined.
template <std::size_t i = 0, class... Kinds, class F>
[[gnu::always_inline]] inline decltype(auto) dispatch(const std::variant<Kinds...>& kinds, F&& f) {
  if constexpr (i + 1 < sizeof...(Kinds)) {
    if (kinds.index() != i) return dispatch<i + 1>(kinds, std::forward<F>(f));
  }
  return std::forward<F>(f)(*std::get_if<i>(&kinds));
}

} // namespace render
