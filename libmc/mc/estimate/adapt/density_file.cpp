#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/estimate/adapt/density_file.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>

namespace mc {

namespace {

constexpr std::string_view version = "mc-density 1";

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t h = 0xcbf29ce484222325;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return h;
}

// The lines of a text; each is a keyword followed by numbers.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  // Numbers of the next line, which must start with the keyword.
  std::string_view after(std::string_view keyword) {
    const std::string_view line = next();
    require(is(line, keyword), "density: line {} must start with '{}'", number_, keyword);
    return line.substr(keyword.size());
  }
  std::string_view next() {
    ++number_;
    const std::size_t end = rest_.find('\n');
    require(end != rest_.npos, "density: it ends at line {}, before it is whole", number_);
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return line;
  }
  static bool is(std::string_view line, std::string_view keyword) {
    return line.starts_with(keyword) && (line.size() == keyword.size() || line[keyword.size()] == ' ');
  }
  // Removes and returns the first of the numbers left in a line.
  template <class T> T number(std::string_view& line) const {
    T value{};
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
    require(error == std::errc(), "density: line {} has too few numbers, or what is none", number_);
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    return value;
  }
  void require_end(std::string_view line) const {
    require(line.empty(), "density: line {} goes on after its last number", number_);
  }
  bool done() const { return rest_.empty(); }

 private:
  std::string_view rest_;
  int number_ = 0;
};

// The text without its last line, which must be the checksum of the rest.
std::string_view checked(std::string_view text) {
  const std::size_t at = text.rfind("\nchecksum ");
  require(at != text.npos, "density: the checksum at the end is missing; the text was cut short");
  const std::string_view body = text.substr(0, at + 1);
  require(text.substr(at + 1) == fmt::format("checksum {:016x}\n", fnv1a(body)),
          "density: the checksum does not fit; the text was changed after it was written");
  return body;
}

BoxTreeNode node(Lines& lines) {
  std::string_view line = lines.next();
  BoxTreeNode n;
  const bool leaf = Lines::is(line, "leaf");
  line.remove_prefix(leaf || Lines::is(line, "cut") ? line.find(' ') : line.size());
  if (!leaf) n.axis = lines.number<std::uint32_t>(line);
  n.value = lines.number<double>(line);
  require(!leaf || n.value > 0, "density: a leaf has the weight {}; no part of the cube may be left out", n.value);
  lines.require_end(line);
  return n;
}

} // namespace

std::string to_text(const AdaptedDensity& density) {
  std::string text = fmt::format("{}\ndim {}\n", version, density.dim());
  const auto out = std::back_inserter(text);
  for (int d = 0; d < density.dim(); ++d) fmt::format_to(out, "axis {}\n", fmt::join(density.grid.edges(d), " "));
  fmt::format_to(out, "tree {}\n", density.tree ? density.tree->nodes().size() : 0);
  for (const BoxTreeNode& n : density.tree ? density.tree->nodes() : std::span<const BoxTreeNode>()) {
    if (n.axis == BoxTreeNode::leaf) fmt::format_to(out, "leaf {}\n", n.value);
    else fmt::format_to(out, "cut {} {}\n", n.axis, n.value);
  }
  return text + fmt::format("checksum {:016x}\n", fnv1a(text));
}

AdaptedDensity density_from_text(std::string_view text) {
  require(Lines::is(text.substr(0, text.find('\n')), version.substr(0, version.find(' '))),
          "density: the first line is not '{}'; this is no density", version);
  require(text.starts_with(fmt::format("{}\n", version)), "density: '{}' is another version; this program reads '{}'",
          text.substr(0, std::min(text.find('\n'), std::size_t{40})), version);
  Lines lines(checked(text));
  lines.next();
  std::string_view line = lines.after("dim");
  const auto dim = lines.number<int>(line);
  lines.require_end(line);
  std::vector<double> edges;
  for (int d = 0; d < dim; ++d) {
    line = lines.after("axis");
    for (std::size_t i = 0; i <= ImportanceGrid::bins; ++i) edges.push_back(lines.number<double>(line));
    lines.require_end(line);
  }
  AdaptedDensity density{ImportanceGrid(std::move(edges))};
  line = lines.after("tree");
  const auto count = lines.number<std::size_t>(line);
  lines.require_end(line);
  std::vector<BoxTreeNode> nodes;
  for (std::size_t i = 0; i < count; ++i) nodes.push_back(node(lines));
  require(lines.done(), "density: there is more behind the {} nodes of the tree", count);
  if (count > 0) density.tree = BoxTree(dim, nodes);
  return density;
}

void save_density(const std::string& path, const AdaptedDensity& density) { write_file(path, to_text(density)); }

AdaptedDensity load_density(const std::string& path) {
  const std::string text = read_file(path);
  return with_context(path, [&] { return density_from_text(text); });
}

} // namespace mc
