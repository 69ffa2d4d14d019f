#pragma once
/// Plain data to bytes and back, between processes of one machine. A struct takes part by a function
///   template <class A> void each(A& a, T& t);   // calls a(field, ...) on every field
/// which takes its fields by structured binding, so that it no longer compiles when one is added.

#include <mc/core/error.h>

#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace carlo {

namespace detail {
template <class T> constexpr bool is_raw = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class T, std::size_t N> constexpr bool is_raw<std::array<T, N>> = is_raw<T>;
} // namespace detail

class ByteWriter {
 public:
  template <class... T> void operator()(T&... fields) { (put(fields), ...); }
  std::string bytes;

 private:
  template <class T> void put(T& x) {
    if constexpr (detail::is_raw<T>) bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
    else each(*this, x);
  }
  void put(std::size_t n) { bytes.append(reinterpret_cast<const char*>(&n), sizeof n); }
  void put(std::string& x) { put(x.size()), bytes += x; }
  template <class T> void put(std::vector<T>& x) {
    put(x.size());
    for (T& one : x) put(one);
  }
  template <class T> void put(std::optional<T>& x) {
    bool has = x.has_value();
    put(has);
    if (has) put(*x);
  }
};

/// Throws Error when the bytes end early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  template <class... T> void operator()(T&... fields) { (get(fields), ...); }

 private:
  const char* take(std::size_t n) {
    mc::require(n <= rest_.size(), "the result is cut short");
    const char* at = rest_.data();
    rest_.remove_prefix(n);
    return at;
  }
  std::size_t size() {
    std::size_t n = 0;
    get(n);
    mc::require(n <= rest_.size(), "the result is damaged");
    return n;
  }
  template <class T> void get(T& x) {
    if constexpr (detail::is_raw<T>) std::memcpy(&x, take(sizeof x), sizeof x);
    else each(*this, x);
  }
  void get(std::string& x) {
    const std::size_t n = size();
    x.assign(take(n), n);
  }
  template <class T> void get(std::vector<T>& x) {
    x.resize(size());
    for (T& one : x) get(one);
  }
  template <class T> void get(std::optional<T>& x) {
    bool has = false;
    get(has);
    if (has) get(x.emplace());
  }

  std::string_view rest_;
};

} // namespace carlo
