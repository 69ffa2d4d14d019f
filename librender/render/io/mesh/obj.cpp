#include <render/io/mesh/mesh.h>
#include <render/io/mesh/polygon.h>
#include <render/io/mesh/text_lines.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>
#include <mc/core/text.h>
#include <mc/random/hash.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <unordered_map>

namespace render {

namespace {

// Joins lines that end in a backslash with the next line, except in comments. The removed line ends are appended after
// the joined line, so that later lines keep their numbers.
std::string with_lines_joined(std::string text) {
  if (text.find('\\') == text.npos) return text;
  std::string joined;
  std::size_t ends = 1;
  bool comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool goes_on = text.compare(i, 2, "\\\n") == 0 || text.compare(i, 3, "\\ \n") == 0;
    comment = text[i] != '\n' && (comment || text[i] == '#');
    if (goes_on && !comment) {
      joined += ' ';
      ++ends;
      i = text.find('\n', i);
    } else if (text[i] == '\n') {
      joined.append(ends, '\n');
      ends = 1;
    } else {
      joined += text[i];
    }
  }
  return joined;
}

struct Element {
  std::string_view keyword, name, axes;
  std::size_t needed; ///< Number of coordinates required.
};
enum Kind : std::size_t { position, uv, normal };
constexpr std::array<Element, 3> elements = {
    {{"v", "vertex", "xyz", 3}, {"vt", "texture coordinate", "uv", 1}, {"vn", "normal", "xyz", 3}}};

/// The coordinates in a line; optional ones default to 0.
Vec3d numbers_of(std::size_t line, const Element& element, std::size_t index, std::string_view rest) {
  Vec3d numbers = Vec3d::Zero();
  for (std::size_t axis = 0; axis < element.axes.size(); ++axis) {
    const std::string_view word = next_word(rest);
    if (word.empty() && axis >= element.needed) break;
    const std::optional<double> value = mc::parse_double(word);
    mc::require(value.has_value(), "line {}: {} {} has no number for {}, but '{}'", line, element.name, index,
                element.axes[axis], word);
    mc::require(std::isfinite(*value), "line {}: {} {} has {} = {}, which is not finite", line, element.name, index,
                element.axes[axis], *value);
    numbers[static_cast<int>(axis)] = *value;
  }
  return numbers;
}

constexpr std::uint32_t none = 0xffffffff;
/// Indices of the elements of a corner, counted from 0; or none.
using Corner = std::array<std::uint32_t, elements.size()>;

/// The content of the file.
struct Lines {
  std::array<std::vector<Vec3d>, elements.size()> values;
  std::vector<Corner> corners;             ///< corners of all faces
  std::vector<std::size_t> ends;           ///< end of each face in `corners`
  std::vector<std::uint32_t> groups;       ///< group of each face: each `g` and `usemtl` begins a new group
  std::vector<std::uint32_t> materials;    ///< material of each face, an index in `names`
  std::vector<std::string> names = {""};   ///< names of the materials; the first is that of faces above any `usemtl`
  std::vector<std::string> material_files; ///< names in `mtllib`
  /// First line of a face in which only some corners have this element, or 0. Such an element is ignored for the whole
  /// face.
  std::array<std::size_t, elements.size()> without = {};

  bool has(Kind kind) const {
    return std::any_of(corners.begin(), corners.end(), [&](const Corner& c) { return c[kind] != none; });
  }
};

/// Index of the element that a field refers to: from 1 on, or, if negative, backward from the last element above the
/// line.
std::uint32_t place_of(std::size_t line, const Element& element, std::string_view field, std::size_t above,
                       std::size_t count) {
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), index);
  mc::require(error != std::errc::invalid_argument && end == field.data() + field.size(),
              "line {}: '{}' is not the number of a {}", line, field, element.name);
  mc::require(index >= -static_cast<std::int64_t>(above), "line {}: a face names {} {}, but only {} stand above it",
              line, element.name, field, above);
  mc::require(error == std::errc() && index != 0 && index <= static_cast<std::int64_t>(count),
              "line {}: a face names {} {}, but there are only {}", line, element.name, field, count);
  return static_cast<std::uint32_t>(index > 0 ? index - 1 : static_cast<std::int64_t>(above) + index);
}

/// A corner is v, v/vt, v//vn or v/vt/vn. Trailing slashes are ignored.
Corner corner_of(std::size_t line, std::string_view word, const std::array<std::size_t, elements.size()>& above,
                 const Lines& lines) {
  const std::string_view whole = word;
  while (word.ends_with('/')) word.remove_suffix(1);
  Corner corner = {none, none, none};
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const std::string_view field = word.substr(0, word.find('/'));
    if (k == position || !field.empty())
      corner[k] = place_of(line, elements[k], field, above[k], lines.values[k].size());
    if (field.size() == word.size()) return corner;
    word.remove_prefix(field.size() + 1);
  }
  throw mc::Error(fmt::format("line {}: '{}' is no corner of a face; write v, v/vt, v//vn or v/vt/vn", line, whole));
}

void read_face(std::size_t line, std::string_view rest, const std::array<std::size_t, elements.size()>& above,
               Lines& lines) {
  const std::size_t begin = lines.corners.size();
  for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest))
    lines.corners.push_back(corner_of(line, word, above, lines));
  const auto face = std::span(lines.corners).subspan(begin);
  mc::require(face.size() >= 3, "line {}: a face of {} corners; at least 3 are needed", line, face.size());
  lines.ends.push_back(lines.corners.size());
  for (const Kind kind : {uv, normal}) {
    if (std::all_of(face.begin(), face.end(), [&](const Corner& c) { return c[kind] != none; })) continue;
    if (lines.without[kind] == 0) lines.without[kind] = line;
    for (Corner& corner : face) corner[kind] = none;
  }
}

