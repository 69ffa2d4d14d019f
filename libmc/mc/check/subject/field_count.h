#pragma once
/// Number of members of a struct.

#include <type_traits>
#include <utility>

namespace mc::detail {

/// Converts to any type, in unevaluated expressions.
struct AnyField {
  template <class T> operator T() const; // NOLINT(google-explicit-constructor)
};

template <class T, std::size_t... I> constexpr bool takes_fields(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), AnyField{})...}; };
}

/// Returns the number of members of an aggregate, at most 16; a base class counts as one. Returns 0 for any other type.
template <class T> constexpr int field_count() {
  if constexpr (!std::is_aggregate_v<T>) {
    return 0;
  } else {
    constexpr auto largest = []<std::size_t... N>(std::index_sequence<N...>) {
      std::size_t most = 0;
      ((takes_fields<T>(std::make_index_sequence<N>()) ? most = N : most), ...);
      return most;
    };
    return static_cast<int>(largest(std::make_index_sequence<17>()));
  }
}

} // namespace mc::detail
