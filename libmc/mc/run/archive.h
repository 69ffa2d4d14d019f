#pragma once
/// Values as bytes, for checkpoints. One function describes a type for writing and for reading.
///
/// A type is archived by its member archive(a), or by a function archive(a, x) in its namespace. Both are templates of
/// the type of `a`, and call a(first, second, ...) with the fields: see SampleSums::archive of librender.
/// Numbers, enumerations, strings, vectors, deques, arrays, optionals, pairs, tuples, maps and fixed-size Eigen arrays
/// need no function. Bytes depend on the byte order of the machine.

#include <mc/core/error.h>

#include <Eigen/Core>

#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace mc {

/// A container that is constructed with its final size, such as the sums of a film. Reading another size throws Error.
template <class Container> struct FixedSize {
  Container& container; ///< The container.
};
/// Archives a container without changing its size.
template <class Container> FixedSize<Container> fixed_size(Container& container) { return {container}; }

namespace detail {

template <class T>
concept EigenArray = requires(T& x) {
  typename T::Scalar;
  { T::SizeAtCompileTime } -> std::convertible_to<int>;
  x.data();
};
/// Whether the bytes of a value are its archive. A truth value is not: bytes other than 0 and 1 are none.
template <class T>
inline constexpr bool
    is_plain = (std::is_arithmetic_v<T> && !std::same_as<T, bool>) || std::is_enum_v<T> || EigenArray<T>;

template <class Archive, class T> void archive_value(Archive& a, T& x);

// Reads or writes the number of elements; a reader resizes the container.
template <class Archive, class Container> void archive_size(Archive& a, Container& c) {
  std::uint64_t n = c.size();
  archive_value(a, n);
  if constexpr (Archive::is_reader) {
    a.require_left(n); // an element takes at least a byte
    c.resize(static_cast<std::size_t>(n));
  }
}

template <class Archive, class Container> void archive_elements(Archive& a, Container& c) {
  using Element = typename Container::value_type;
  constexpr bool is_contiguous = requires { c.data(); };
  if constexpr (is_contiguous && is_plain<Element>) a.bytes(c.data(), c.size() * sizeof(Element));
  else
    for (Element& x : c) archive_value(a, x);
}

template <class Archive, class Container> void archive(Archive& a, FixedSize<Container>& fixed) {
  std::uint64_t n = fixed.container.size();
  archive_value(a, n);
  require(n == fixed.container.size(), "archive: {} elements where {} are expected", n, fixed.container.size());
  archive_elements(a, fixed.container);
}
template <class Archive> void archive(Archive& a, std::string& text) {
  archive_size(a, text);
  archive_elements(a, text);
}
template <class Archive, class T> void archive(Archive& a, std::vector<T>& v) {
  archive_size(a, v);
  archive_elements(a, v);
}
template <class Archive, class T> void archive(Archive& a, std::deque<T>& v) {
  archive_size(a, v);
  archive_elements(a, v);
}
template <class Archive, class T, std::size_t n> void archive(Archive& a, std::array<T, n>& v) {
  archive_elements(a, v);
}
template <class Archive, class A, class B> void archive(Archive& a, std::pair<A, B>& p) {
  archive_value(a, p.first);
  archive_value(a, p.second);
}
template <class Archive, class... T> void archive(Archive& a, std::tuple<T...>& values) {
  std::apply([&a](T&... x) { (archive_value(a, x), ...); }, values);
}
template <class Archive, class T> void archive(Archive& a, std::optional<T>& x) {
  bool has_value = x.has_value();
  archive_value(a, has_value);
  if constexpr (Archive::is_reader) {
    x.reset();
    if (has_value) x.emplace();
  }
  if (has_value) archive_value(a, *x);
}
template <class Archive, class Key, class T> void archive(Archive& a, std::map<Key, T>& map) {
  std::uint64_t n = map.size();
  archive_value(a, n);
  if constexpr (Archive::is_reader) {
    map.clear();
    for (std::uint64_t i = 0; i < n; ++i) {
      Key key{};
      archive_value(a, key);
      archive_value(a, map[key]);
    }
  } else {
    for (auto& [key, value] : map) {
      Key copy = key;
      archive_value(a, copy);
      archive_value(a, value);
    }
  }
}

template <class Archive, class T> void archive_value(Archive& a, T& x) {
  if constexpr (is_plain<T>) {
    if constexpr (EigenArray<T>) {
      static_assert(T::SizeAtCompileTime != Eigen::Dynamic, "Eigen arrays of variable size need their own function");
      a.bytes(x.data(), sizeof(typename T::Scalar) * static_cast<std::size_t>(T::SizeAtCompileTime));
    } else a.bytes(&x, sizeof x);
  } else if constexpr (std::same_as<T, bool>) {
    auto byte = static_cast<std::uint8_t>(x);
    archive_value(a, byte);
    require(byte <= 1, "archive: {} where a truth value is expected", byte);
    x = byte == 1;
  } else if constexpr (requires { x.archive(a); }) x.archive(a);
  else archive(a, x);
}

} // namespace detail

/// Appends values to a string of bytes.
class ArchiveWriter {
 public:
  static constexpr bool is_reader = false; ///< Whether values are read.

  ArchiveWriter() = default;
  /// Reuses the memory of a text, whose content is lost: new memory costs more than the writing of it.
  explicit ArchiveWriter(std::string memory) : text_(std::move(memory)) { text_.clear(); }

  /// Appends values in order.
  template <class... T> ArchiveWriter& operator()(const T&... values) {
    // Functions of types take references that a reader changes; a writer leaves them as they are.
    (detail::archive_value(*this, const_cast<T&>(values)), ...);
    return *this;
  }
  /// Makes room for n more bytes, so that the text does not grow by copies.
  void reserve(std::size_t n) { text_.reserve(text_.size() + n); }
  /// Appends n bytes.
  void bytes(const void* data, std::size_t n) { text_.append(static_cast<const char*>(data), n); }
  /// Appends what write() appends, as a string: with its length before it.
  template <class Write> void nested(const Write& write) {
    const std::size_t begin = text_.size();
    (*this)(std::uint64_t{0});
    write(*this);
    const std::uint64_t length = text_.size() - begin - sizeof length;
    std::memcpy(text_.data() + begin, &length, sizeof length);
  }
  /// The bytes so far.
  const std::string& text() const { return text_; }
  /// Moves the bytes out.
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// Reads values from bytes of an ArchiveWriter, which must outlive this.
class ArchiveReader {
 public:
  static constexpr bool is_reader = true; ///< Whether values are read.

  /// Reads from the start of `text`.
  explicit ArchiveReader(std::string_view text) : left_(text) {}

  /// Reads values in order.
  ///   throws : Error where the bytes end early, or contain another number of elements than a fixed size.
  template <class... T> ArchiveReader& operator()(T&&... values) {
    (detail::archive_value(*this, values), ...);
    return *this;
  }
  /// Reads n bytes. Throws Error where fewer are left.
  void bytes(void* data, std::size_t n) {
    require_left(n);
    if (n > 0) std::memcpy(data, left_.data(), n);
    left_.remove_prefix(n);
  }
  /// Throws Error where fewer than n bytes are left.
  void require_left(std::uint64_t n) const {
    require(n <= left_.size(), "archive: {} bytes are needed, and {} are left", n, left_.size());
  }
  /// Reads all bytes that are left.
  std::string rest() { return std::string(std::exchange(left_, {})); }
  /// Throws Error where bytes are left.
  void require_end() const { require(left_.empty(), "archive: {} bytes are left over", left_.size()); }

 private:
  std::string_view left_;
};

} // namespace mc
