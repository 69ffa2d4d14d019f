#include <render/io/mesh/mesh.h>

#include <mc/core/error.h>
#include <mc/core/file.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <tiny_obj_loader.h>
#pragma GCC diagnostic pop

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>

namespace render {

namespace {

constexpr std::string_view blanks = " \t\r";

/// Calls f(line number, keyword, rest of the line) for every line.
template <class F> void for_each_line(std::string_view text, const F& f) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    line = line.substr(0, line.find('#'));
    const std::string_view keyword = line.substr(0, line.find_first_of(blanks));
    f(number, keyword, line.substr(keyword.size()));
  }
}

struct Element {
  std::string_view keyword, name, axes; ///< axes that must be given
};
constexpr std::array<Element, 3> elements = {
    {{"v", "vertex", "xyz"}, {"vt", "texture coordinate", "u"}, {"vn", "normal", "xyz"}}};
using Counts = std::array<long, elements.size()>;

void check_numbers(std::size_t line, std::size_t kind, long index, std::string_view text) {
  const std::string numbers(text); // ends in 0, as strtod needs
  const char* cursor = numbers.c_str();
  for (const char axis : elements[kind].axes) {
    char* after = nullptr;
    const double value = std::strtod(cursor, &after);
    mc::require(after != cursor, "line {}: {} {} has no number for {}", line, elements[kind].name, index, axis);
    mc::require(std::isfinite(static_cast<float>(value)), "line {}: {} {} has {} = {}, which is not finite", line,
                elements[kind].name, index, axis, value);
    cursor = after;
  }
}

/// A corner is v, v/vt, v//vn or v/vt/vn; negative numbers count from the last element.
void check_corner(std::size_t line, std::string_view corner, const Counts& counts) {
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const std::string_view field = corner.substr(0, corner.find('/'));
    long index = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), index);
    const bool number = error == std::errc() && end == field.data() + field.size();
    mc::require(number || (k > 0 && field.empty()), "line {}: '{}' is not the number of a {}", line, field,
                elements[k].name);
    mc::require(!number || (index != 0 && std::abs(index) <= counts[k]),
                "line {}: a face names {} {}, but there are only {}", line, elements[k].name, index, counts[k]);
    if (field.size() == corner.size()) return;
    corner.remove_prefix(field.size() + 1);
  }
  throw mc::Error(
      fmt::format("line {}: a corner of a face ends in '/{}'; write v, v/vt, v//vn or v/vt/vn", line, corner));
}

// The library reads what is not a number as 0 and leaves out polygons with a bad index: look at the lines first.
void check_lines(std::string_view text) {
  Counts counts{};
  for_each_line(text, [&](std::size_t line, std::string_view keyword, std::string_view rest) {
    for (std::size_t k = 0; k < counts.size(); ++k)
      if (keyword == elements[k].keyword) check_numbers(line, k, ++counts[k], rest);
  });
  for_each_line(text, [&](std::size_t line, std::string_view keyword, std::string_view rest) {
    if (keyword != "f") return;
    int corners = 0;
    for (;; ++corners) {
      rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
      if (rest.empty()) break;
      const std::string_view corner = rest.substr(0, rest.find_first_of(blanks));
      check_corner(line, corner, counts);
      rest.remove_prefix(corner.size());
    }
    mc::require(corners >= 3, "line {}: a face of {} corners; at least 3 are needed", line, corners);
  });
}

// Lines that end in a backslash with the next ones behind them. Their ends follow further down, so that every line
// keeps its number.
std::string with_lines_joined(std::string text) {
  if (text.find('\\') == text.npos) return text;
  std::string joined;
  std::size_t ends = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool carriage_return = text.compare(i, 3, "\\\r\n") == 0;
    if (carriage_return || text.compare(i, 2, "\\\n") == 0) {
      joined += ' ';
      ++ends;
      i += carriage_return ? 2 : 1;
    } else if (text[i] == '\n') {
      joined.append(ends, '\n');
      ends = 1;
    } else {
      joined += text[i];
    }
  }
  return joined;
}

// The file's groups as one mesh, with one vertex for each distinct corner. Normals and texture coordinates count where
// every corner has them.
MeshFile merged(const tinyobj::ObjReader& reader) {
  const tinyobj::attrib_t& attributes = reader.GetAttrib();
  bool has_normals = true, has_uvs = true;
  for (const auto& shape : reader.GetShapes())
    for (const auto& corner : shape.mesh.indices) {
      has_normals &= corner.normal_index >= 0;
      has_uvs &= corner.texcoord_index >= 0;
    }
  // What the library counts is not quite what the lines say: of a keyword without a blank behind it, say.
  const auto place = [](const std::vector<tinyobj::real_t>& v, int index, std::size_t size) {
    const auto j = static_cast<std::size_t>(index) * size;
    mc::require(index >= 0 && j + size <= v.size(), "a face names element {}, but only {} of its kind could be read",
                index + 1, v.size() / size);
    return j;
  };
  const auto triple = [&](const std::vector<tinyobj::real_t>& v, int index) {
    const std::size_t j = place(v, index, 3);
    return Vec3d(double(v[j]), double(v[j + 1]), double(v[j + 2]));
  };
  MeshFile mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;
  for (const auto& shape : reader.GetShapes())
    for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3) {
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& corner = shape.mesh.indices[i + k];
        const std::array key{corner.vertex_index, has_normals ? corner.normal_index : -1,
                             has_uvs ? corner.texcoord_index : -1};
        const auto [it, added] = known.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
        triangle[k] = it->second;
        if (!added) continue;
        mesh.positions.push_back(triple(attributes.vertices, key[0]));
        if (has_normals) mesh.normals.push_back(triple(attributes.normals, key[1]));
        if (!has_uvs) continue;
        const std::size_t t = place(attributes.texcoords, key[2], 2);
        mesh.uvs.emplace_back(attributes.texcoords[t],
                              1 - attributes.texcoords[t + 1]); // up there, down here, as Mitsuba
      }
      mesh.triangles.push_back(triangle);
    }
  return mesh;
}

} // namespace

MeshFile read_obj(const std::string& path) {
  const std::string text = with_lines_joined(mc::read_file(path));
  return mc::with_context(path, [&] {
    check_lines(text);
    tinyobj::ObjReader reader;
    tinyobj::ObjReaderConfig config;
    config.triangulate = true;
    const bool parsed = reader.ParseFromString(text, "", config);
    std::string problem = reader.Error();
    while (!problem.empty() && std::isspace(static_cast<unsigned char>(problem.back()))) problem.pop_back();
    mc::require(parsed, "broken OBJ: {}", problem.empty() ? "unreadable" : problem);
    return merged(reader);
  });
}

} // namespace render
