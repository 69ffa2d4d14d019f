#pragma once
/// Calls on the members of a closed set.

#include <utility>
#include <variant>

namespace render {

/// std::visit for a struct that inherits from its variant: f(alternative).
template <class... Kinds, class F> decltype(auto) dispatch(const std::variant<Kinds...>& kinds, F&& f) {
  return std::visit(std::forward<F>(f), kinds);
}

} // namespace render