// Makes room for the faces as if they were triangles.
void reserve(std::size_t faces, Lines& lines) {
  constexpr std::size_t corners = 3, bytes_of_vertex = sizeof(Vec3d) + 64; // 64 of a node of the map in mesh_of
  constexpr std::size_t bytes_of_face =
      corners * (sizeof(Corner) + sizeof(std::uint32_t)) + sizeof(std::size_t) + 2 * sizeof(std::uint32_t);
  const std::size_t vertices = lines.values[position].size();
  mc::require_memory(double(bytes_of_face) * double(faces) + double(bytes_of_vertex) * double(vertices),
                     fmt::format("{} faces of {} vertices", faces, vertices));
  lines.corners.reserve(corners * faces);
  lines.ends.reserve(faces);
  lines.groups.reserve(faces);
  lines.materials.reserve(faces);
}

// Reads the faces last, because they may refer to elements below them.
Lines lines_of(std::string_view text) {
  Lines lines;
  std::size_t faces = 0;
  for_each_line(text, [&](std::size_t line, std::string_view keyword, std::string_view rest) {
    faces += keyword == "f";
    for (std::size_t k = 0; k < elements.size(); ++k)
      if (keyword == elements[k].keyword)
        lines.values[k].push_back(numbers_of(line, elements[k], lines.values[k].size() + 1, rest));
  });
  for (std::size_t k = 0; k < elements.size(); ++k)
    mc::require(lines.values[k].size() < none, "it has {} lines {}; fewer than 2^32 - 1 can be read",
                lines.values[k].size(), elements[k].keyword);
  reserve(faces, lines);
  std::array<std::size_t, elements.size()> above = {};
  std::uint32_t group = 0, material = 0;
  std::map<std::string, std::uint32_t, std::less<>> materials;
  const auto material_of = [&](std::string_view name) {
    const auto [known, is_new] = materials.try_emplace(std::string(name), lines.names.size());
    if (is_new) lines.names.emplace_back(name);
    return known->second;
  };
  for_each_line(text, [&](std::size_t line, std::string_view keyword, std::string_view rest) {
    for (std::size_t k = 0; k < elements.size(); ++k) above[k] += keyword == elements[k].keyword;
    if (keyword == "g" || keyword == "usemtl") ++group;
    if (keyword == "usemtl") material = material_of(rest_of_line(rest));
    if (keyword == "mtllib") lines.material_files.emplace_back(rest_of_line(rest));
    if (keyword != "f") return;
    read_face(line, rest, above, lines);
    lines.groups.push_back(group);
    lines.materials.push_back(material);
  });
  return lines;
}

struct HashOfCorner {
  std::size_t operator()(const Corner& c) const { return mc::hash(c[0], c[1], c[2]); }
};

/// One vertex for each distinct corner. Groups without normals share no vertices, so they are not smoothed together.
MeshFile mesh_of(Lines lines) {
  const bool has_normals = lines.has(normal), has_uvs = lines.without[uv] == 0 && lines.has(uv);
  if (!has_uvs)
    for (Corner& corner : lines.corners) corner[uv] = none;
  if (!has_normals)
    for (std::size_t face = 0, i = 0; face < lines.ends.size(); ++face)
      for (; i < lines.ends[face]; ++i) lines.corners[i][normal] = lines.groups[face];
  const auto value = [&](const Corner& c, Kind kind) -> Vec3d {
    return c[kind] == none ? Vec3d(Vec3d::Zero()) : lines.values[kind][c[kind]];
  };
  MeshFile mesh;
  if (!has_uvs) mesh.missing_uv_reason = fmt::format("the face of line {} has none", lines.without[uv]);
  std::unordered_map<Corner, std::uint32_t, HashOfCorner> known;
  known.reserve(lines.values[position].size());
  const auto vertex = [&](const Corner& corner) {
    const auto [at, added] = known.try_emplace(corner, static_cast<std::uint32_t>(mesh.positions.size()));
    if (!added) return at->second;
    mesh.positions.push_back(value(corner, position));
    if (has_normals) mesh.normals.push_back(value(corner, normal));
    if (!has_uvs) return at->second;
    const Vec3d t = value(corner, uv);
    // v points up in OBJ and down here, as in Mitsuba.
    mesh.uvs.emplace_back(static_cast<float>(t[0]), static_cast<float>(1 - t[1]));
    return at->second;
  };
  mesh.positions.reserve(lines.values[position].size());
  mesh.triangles.reserve(lines.ends.size());
  std::vector<std::uint32_t> face;
  std::size_t begin = 0;
  const bool has_materials = lines.names.size() > 1;
  for (std::size_t i = 0; i < lines.ends.size(); ++i) {
    face.clear();
    for (; begin < lines.ends[i]; ++begin) face.push_back(vertex(lines.corners[begin]));
    append_triangulated(mesh.positions, face, mesh.triangles);
    if (has_materials) mesh.triangle_materials.resize(mesh.triangles.size(), lines.materials[i]);
  }
  if (has_materials) mesh.material_names = std::move(lines.names);
  mesh.material_files = std::move(lines.material_files);
  return mesh;
}

} // namespace

MeshFile read_obj(const std::string& path) {
  const std::string text = with_lines_joined(with_plain_ends(mc::read_text(path)));
  return mc::with_context(path, [&] { return mesh_of(lines_of(text)); });
}

} // namespace render
