#include <render/io/mesh/mesh.h>
#include <render/io/mesh/polygon.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>
#include <mc/core/text.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

namespace render {

namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };
struct TypeRow {
  std::string_view name, other_name;
  Type type;
  std::size_t size;
};
constexpr std::array<TypeRow, 8> types = {{{"char", "int8", Type::i8, 1},
                                           {"uchar", "uint8", Type::u8, 1},
                                           {"short", "int16", Type::i16, 2},
                                           {"ushort", "uint16", Type::u16, 2},
                                           {"int", "int32", Type::i32, 4},
                                           {"uint", "uint32", Type::u32, 4},
                                           {"float", "float32", Type::f32, 4},
                                           {"double", "float64", Type::f64, 8}}};

struct Property {
  std::string name;
  TypeRow type;
  std::optional<TypeRow> count; ///< type of the length, for a list
};
struct Element {
  std::string name;
  std::size_t rows = 0;
  std::vector<Property> properties;

  std::optional<std::size_t> column(std::initializer_list<std::string_view> names, bool list) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (properties[i].count.has_value() == list &&
          std::find(names.begin(), names.end(), properties[i].name) != names.end())
        return i;
    return {};
  }
};
struct Header {
  bool ascii = true, swap = false;
  std::vector<Element> elements;
};

template <class T> T swapped(T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

/// Reads the numbers in the body of a file in sequence.
class Numbers {
 public:
  Numbers(std::string_view bytes, const Header& header) : rest_(bytes), ascii_(header.ascii), swap_(header.swap) {}

  std::size_t bytes_left() const { return rest_.size(); }
  /// Smallest number of bytes that a number takes.
  std::size_t least_size(const TypeRow& type) const { return ascii_ ? 2 : type.size; } // a digit and a blank

  double next(const TypeRow& type) {
    if (ascii_) return word();
    switch (type.type) {
    case Type::i8: return take<std::int8_t>();
    case Type::u8: return take<std::uint8_t>();
    case Type::i16: return take<std::int16_t>();
    case Type::u16: return take<std::uint16_t>();
    case Type::i32: return take<std::int32_t>();
    case Type::u32: return take<std::uint32_t>();
    case Type::f32: return double(take<float>());
    case Type::f64: return take<double>();
    }
    return 0;
  }

 private:
  template <class T> T take() {
    mc::require(rest_.size() >= sizeof(T), "the file ends early; copy it whole");
    T value;
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    return swap_ ? swapped(value) : value;
  }
  double word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
    mc::require(!rest_.empty(), "the file ends early; copy it whole");
    const std::string_view text = rest_.substr(0, rest_.find_first_of(" \t\r\n"));
    const std::optional<double> value = mc::parse_double(text);
    mc::require(value.has_value(), "'{}' is not a number", text);
    rest_.remove_prefix(text.size());
    return *value;
  }

  std::string_view rest_;
  bool ascii_, swap_;
};

TypeRow type_of(const std::string& name, std::size_t line) {
  for (const TypeRow& row : types)
    if (row.name == name || row.other_name == name) return row;
  throw mc::Error(fmt::format("line {}: '{}' is no type of a number", line, name));
}

/// Reads the header and removes it from `bytes`.
Header read_header(std::string_view& bytes) {
  Header header;
  bool has_format = false;
  for (std::size_t line = 1;; ++line) {
    const std::size_t end = bytes.find('\n');
    mc::require(end != std::string_view::npos, "not a PLY file: line {} does not end, and no end_header came before",
                line);
    std::istringstream words{std::string(bytes.substr(0, end))};
    bytes.remove_prefix(end + 1);
    std::string keyword, name, type;
    words >> keyword;
    mc::require(line > 1 || keyword == "ply", "not a PLY file: it does not begin with ply");
    if (keyword == "end_header") break;
    if (keyword == "format") {
      words >> name;
      header.ascii = name == "ascii";
      header.swap = name == "binary_big_endian";
      mc::require(header.ascii || header.swap || name == "binary_little_endian", "line {}: unknown format '{}'", line,
                  name);
      has_format = true;
    } else if (keyword == "element") {
      Element element;
      std::string rows; // stream input would read -3 as 2^64 - 3
      mc::require(bool(words >> element.name >> rows), "line {}: an element needs a name and a number", line);
      const auto [rest, error] = std::from_chars(rows.data(), rows.data() + rows.size(), element.rows);
      mc::require(error == std::errc() && rest == rows.data() + rows.size(),
                  "line {}: '{}' rows of {}; give a whole number from 0 up, of at most 64 bits", line, rows,
                  element.name);
      header.elements.push_back(element);
    } else if (keyword == "property") {
      mc::require(!header.elements.empty(), "line {}: a property before the first element", line);
      std::optional<TypeRow> count;
      words >> type;
      if (type == "list") {
        words >> type;
        count = type_of(type, line);
        words >> type;
      }
      mc::require(bool(words >> name), "line {}: a property needs a type and a name", line);
      header.elements.back().properties.push_back({name, type_of(type, line), count});
    }
  }
  mc::require(has_format, "not a PLY file: it states no format");
  return header;
}

