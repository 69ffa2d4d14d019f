#include <render/io/mesh/mesh.h>
#include <render/io/mesh/mesh_scene.h>

#include <mc/core/file.h>
#include <mc/random/pcg.h>

#include "support/files.h"

namespace {

using namespace render;
using testing::AllOf, testing::HasSubstr;

struct Mesh : support::ScratchTest {
  template <class Read>
  void expect_refusals_when_truncated(const std::string& name, const std::string& bytes, const Read& read) const {
    int refused = 0;
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      const std::string file = write(name, bytes.substr(0, n));
      const std::string said = support::error_of([&] { to_shape(read(file), {}); });
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
      refused += !said.empty();
    }
    EXPECT_GE(refused, static_cast<int>(bytes.size()) - 4) << "only the last number of a text may be cut";
  }
};

template <class T> std::string raw(const std::vector<T>& values, bool swap = false) {
  std::string bytes;
  for (const T& value : values) {
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    bytes += swap ? std::string(one.rbegin(), one.rend()) : one;
  }
  return bytes;
}

TEST_F(Mesh, ToShapeMovesPointsAndNormals) {
  MeshFile file;
  file.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  file.normals = {{0, 0, 2}, {0, 0, 2}, {1, 0, 1}};
  file.triangles = {{0, 1, 2}};
  const Transform mirrored = Transform::translate({0, 0, 5}) * Transform::scale({-2, 1, 1});
  const TriangleMesh mesh = to_shape(file, mirrored);
  EXPECT_DOUBLE_EQ(mesh.area(), 1);
  const SurfacePoint corner = mesh.point(0, 1, 0); // vertex 1 of the reoriented triangle: (0, 1, 0)
  EXPECT_EQ(corner.ng, Vec3(0, 0, 1)) << "a mirroring transform keeps the normal on its side";
  EXPECT_LE((corner.ns - Vec3(-0.5, 0, 1).normalized()).norm(), 1e-6);
  EXPECT_EQ(to_shape(file, mirrored, true).point(0, 1, 0).ns, Vec3(0, 0, 1));
}

// A box with eight shared corners and randomly chosen diagonals. The normal of every corner has equal angles with its
// three sides, mirrored or not. Normals of the file take precedence, and a flat mesh has none.
TEST_F(Mesh, MissingNormalsAreSmooth) {
  mc::Pcg random(4);
  for (int trial = 0; trial < 50; ++trial) {
    MeshFile file;
    for (int i = 0; i < 8; ++i) file.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    for (const auto& q : std::vector<std::array<std::uint32_t, 4>>{
             {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
      const std::size_t s = random.uniform<double>() < 0.5 ? 0 : 1;
      file.triangles.push_back({q[s], q[s + 1], q[s + 2]});
      file.triangles.push_back({q[s], q[s + 2], q[(s + 3) % 4]});
    }
    const Vec3d size(trial % 2 == 0 ? 1 : -1, 2, 3);
    const TriangleMesh mesh = to_shape(file, Transform::translate({5, 6, 7}) * Transform::scale(size));
    for (std::size_t t = 0; t < mesh.size(); ++t)
      for (const auto& [b1, b2] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1)}) {
        const SurfacePoint corner = mesh.point(t, b1, b2);
        const Vec3 signs = (corner.p - Vec3(5, 6, 7)).array().sign();
        EXPECT_LE((corner.ns - signs / std::sqrt(Float(3))).norm(), 1e-6);
      }
    EXPECT_EQ(to_shape(file, {}, true).point(0, 0, 0).ns, Vec3(-1, 0, 0));
  }
}

// PLY: the same pyramid in every format.

struct PlyCase {
  const char* format;
  bool ascii, swap;
};
std::string pyramid(const PlyCase& c) {
  std::string file =
      std::string("ply\nformat ") + c.format +
      " 1.0\ncomment made by hand\nelement vertex 4\n"
      "property float x\nproperty double y\nproperty float z\nproperty uchar red\nproperty float s\nproperty float t\n"
      "element face 2\nproperty list uchar int vertex_indices\nproperty float quality\nend_header\n";
  for (int i = 0; i < 4; ++i) {
    const float x = i == 1, z = i == 3, s = 0.25f * float(i), t = 0.5f;
    const double y = i == 2;
    if (c.ascii) file += fmt::format("{} {} {} 7 {} {}\n", x, y, z, s, t);
    else
      file += raw<float>({x}, c.swap) + raw<double>({y}, c.swap) + raw<float>({z}, c.swap) + "\7" +
              raw<float>({s, t}, c.swap);
  }
  if (c.ascii) return file + "3 0 1 2 1.5\n4 0 3 2 1 1.5\n";
  file += "\3" + raw<std::int32_t>({0, 1, 2}, c.swap) + raw<float>({1.5f}, c.swap);
  return file + "\4" + raw<std::int32_t>({0, 3, 2, 1}, c.swap) + raw<float>({1.5f}, c.swap);
}
const PlyCase ply_cases[] = {
    {"ascii", true, false}, {"binary_little_endian", false, false}, {"binary_big_endian", false, true}};

