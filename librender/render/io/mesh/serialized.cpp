#include <render/io/mesh/mesh.h>

#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/core/memory.h>

#include <zlib.h>

#include <bit>
#include <cstring>
#include <string_view>

namespace render {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint16_t signature = 0x041c;
enum Flag : std::uint32_t { with_normals = 1, with_uvs = 2, with_colors = 8, in_double = 0x2000 };

template <class T> T value_at(std::string_view bytes, std::uint64_t offset) {
  mc::require(offset <= bytes.size() && bytes.size() - offset >= sizeof(T), "the file ends early: no {} bytes at {}",
              sizeof(T), offset);
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

/// Decompresses a zlib stream on demand.
class Unpacked {
 public:
  explicit Unpacked(std::string_view packed) : packed_size_(packed.size()) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream_.avail_in = static_cast<uInt>(packed.size());
    mc::require(packed.size() <= 0xffffffff && inflateInit(&stream_) == Z_OK, "no memory to unpack the mesh");
  }
  ~Unpacked() { inflateEnd(&stream_); }
  Unpacked(const Unpacked&) = delete;
  Unpacked& operator=(const Unpacked&) = delete;

  /// Returns the next numbers.
  ///   throws : Error if the stream is broken or ends early.
  template <class T> std::vector<T> take(std::size_t count) {
    // Deflate expands a byte to at most 1032 bytes.
    mc::require(count <= 1032 * packed_size_ / sizeof(T), "{} numbers of {} bytes do not fit in {} packed bytes", count,
                sizeof(T), packed_size_);
    std::vector<T> values(count);
    fill(reinterpret_cast<Bytef*>(values.data()), count * sizeof(T));
    return values;
  }
  template <class T> T take() { return take<T>(1)[0]; }

 private:
  void fill(Bytef* to, std::size_t size) {
    stream_.next_out = to;
    while (size > 0) {
      const auto part = static_cast<uInt>(std::min<std::size_t>(size, 1u << 30));
      stream_.avail_out = part;
      const int result = inflate(&stream_, Z_SYNC_FLUSH);
      const uInt got = part - stream_.avail_out;
      size -= got;
      mc::require(result == Z_OK || result == Z_STREAM_END || result == Z_BUF_ERROR, "the packed mesh is broken: {}",
                  stream_.msg ? stream_.msg : "zlib cannot unpack it");
      mc::require(got > 0 || size == 0, "the packed mesh ends early");
    }
  }

  std::size_t packed_size_;
  z_stream stream_{};
};

// Offset of a mesh and the number of meshes. The file ends with a table of offsets, followed by the number of meshes.
struct Found {
  std::uint64_t begin, meshes;
};
Found find_mesh(std::string_view bytes, int index) {
  const auto version = value_at<std::uint16_t>(bytes, 2);
  mc::require(value_at<std::uint16_t>(bytes, 0) == signature && (version == 3 || version == 4),
              "not a serialized mesh of version 3 or 4");
  const std::uint64_t size = version == 3 ? 4 : 8, end = bytes.size() - 4;
  const std::uint64_t count = value_at<std::uint32_t>(bytes, end);
  mc::require(count * size <= end, "the file says that it holds {} meshes, which its {} bytes cannot", count,
              bytes.size());
  mc::require(index >= 0 && static_cast<std::uint64_t>(index) < count, "there is no mesh {}; the file holds 0 to {}",
              index, static_cast<std::int64_t>(count) - 1);
  const std::uint64_t place = end - size * (count - static_cast<std::uint64_t>(index));
  return {version == 3 ? value_at<std::uint32_t>(bytes, place) : value_at<std::uint64_t>(bytes, place), count};
}

template <class T> std::vector<Vec3d> triples(const std::vector<T>& numbers) {
  std::vector<Vec3d> result;
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    result.emplace_back(double(numbers[i]), double(numbers[i + 1]), double(numbers[i + 2]));
  return result;
}

template <class T> void read_attributes(Unpacked& data, std::uint32_t flags, std::size_t vertices, MeshFile& mesh) {
  mesh.positions = triples(data.take<T>(3 * vertices));
  if (flags & with_normals) mesh.normals = triples(data.take<T>(3 * vertices));
  if (flags & with_uvs) {
    const auto uvs = data.take<T>(2 * vertices);
    for (std::size_t i = 0; i < vertices; ++i)
      mesh.uvs.emplace_back(static_cast<float>(uvs[2 * i]), static_cast<float>(uvs[2 * i + 1]));
  }
  if (flags & with_colors) data.take<T>(3 * vertices);
}

} // namespace

MeshFile read_serialized(const std::string& path, int index) {
  const std::string file = mc::read_file(path);
  return mc::with_context(fmt::format("{}: mesh {}", path, index), [&] {
    const std::string_view bytes = file;
    mc::require(bytes.size() >= 8, "not a serialized mesh: it has {} bytes", bytes.size());
    const auto [begin, meshes] = find_mesh(bytes, index);
    const auto version = value_at<std::uint16_t>(bytes, begin + 2);
    mc::require(value_at<std::uint16_t>(bytes, begin) == signature && (version == 3 || version == 4),
                "at its place, byte {}, stands no mesh", begin);
    Unpacked data(bytes.substr(begin + 4));
    const auto flags = data.take<std::uint32_t>();
    if (version == 4)
      while (data.take<char>() != 0) {
      } // skips the name
    const auto vertices = data.take<std::uint64_t>(), triangles = data.take<std::uint64_t>();
    mc::require(vertices <= 0xffffffff && triangles <= 0xffffffff, "{} vertices and {} triangles are too many",
                vertices, triangles);
    // Numbers as stored, and as the mesh keeps them.
    const double per_vertex = 3.0 * ((flags & in_double) ? sizeof(double) : sizeof(float)) + 2 * sizeof(Vec3d) + 8;
    mc::require_memory(per_vertex * double(vertices) + 24.0 * double(triangles),
                       fmt::format("{} vertices and {} triangles", vertices, triangles));
    MeshFile mesh;
    mesh.missing_uv_reason = "it has none";
    mesh.meshes = meshes;
    if (flags & in_double) read_attributes<double>(data, flags, vertices, mesh);
    else read_attributes<float>(data, flags, vertices, mesh);
    const auto corners = data.take<std::uint32_t>(3 * triangles);
    for (std::size_t i = 0; i < corners.size(); i += 3)
      mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    require_valid_mesh(mesh);
    return mesh;
  });
}

} // namespace render
