#pragma once
/// XML as a tree of plain data, with line numbers and a record of the parts that were read.

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace render {

/// An XML element. Reading an attribute or a child marks it as used, so that unused parts can be rejected.
class XmlElement {
 public:
  std::string tag;                  ///< Name of the element.
  std::string file;                 ///< File that contains the element.
  int line = 0;                     ///< Line of the element in its file, from 1.
  std::vector<XmlElement> children; ///< Child elements in the order of the file.

  /// Value of an attribute. Throws Error if it is missing.
  const std::string& attribute(std::string_view key) const;
  /// Value of an attribute, or `fallback` if it is missing.
  std::string attribute_or(std::string_view key, std::string_view fallback) const;
  /// Whether the attribute is present. Does not mark it as used.
  bool has(std::string_view key) const { return attributes_.contains(std::string(key)); }
  /// Marks the element as used.
  void mark_used() const { seen_ = true; }

  /// "scene.xml:14"
  std::string where() const;
  /// Throws Error "scene.xml:14: <bsdf>: message".
  [[noreturn]] void fail(const std::string& message) const;
  /// Throws Error for the first element or attribute below that was never used.
  void require_all_used() const;

  /// Replaces the value of every attribute by f(value).
  template <class F> void replace_values(const F& f) {
    for (auto& [key, attribute] : attributes_) attribute.value = f(attribute.value);
  }
  /// Sets an attribute, unused so far.
  void set(std::string key, std::string value) { attributes_[std::move(key)] = {std::move(value), false}; }

 private:
  struct Attribute {
    std::string value;
    mutable bool seen;
  };
  std::map<std::string, Attribute> attributes_;
  mutable bool seen_ = false;
};

/// Reads an XML file.
///   throws : Error with the line for broken XML, for content other than one root element, and for an attribute that is
///            given twice.
XmlElement read_xml(const std::string& path);

} // namespace render