// Two faces that meet at 40 degrees along y, each with its own corners and normals. Stretching along z changes the
// angle.
TEST_F(Mesh, EdgesAreKeptFromAnAngleOn) {
  const double slope = 40 * mc::pi<double> / 180;
  MeshFile roof;
  roof.positions = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 0}, {std::cos(slope), 0, -std::sin(slope)}, {0, 1, 0}};
  roof.normals.assign(6, Vec3d(1, 0, 1));
  roof.uvs.assign(6, {0.5f, 0.5f});
  roof.triangles = {{0, 1, 2}, {3, 4, 5}};
  const auto bend = [&](double most, const Transform& to_world) {
    const MeshFile split = split_at_edges(roof, to_world, most);
    const TriangleMesh mesh = to_shape(split, to_world);
    EXPECT_EQ(split.uvs.size(), split.positions.size());
    const Vec3 left = mesh.point(0, 1, 0).ns, right = mesh.point(1, 0, 0).ns; // at (0, 0, 0)
    EXPECT_EQ(split.positions.size(), left == right ? 4u : 6u);
    return std::acos(std::min(1.0, double(left.dot(right)))) * 180 / mc::pi<double>;
  };
  EXPECT_NEAR(bend(39.9, {}), 40, 1e-3);
  EXPECT_NEAR(bend(40.1, {}), 0, 1e-3);
  EXPECT_NEAR(bend(0, {}), 40, 1e-3);
  const Transform stretched = Transform::scale({1, 1, 2});
  const double steep = std::atan(2 * std::tan(slope)) * 180 / mc::pi<double>;
  EXPECT_NEAR(bend(steep - 0.1, stretched), steep, 1e-3);
  EXPECT_NEAR(bend(steep + 0.1, stretched), 0, 1e-3);
  for (const double wrong : {-1.0, 180.5, std::nan("")})
    EXPECT_THAT(support::error_of([&] { split_at_edges(roof, {}, wrong); }), HasSubstr("must lie in [0, 180] degrees"));
}

TEST_F(Mesh, PlyInEveryFormat) {
  for (const PlyCase& c : ply_cases) {
    const MeshFile file = read_ply(write("p.ply", pyramid(c)));
    ASSERT_EQ(file.positions.size(), 4u) << c.format;
    EXPECT_EQ(file.positions[2], Vec3d(0, 1, 0));
    EXPECT_EQ(file.positions[3], Vec3d(0, 0, 1));
    EXPECT_EQ(file.uvs[3], mc::Vec2<float>(0.75f, 0.5f));
    EXPECT_TRUE(file.normals.empty());
    const std::vector<std::array<std::uint32_t, 3>> expected = {{0, 1, 2}, {0, 3, 2}, {0, 2, 1}};
    EXPECT_EQ(file.triangles, expected) << c.format;
  }
}

// A concave outline, starting at any corner. Also a UTF-8 byte order mark, and faces before vertices.
TEST_F(Mesh, PlyConcavePolygons) {
  const std::vector<std::string> hexagon = {"0 0 0\n", "2 0 0\n", "2 1 0\n", "1 1 0\n", "1 2 0\n", "0 2 0\n"};
  for (std::size_t first = 0; first < hexagon.size(); ++first) {
    std::string face = "6", vertices;
    for (std::size_t i = 0; i < hexagon.size(); ++i) {
      face += fmt::format(" {}", (first + i) % hexagon.size());
      vertices += hexagon[i];
    }
    const MeshFile file = read_ply(
        write("l.ply", fmt::format("\xEF\xBB\xBFply\nformat ascii 1.0\nelement face 1\n"
                                   "property list uchar int vertex_indices\nelement vertex 6\nproperty float x\n"
                                   "property float y\nproperty float z\nend_header\n{}\n{}",
                                   face, vertices)));
    EXPECT_EQ(file.triangles.size(), 4u);
    EXPECT_DOUBLE_EQ(to_shape(file, {}).area(), 3) << first;
  }
}