std::size_t list_length(double value) {
  mc::require(value >= 0 && value <= 0xffffffff && value == std::floor(value),
              "a list of {} numbers; a length is a whole number from 0 up", value);
  return static_cast<std::size_t>(value);
}

/// Reads an element row by row: the numbers of a row by their position, and the one list `wanted`.
class Rows {
 public:
  Rows(const Element& element, Numbers& numbers, std::optional<std::size_t> wanted)
      : element_(element), numbers_(numbers), list_(wanted) {
    std::size_t least = 0;
    for (const Property& p : element.properties) least += numbers.least_size(p.count ? *p.count : p.type);
    // The last number of a text file needs no blank.
    mc::require(element.rows == 0 || (least > 0 && element.rows <= (numbers.bytes_left() + 1) / least),
                "{} rows of {} do not fit in the {} bytes that follow", element.rows, element.name,
                numbers.bytes_left());
    values.resize(element.properties.size());
  }
  void next() {
    try {
      read();
    } catch (const mc::Error& e) { // with_context would format the name of every row in advance
      throw mc::Error(fmt::format("{} {}: {}", element_.name, row_, e.what()));
    }
    ++row_;
  }

  std::vector<double> values, list;

 private:
  void read() {
    for (std::size_t i = 0; i < element_.properties.size(); ++i) {
      const Property& p = element_.properties[i];
      if (!p.count) {
        values[i] = numbers_.next(p.type);
        continue;
      }
      const std::size_t n = list_length(numbers_.next(*p.count));
      if (list_ == i) list.clear();
      for (std::size_t k = 0; k < n; ++k) {
        const double value = numbers_.next(p.type);
        if (list_ == i) list.push_back(value);
      }
    }
  }

  const Element& element_;
  Numbers& numbers_;
  std::optional<std::size_t> list_;
  std::size_t row_ = 0;
};

void read_vertices(const Element& element, Numbers& numbers, MeshFile& mesh) {
  const auto number = [&](std::initializer_list<std::string_view> names) { return element.column(names, false); };
  const auto x = number({"x"}), y = number({"y"}), z = number({"z"});
  const auto nx = number({"nx"}), ny = number({"ny"}), nz = number({"nz"});
  const auto s = number({"u", "s", "texture_u"}), t = number({"v", "t", "texture_v"});
  mc::require(x && y && z, "vertices need x, y and z");
  Rows rows(element, numbers, {});
  const bool has_normals = nx && ny && nz, has_uvs = s && t;
  const std::size_t bytes = (has_normals ? 2 : 1) * sizeof(Vec3d) + (has_uvs ? sizeof(mc::Vec2<float>) : 0);
  mc::require_memory(double(bytes) * double(element.rows), fmt::format("{} vertices", element.rows));
  mesh.positions.reserve(element.rows);
  if (has_normals) mesh.normals.reserve(element.rows);
  if (has_uvs) mesh.uvs.reserve(element.rows);
  for (std::size_t i = 0; i < element.rows; ++i) {
    rows.next();
    const auto at = [&](const std::optional<std::size_t>& column) { return rows.values[*column]; };
    const Vec3d p(at(x), at(y), at(z));
    mc::require(p.allFinite(), "vertex {} = ({}, {}, {}) is not finite", i, p[0], p[1], p[2]);
    mesh.positions.push_back(p);
    if (has_normals) mesh.normals.emplace_back(at(nx), at(ny), at(nz));
    if (has_uvs) mesh.uvs.emplace_back(static_cast<float>(at(s)), static_cast<float>(at(t)));
  }
}

/// The corners of all faces, and the end of each face among them.
struct Faces {
  std::vector<std::uint32_t> corners;
  std::vector<std::size_t> ends;
};

