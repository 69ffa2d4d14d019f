#include <render/io/xml.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/text.h>

#include <pugixml.hpp>

#include <algorithm>
#include <string_view>

namespace render {

const std::string& XmlElement::attribute(std::string_view key) const {
  const auto it = attributes_.find(std::string(key));
  if (it == attributes_.end()) fail(fmt::format("attribute '{}' is missing", key));
  it->second.seen = true;
  return it->second.value;
}

std::string XmlElement::attribute_or(std::string_view key, std::string_view fallback) const {
  return has(key) ? attribute(key) : std::string(fallback);
}

std::string XmlElement::where() const { return fmt::format("{}:{}", file, line); }

void XmlElement::fail(const std::string& message) const {
  throw mc::Error(mc::printable(fmt::format("{}: <{}>: {}", where(), tag, message)));
}

void XmlElement::require_all_used() const {
  if (!seen_) {
    const auto value = [&](const char* key) {
      const auto it = attributes_.find(key);
      return it == attributes_.end() ? std::string() : fmt::format(" {}=\"{}\"", key, it->second.value);
    };
    throw mc::Error(mc::printable(
        fmt::format("{}: <{}{}{}> is not supported here; remove it", where(), tag, value("type"), value("name"))));
  }
  for (const auto& [key, attribute] : attributes_)
    if (!attribute.seen) fail(fmt::format("attribute {}=\"{}\" is not supported; remove it", key, attribute.value));
  for (const XmlElement& child : children) child.require_all_used();
}

namespace {

// Lines of a text by binary search, since a scene asks for the line of each of its elements.
class Lines {
 public:
  explicit Lines(const std::string& text) {
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) ends_.push_back(at);
  }
  // Line of a byte, from 1.
  int at(std::ptrdiff_t offset) const {
    const auto byte = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
    return 1 + static_cast<int>(std::lower_bound(ends_.begin(), ends_.end(), byte) - ends_.begin());
  }

 private:
  std::vector<std::size_t> ends_; // bytes of the line feeds
};

constexpr int deepest = 256; // far more than scenes need, far less than the stack allows

XmlElement convert(const pugi::xml_node& node, const std::string& path, const Lines& lines, int depth = 1) {
  XmlElement element;
  element.tag = node.name();
  element.file = path;
  element.line = lines.at(node.offset_debug());
  if (depth > deepest) element.fail(fmt::format("elements are nested more than {} deep; flatten them", deepest));
  for (const auto& a : node.attributes()) {
    if (element.has(a.name()))
      element.fail(fmt::format("attribute {}=\"{}\" stands beside {}=\"{}\"; remove one", a.name(), a.value(), a.name(),
                               element.attribute(a.name())));
    element.set(a.name(), a.value());
  }
  for (const auto& child : node.children()) {
    if (child.type() == pugi::node_element) element.children.push_back(convert(child, path, lines, depth + 1));
    else element.fail("text between elements is not supported; remove it");
  }
  return element;
}

} // namespace

XmlElement read_xml(const std::string& path) {
  const std::string text = mc::read_file(path);
  const Lines lines(text);
  pugi::xml_document document;
  // Parses a fragment: otherwise pugixml silently drops text and further elements next to the root.
  const auto result = document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_fragment);
  mc::require(bool(result), "{}:{}: broken XML: {}", path, lines.at(result.offset), result.description());
  const auto root = document.document_element();
  mc::require(bool(root), "{}: no XML element; a <scene> is needed", path);
  for (const auto& node : document.children()) {
    if (node == root) continue;
    const std::string_view space = " \t\r\n", stray = node.type() == pugi::node_element ? node.name() : node.value();
    const std::size_t start = std::min(stray.find_first_not_of(space), stray.size());
    throw mc::Error(fmt::format(
        "{}:{}: '{}' stands outside of <{}>; a file holds one element", path,
        lines.at(node.offset_debug() + static_cast<std::ptrdiff_t>(start)),
        stray.substr(start, std::min<std::size_t>(stray.find_first_of(space, start) - start, 40)), root.name()));
  }
  return convert(root, path, lines);
}

} // namespace render