// Two strips in one list, a pair of twice named vertices that joins strips, and a second list.
TEST_F(Mesh, PlyTriangleStrips) {
  const auto strips = [&](const std::string& lists, int count) {
    return write("s.ply", fmt::format("ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
                                      "property float z\nelement tristrips {}\nproperty list int int vertex_indices\n"
                                      "end_header\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n{}\n",
                                      count, lists));
  };
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  EXPECT_EQ(read_ply(strips("6 0 1 2 3 4 5", 1)).triangles, (Triangles{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}}));
  EXPECT_DOUBLE_EQ(to_shape(read_ply(strips("6 0 1 2 3 4 5", 1)), {}).area(), 2) << "of one orientation";
  EXPECT_EQ(read_ply(strips("7 0 1 2 -1 2 3 4\n3 5 4 3", 2)).triangles, (Triangles{{0, 1, 2}, {2, 3, 4}, {5, 4, 3}}));
  EXPECT_EQ(read_ply(strips("8 0 1 2 2 3 3 4 5", 1)).triangles, (Triangles{{0, 1, 2}, {4, 3, 5}})) << "the sixth turns";
  const auto said = [&](const std::string& lists, int count) {
    return support::error_of([&] { to_shape(read_ply(strips(lists, count)), {}); });
  };
  EXPECT_THAT(said("3 0 1 6", 1),
              HasSubstr("s.ply: strip 0 names vertex 6, but there are only 0 to 5; -1 ends a strip"));
  EXPECT_THAT(said("3 0 1 -2", 1), HasSubstr("strip 0 names vertex -2"));
  EXPECT_THAT(said("2 0 1", 1), HasSubstr("no triangle"));
  EXPECT_THAT(said("3 0 1", 1), HasSubstr("s.ply: tristrips 0: the file ends early"));
}

TEST_F(Mesh, PlyTruncatedAtAnyByte) {
  for (const PlyCase& c : ply_cases) expect_refusals_when_truncated("t.ply", pyramid(c), read_ply);
}

TEST_F(Mesh, PlyRefusesWithFileAndPlace) {
  const auto refusal = [&](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    const std::string file = write("bad.ply", text);
    return support::error_of([&] { read_ply(file); });
  };
  const std::string text = pyramid(ply_cases[0]), binary = pyramid(ply_cases[1]);
  EXPECT_THAT(
      refusal(text, "vertex 4", "vertex 4000000000000"),
      AllOf(HasSubstr("bad.ply: 4000000000000 rows of vertex do not fit in the"), HasSubstr("bytes that follow")));
  EXPECT_THAT(refusal(binary, "face 2", "face 18446744073709551615"), HasSubstr("rows of face do not fit"));
  for (const std::string count : {"-4", "4.5", "99999999999999999999", "four"})
    EXPECT_THAT(refusal(text, "vertex 4", "vertex " + count),
                HasSubstr("bad.ply: line 4: '" + count + "' rows of vertex; give a whole number from 0 up"));
  EXPECT_THAT(refusal(text, "vertex 4", "vertex"), HasSubstr("bad.ply: line 4: an element needs a name and a number"));
  EXPECT_THAT(refusal(text, "3 0 1 2", "3 0 1 4"), HasSubstr("face 0 names vertex 4, but there are only 0 to 3"));
  EXPECT_THAT(refusal(text, "3 0 1 2", "3 0 1 -1"), HasSubstr("face 0 names vertex -1"));
  EXPECT_THAT(refusal(text, "3 0 1 2", "3 0 1 nan"), HasSubstr("face 0 names vertex nan"));
  EXPECT_THAT(refusal(text, "3 0 1 2", "2 0 1 2"), HasSubstr("face 0 has 2 corners"));
  EXPECT_THAT(refusal(text, "1 0 0", "1 nan 0"), HasSubstr("vertex 1 = (1, nan, 0) is not finite"));
  EXPECT_THAT(refusal(text, "1 0 0", "1 one 0"), HasSubstr("bad.ply: vertex 1: 'one' is not a number"));
  EXPECT_THAT(refusal(text, "3 0 1 2", "-3 0 1 2"),
              HasSubstr("bad.ply: face 0: a list of -3 numbers; a length is a whole number from 0 up"));
  EXPECT_THAT(refusal(text, "3 0 1 2", "300 0 1 2"), HasSubstr("bad.ply: face 0: the file ends early; copy it whole"));
  EXPECT_THAT(refusal(text, "property float z", "property float w"), HasSubstr("vertices need x, y and z"));
  EXPECT_THAT(refusal(text, "property float z", "property flat z"), HasSubstr("line 7: 'flat' is no type"));
  EXPECT_THAT(refusal(text, "ascii", "ebcdic"), HasSubstr("line 2: unknown format 'ebcdic'"));
  EXPECT_THAT(refusal(text, "vertex_indices", "edges"), HasSubstr("faces need a list vertex_indices"));
  EXPECT_THAT(refusal(text, "ply", "plx"), HasSubstr("not a PLY file"));
  EXPECT_THAT(refusal(text, "face 2", "edge 2"),
              HasSubstr("bad.ply: it has no faces but 4 of 'vertex', 2 of 'edge', and faces alone are seen"));
  EXPECT_THAT(refusal(text, "face 2", "face 0"), HasSubstr("it has no faces but 4 of 'vertex', and"));
}