void read_faces(const Element& element, Numbers& numbers, std::size_t vertices, Faces& faces) {
  const auto list = element.column({"vertex_indices", "vertex_index"}, true);
  mc::require(list.has_value(), "faces need a list vertex_indices");
  Rows rows(element, numbers, list);
  constexpr std::size_t corners = 3, bytes = 2 * corners * sizeof(std::uint32_t) + sizeof(std::size_t); // of a triangle
  mc::require_memory(double(bytes) * double(element.rows), fmt::format("{} faces", element.rows));
  faces.corners.reserve(corners * element.rows);
  faces.ends.reserve(element.rows);
  for (std::size_t i = 0; i < element.rows; ++i) {
    rows.next();
    mc::require(rows.list.size() >= 3, "face {} has {} corners; at least 3 are needed", i, rows.list.size());
    for (const double corner : rows.list) {
      mc::require(corner >= 0 && corner < double(vertices) && corner == std::floor(corner),
                  "face {} names vertex {}, but there are only 0 to {}", i, corner, double(vertices) - 1);
      faces.corners.push_back(static_cast<std::uint32_t>(corner));
    }
    faces.ends.push_back(faces.corners.size());
  }
}

// Reads strips: every three consecutive vertices are a triangle, every other one of the opposite orientation. -1 ends a
// strip. Triangles that name a vertex twice join strips and are not seen.
void read_strips(const Element& element, Numbers& numbers, std::size_t vertices, Faces& faces) {
  const auto list = element.column({"vertex_indices", "vertex_index"}, true);
  mc::require(list.has_value(), "tristrips need a list vertex_indices");
  Rows rows(element, numbers, list);
  for (std::size_t i = 0; i < element.rows; ++i) {
    rows.next();
    constexpr std::size_t bytes = 2 * 3 * sizeof(std::uint32_t) + sizeof(std::size_t); // of a triangle
    mc::require_memory(double(bytes) * double(rows.list.size()), fmt::format("{} corners of strips", rows.list.size()));
    std::array<std::uint32_t, 2> before{};
    std::size_t length = 0; // of the strip so far
    for (const double corner : rows.list) {
      if (corner == -1) {
        length = 0;
        continue;
      }
      mc::require(corner >= 0 && corner < double(vertices) && corner == std::floor(corner),
                  "strip {} names vertex {}, but there are only 0 to {}; -1 ends a strip", i, corner,
                  double(vertices) - 1);
      const auto c = static_cast<std::uint32_t>(corner);
      const auto [a, b] = before;
      if (length >= 2 && a != b && b != c && a != c) {
        const bool is_turned = length % 2 == 1;
        faces.corners.insert(faces.corners.end(), {is_turned ? b : a, is_turned ? a : b, c});
        faces.ends.push_back(faces.corners.size());
      }
      before = {b, c};
      ++length;
    }
  }
}

void require_faces(const Header& header) {
  std::vector<std::string> elements;
  for (const Element& e : header.elements) {
    if ((e.name == "face" || e.name == "tristrips") && e.rows > 0) return;
    if (e.rows > 0) elements.push_back(fmt::format("{} of '{}'", e.rows, e.name));
  }
  throw mc::Error(fmt::format("it has no faces but {}, and faces alone are seen; convert the file to faces",
                              fmt::join(elements, ", ")));
}

MeshFile mesh_of(std::string_view bytes) {
  const Header header = read_header(bytes);
  const auto vertex =
      std::find_if(header.elements.begin(), header.elements.end(), [](const Element& e) { return e.name == "vertex"; });
  mc::require(vertex != header.elements.end(), "the file has no element vertex");
  require_faces(header);
  MeshFile mesh;
  mesh.missing_uv_reason = "its vertices have no u and v";
  Faces faces; // faces may precede the vertices
  Numbers numbers(bytes, header);
  for (const Element& element : header.elements) {
    if (element.name == "vertex") read_vertices(element, numbers, mesh);
    else if (element.name == "face") read_faces(element, numbers, vertex->rows, faces);
    else if (element.name == "tristrips") read_strips(element, numbers, vertex->rows, faces);
    else {
      Rows rows(element, numbers, {});
      for (std::size_t i = 0; i < element.rows; ++i) rows.next();
    }
  }
  mc::require(mesh.positions.size() == vertex->rows, "a second element vertex");
  mesh.triangles.reserve(faces.ends.size());
  std::size_t begin = 0;
  for (const std::size_t end : faces.ends) {
    append_triangulated(mesh.positions, std::span(faces.corners).subspan(begin, end - begin), mesh.triangles);
    begin = end;
  }
  require_valid_mesh(mesh);
  return mesh;
}

} // namespace

MeshFile read_ply(const std::string& path) {
  const std::string file = mc::read_text(path);
  return mc::with_context(path, [&] { return mesh_of(file); });
}

} // namespace render
