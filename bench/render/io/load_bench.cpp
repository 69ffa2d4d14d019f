/// Measures how fast meshes load: bumpy grids with normals, with files in the file system cache. Prints a table to
/// stdout.
/// Usage: bench_render_io_load [-- TRIANGLES [ROUNDS]]
///   read  : wall-clock time of the reader [s], the median of the rounds, followed by the CPU time of all threads.
///   shape : CPU time of to_shape [s].
///   MB/s  : size of the file divided by the wall-clock time of the reader.

#include "../arguments.h"
#include "../timing.h"

#include <render/io/mesh/mesh.h>

#include <fmt/format.h>
#include <fmt/os.h>

#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>

namespace {

using bench::seconds_by, bench::median;
using Clock = std::chrono::steady_clock;

constexpr clockid_t process = CLOCK_PROCESS_CPUTIME_ID;

struct Grid {
  std::vector<float> positions, normals;
  std::vector<std::uint32_t> indices;
  std::size_t vertices() const { return positions.size() / 3; }
  std::size_t triangles() const { return indices.size() / 3; }
};

// A bumpy square of about `triangles` triangles.
Grid grid(int triangles) {
  const int side = std::max(1, static_cast<int>(std::sqrt(triangles / 2.0)));
  Grid g;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x) {
      const double u = double(x) / side, v = double(y) / side;
      const double du = std::cos(30 * u) * std::cos(20 * v), dv = -2.0 / 3 * std::sin(30 * u) * std::sin(20 * v);
      const double length = std::sqrt(1 + du * du + dv * dv);
      for (const double p : {u, v, std::sin(30 * u) * std::cos(20 * v) / 30})
        g.positions.push_back(static_cast<float>(p));
      for (const double n : {-du, -dv, 1.0}) g.normals.push_back(static_cast<float>(n / length));
    }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto a = static_cast<std::uint32_t>(y * (side + 1) + x), b = a + static_cast<std::uint32_t>(side) + 1;
      for (const std::uint32_t i : {a, a + 1, b, b, a + 1, b + 1}) g.indices.push_back(i);
    }
  return g;
}

void write_obj(const Grid& g, const std::string& path) {
  auto out = fmt::output_file(path);
  for (std::size_t i = 0; i < g.positions.size(); i += 3)
    out.print("v {:.6f} {:.6f} {:.6f}\n", g.positions[i], g.positions[i + 1], g.positions[i + 2]);
  for (std::size_t i = 0; i < g.normals.size(); i += 3)
    out.print("vn {:.5f} {:.5f} {:.5f}\n", g.normals[i], g.normals[i + 1], g.normals[i + 2]);
  for (std::size_t i = 0; i < g.indices.size(); i += 3)
    out.print("f {0}//{0} {1}//{1} {2}//{2}\n", g.indices[i] + 1, g.indices[i + 1] + 1, g.indices[i + 2] + 1);
}

template <class T> void append(std::string& bytes, const T* data, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(data), count * sizeof(T));
}
template <class T> void append(std::string& bytes, T value) { append(bytes, &value, 1); }

void write_ply(const Grid& g, const std::string& path) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      g.vertices(), g.triangles());
  for (std::size_t i = 0; i < g.positions.size(); i += 3) {
    append(bytes, &g.positions[i], 3);
    append(bytes, &g.normals[i], 3);
  }
  for (std::size_t i = 0; i < g.indices.size(); i += 3) {
    append(bytes, std::uint8_t{3});
    append(bytes, &g.indices[i], 3);
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

// One mesh, version 4: magic number and version, the compressed mesh, the offsets of all meshes, their count.
void write_serialized(const Grid& g, const std::string& path) {
  constexpr std::uint32_t has_normals = 1, single = 0x1000;
  std::string mesh;
  append(mesh, has_normals | single);
  mesh.push_back('\0'); // the name of the mesh
  append(mesh, std::uint64_t{g.vertices()});
  append(mesh, std::uint64_t{g.triangles()});
  append(mesh, g.positions.data(), g.positions.size());
  append(mesh, g.normals.data(), g.normals.size());
  append(mesh, g.indices.data(), g.indices.size());
  uLongf size = compressBound(mesh.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(mesh.data()), mesh.size());
  packed.resize(size);
  std::string bytes;
  append(bytes, std::uint16_t{0x041c});
  append(bytes, std::uint16_t{4});
  bytes += packed;
  append(bytes, std::uint64_t{0});
  append(bytes, std::uint32_t{1});
  std::ofstream(path, std::ios::binary) << bytes;
}

template <class Read> void row(const char* format, const std::string& path, int rounds, const Read& read) {
  std::vector<double> seconds, cpu, shape;
  std::size_t triangles = 0;
  for (int i = 0; i < rounds; ++i) {
    const auto start = Clock::now();
    const double cpu_start = seconds_by(process);
    const render::MeshFile file = read(path);
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    cpu.push_back(seconds_by(process) - cpu_start);
    const double shape_start = seconds_by(process);
    triangles = file.triangles.size();
    const render::TriangleMesh mesh = to_shape(file, render::Transform{});
    shape.push_back(seconds_by(process) - shape_start);
  }
  const double bytes = double(std::filesystem::file_size(path));
  fmt::print("{:12}{:>10}{:>8.1f}{:>8.2f}{:>8.2f}{:>8.2f}{:>8.0f}\n", format, triangles, 1e-6 * bytes, median(seconds),
             median(cpu), median(shape), 1e-6 * bytes / median(seconds));
}

} // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv);
  const int rounds = arguments.number(1, 5);
  const Grid g = grid(arguments.number(0, 1'000'000));
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("load_bench.{}", std::time(nullptr));
  std::filesystem::create_directories(folder);
  const auto path = [&](const char* name) { return (folder / name).string(); };
  write_obj(g, path("a.obj"));
  write_ply(g, path("a.ply"));
  write_serialized(g, path("a.serialized"));
  fmt::print("{:12}{:>10}{:>8}{:>8}{:>8}{:>8}{:>8}\n", "format", "triangles", "MB", "read", "CPU", "shape", "MB/s");
  row("obj", path("a.obj"), rounds, render::read_obj);
  row("ply", path("a.ply"), rounds, render::read_ply);
  row("serialized", path("a.serialized"), rounds, [](const std::string& p) { return render::read_serialized(p, 0); });
  std::filesystem::remove_all(folder);
}