// The serialized format of Mitsuba.

// A zlib stream with one stored block (RFC 1950 and 1951).
std::string packed(const std::string& bytes) {
  const auto size = static_cast<std::uint16_t>(bytes.size());
  std::uint32_t a = 1, b = 0; // Adler-32 checksum
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return "\x78\x01\x01" + raw<std::uint16_t>({size, static_cast<std::uint16_t>(~size)}) + bytes +
         raw<std::uint32_t>({b << 16 | a}, true);
}

struct SerializedMesh {
  std::uint16_t version = 4;
  bool in_double = false;
  std::uint64_t vertices = 3, triangles = 1;
  std::vector<std::uint32_t> corners = {0, 1, 2};
  double height = 1;
  std::uint32_t flag = 0; ///< one additional flag

  template <class T> std::string body(std::uint32_t flags) const {
    std::string bytes = raw<std::uint32_t>({flags});
    if (version == 4) bytes += std::string("name\0", 5);
    bytes += raw<std::uint64_t>({vertices, triangles});
    bytes += raw<T>({0, 0, 0, 1, 0, 0, 0, static_cast<T>(height), 0});
    bytes += raw<T>({0, 0, 1, 0, 0, 1, 0, 0, 1});
    bytes += raw<T>({0, 0, 1, 0, 0.5, 1});
    bytes += raw<T>({1, 1, 1, 1, 1, 1, 1, 1, 1});
    return bytes + raw(corners);
  }
  std::string part() const {
    const std::string inside = in_double ? body<double>(0x200b | flag) : body<float>(0x100b | flag);
    return raw<std::uint16_t>({0x041c, version}) + packed(inside);
  }
};
std::string serialized(const std::vector<SerializedMesh>& meshes) {
  std::string file;
  std::vector<std::uint64_t> offsets;
  for (const SerializedMesh& m : meshes) {
    offsets.push_back(file.size());
    file += m.part();
  }
  for (const std::uint64_t offset : offsets)
    file += meshes[0].version == 4 ? raw<std::uint64_t>({offset})
                                   : raw<std::uint32_t>({static_cast<std::uint32_t>(offset)});
  return file + raw<std::uint32_t>({static_cast<std::uint32_t>(meshes.size())});
}

// Mitsuba ignores the flag of flat faces if there are normals.
TEST_F(Mesh, SerializedNormalsCountWhateverTheFlagOfFlatFaces) {
  SerializedMesh mesh;
  mesh.flag = 0x10;
  const MeshFile read = read_serialized(write("m.serialized", serialized({mesh})), 0);
  ASSERT_EQ(read.normals.size(), 3u);
  EXPECT_EQ(read.normals[1], Vec3d(0, 0, 1));
}

TEST_F(Mesh, SerializedVersionsPrecisionsAndIndices) {
  for (const std::uint16_t version : {3, 4})
    for (const bool in_double : {false, true}) {
      SerializedMesh first{version, in_double}, second{version, in_double};
      second.height = 3;
      const std::string file = write("m.serialized", serialized({first, second}));
      const MeshFile mesh = read_serialized(file, 1);
      EXPECT_EQ(mesh.positions[2], Vec3d(0, 3, 0)) << version << in_double;
      EXPECT_EQ(mesh.meshes, 2u);
      EXPECT_EQ(read_mesh_scene(file).warnings.size(), 1u);
      EXPECT_THAT(read_mesh_scene(file).warnings[0], HasSubstr("m.serialized: this is mesh 0 of the 2 in it"));
      EXPECT_TRUE(read_mesh_scene(write("one.serialized", serialized({first}))).warnings.empty());
      EXPECT_EQ(mesh.normals[1], Vec3d(0, 0, 1));
      EXPECT_EQ(mesh.uvs[2], mc::Vec2<float>(0.5f, 1));
      EXPECT_EQ(read_serialized(file, 0).positions[2], Vec3d(0, 1, 0));
      EXPECT_THAT(support::error_of([&] { read_serialized(file, 2); }),
                  HasSubstr("mesh 2: there is no mesh 2; the file holds 0 to 1"));
      EXPECT_THAT(support::error_of([&] { read_serialized(file, -1); }), HasSubstr("there is no mesh -1"));
    }
}

