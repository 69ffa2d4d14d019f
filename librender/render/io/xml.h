#pragma once
/// XML as a tree of plain data that knows its line numbers and which parts were read.

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace render {

/// An element. Looking at an attribute or a child marks it, so that what nobody looked at can be refused.
class XmlElement {
 public:
  std::string tag;
  std::string file;
  int line = 0;
  std::vector<XmlElement> children;

  /// The attribute's value. attribute() throws Error when it is missing.
  const std::string& attribute(std::string_view key) const;
  std::string attribute_or(std::string_view key, std::string_view fallback) const;
  bool has(std::string_view key) const { return attributes_.contains(std::string(key)); }
  void mark_used() const { seen_ = true; }

  /// "scene.xml:14"
  std::string where() const;
  /// Throws Error "scene.xml:14: <bsdf>: message".
  [[noreturn]] void fail(const std::string& message) const;
  /// Throws Error for the first element or attribute below that was never looked at.
  void require_all_used() const;

  /// Gives every attribute the value f(old value).
  template <class F> void replace_values(const F& f) {
    for (auto& [key, attribute] : attributes_) attribute.value = f(attribute.value);
  }
  void set(std::string key, std::string value) { attributes_[std::move(key)] = {std::move(value), false}; }

 private:
  struct Attribute {
    std::string value;
    mutable bool seen;
  };
  std::map<std::string, Attribute> attributes_;
  mutable bool seen_ = false;
};

/// Reads a file. Throws Error with the line for broken XML, for anything beside its one root, and for an attribute that
/// is given twice.
XmlElement read_xml(const std::string& path);

} // namespace render