TEST_F(Mesh, SerializedTruncatedAtAnyByte) {
  const std::string whole = serialized({SerializedMesh{}});
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const std::string file = write("t.serialized", whole.substr(0, n));
    const std::string said = support::error_of([&] { read_serialized(file, 0); });
    EXPECT_THAT(said, HasSubstr("t.serialized: mesh 0: ")) << n;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
}

TEST_F(Mesh, SerializedCountsThatItsBytesCannotHold) {
  for (const std::uint64_t huge : {std::uint64_t{1} << 31, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    SerializedMesh vertices, triangles;
    vertices.vertices = huge;
    triangles.triangles = huge;
    for (const SerializedMesh& m : {vertices, triangles}) {
      const std::string file = write("huge.serialized", serialized({m}));
      EXPECT_NE(support::error_of([&] { read_serialized(file, 0); }), "") << huge;
    }
  }
  SerializedMesh outside;
  outside.corners = {0, 1, 3};
  const std::string file = write("bad.serialized", serialized({outside}));
  EXPECT_THAT(support::error_of([&] { to_shape(read_serialized(file, 0), {}); }),
              HasSubstr("names vertex 3, but there are only 3"));
  std::string many = serialized({SerializedMesh{}});
  many.replace(many.size() - 4, 4, raw<std::uint32_t>({0xffffffff}));
  const std::string counted = write("many.serialized", many);
  EXPECT_THAT(support::error_of([&] { read_serialized(counted, 0); }),
              HasSubstr("says that it holds 4294967295 meshes"));
}

// Files with random bytes changed are read, or rejected with a one-line error.
TEST_F(Mesh, SerializedRefusesWhatIsNotSound) {
  SerializedMesh beyond, high;
  beyond.corners = {0, 1, 9};
  high.height = mc::infinity<double>;
  const auto refusal_of = [&](const SerializedMesh& mesh) {
    return support::error_of([&] { read_serialized(write("m.serialized", serialized({mesh})), 0); });
  };
  EXPECT_THAT(refusal_of(beyond), HasSubstr("m.serialized: mesh 0: triangle 0 names vertex 9, but there are only 3"));
  EXPECT_THAT(refusal_of(high), HasSubstr("m.serialized: mesh 0: vertex 2 = (0, inf, 0) is not finite"));
  MeshFile bent;
  bent.normals = {Vec3d(0, mc::infinity<double>, 0)};
  EXPECT_THAT(support::error_of([&] { require_valid_mesh(bent); }), HasSubstr("normal 0 = (0, inf, 0) is not finite"));
}

TEST_F(Mesh, DamagedAnywhere) {
  mc::Pcg random(9);
  const std::vector<std::pair<std::string, MeshFile (*)(const std::string&)>> formats = {
      {pyramid(ply_cases[0]), read_ply},
      {pyramid(ply_cases[1]), read_ply},
      {pyramid(ply_cases[2]), read_ply},
      {serialized({SerializedMesh{}}), [](const std::string& p) { return read_serialized(p, 0); }},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n", read_obj}};
  for (const auto& format : formats)
    for (int trial = 0; trial < 400; ++trial) {
      std::string bytes = format.first;
      for (int k = 0; k < 1 + trial % 3; ++k)
        bytes[static_cast<std::size_t>(random.uniform<double>() * double(bytes.size()))] =
            static_cast<char>(random.uniform<double>() * 256);
      const std::string file = write("damaged", bytes);
      const std::string said = support::error_of([&] { to_shape(format.second(file), {}); });
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
}

// Normals that deviate by a thousandth visibly bend a mirror and are kept. Normals that differ by the rounding of files
// are not.
TEST_F(Mesh, SlightlyBentNormalsCount) {
  MeshFile file;
  file.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  file.triangles = {{0, 1, 2}};
  for (const double lean : {1e-3, 1e-4, 1e-5, 5e-7}) {
    file.normals = {{0, 0, 1}, {lean, 0, 1}, {0, 0, 1}};
    EXPECT_NEAR(to_shape(file, {}).point(0, 1, 0).ns.x(), lean > 1e-6 ? lean : 0, 1e-7) << lean;
  }
}

} // namespace
