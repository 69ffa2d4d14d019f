/// Compares ray tracing with Embree 3 (rtcIntersect1, rtcOccluded1, default build, fast mode). One thread traces one
/// ray per call. Both trace the same rays, alternately in one run. Prints a table to stdout.
/// Usage: bench_render_accel_bvh [SCENE.xml...] [-- SIDE [ROUNDS]], images of SIDE x SIDE pixels
///   Mrays/s : our rate by the CPU time of the thread, the median of the rounds.
///   /Embree : our rate divided by Embree's, the median of the ratios of the rounds.
///   build   : build time of both [ns per primitive] with all threads, CPU time and wall-clock time, medians of the
///             rounds.
///   bytes   : memory per primitive, of the tree and of the shapes.

#include "../arguments.h"
#include "../timing.h"
#include "worlds.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace {

using namespace bench;

std::size_t allocated() {
  const auto m = mallinfo2();
  return m.uordblks + m.hblkhd;
}

/// Duration of a task with all threads: CPU time and wall-clock time [s].
struct Durations {
  std::vector<double> cpu, clock;

  template <class F> void add(const F& f) {
    const double cpu_start = seconds_by(CLOCK_PROCESS_CPUTIME_ID), start = seconds_by(CLOCK_MONOTONIC);
    f();
    cpu.push_back(seconds_by(CLOCK_PROCESS_CPUTIME_ID) - cpu_start);
    clock.push_back(seconds_by(CLOCK_MONOTONIC) - start);
  }
  std::string per(double n) const {
    return fmt::format("{:.0f} ns ({:.0f} by the clock)", 1e9 * median(cpu) / n, 1e9 * median(clock) / n);
  }
};

/// The Embree scene of a world.
class Peer {
 public:
  Peer(RTCDevice device, const World& world, Durations& build)
      : scene_(rtcNewScene(device)),
        geometry_(rtcNewGeometry(device,
                                 world.spheres.empty() ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_SPHERE_POINT)) {
    if (world.spheres.empty()) fill_triangles(world);
    else fill_spheres(world);
    rtcCommitGeometry(geometry_);
    rtcAttachGeometry(scene_, geometry_);
    build.add([&] { rtcCommitScene(scene_); });
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  ~Peer() {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
  }

  bool intersect(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query;
    query.ray = of(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
  bool occluded(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = of(ray);
    rtcOccluded1(scene_, &context, &query);
    return query.tfar < 0;
  }

 private:
  static RTCRay of(const Ray& r) {
    return {float(r.o.x()),
            float(r.o.y()),
            float(r.o.z()),
            0,
            float(r.d.x()),
            float(r.d.y()),
            float(r.d.z()),
            0,
            float(r.t_max),
            ~0u,
            0,
            0};
  }
  void fill_triangles(const World& world) {
    auto* p = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, world.positions.size()));
    for (const Vec3& v : world.positions)
      for (int a = 0; a < 3; ++a) *p++ = float(v[a]);
    auto* t = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, world.triangles.size()));
    for (const auto& v : world.triangles) t = std::copy(v.begin(), v.end(), t);
  }
  void fill_spheres(const World& world) {
    auto* p = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, world.spheres.size()));
    for (const auto& s : world.spheres) {
      for (int a = 0; a < 3; ++a) *p++ = float(s.center[a]);
      *p++ = float(s.radius);
    }
  }

  RTCScene scene_;
  RTCGeometry geometry_;
};

/// CPU time of `trace` on all rays [s], and the number of rays for which it returns true.
template <class Trace> double seconds_of(const std::vector<Ray>& rays, std::size_t& hits, const Trace& trace) {
  hits = 0;
  const double start = seconds_by(CLOCK_THREAD_CPUTIME_ID);
  for (const Ray& ray : rays) hits += trace(ray);
  return seconds_by(CLOCK_THREAD_CPUTIME_ID) - start;
}

struct Table {
  RTCDevice device;
  int rounds;
  std::vector<double> ratios = {};

  template <class Ours, class Theirs>
  void row(const World& world, const char* kind, const std::vector<Ray>& rays, const Ours& ours, const Theirs& theirs) {
    std::vector<double> rates, ratio;
    std::size_t hits = 0, their_hits = 0;
    for (int i = 0; i < rounds; ++i) {
      const double t = seconds_of(rays, hits, ours), their_t = seconds_of(rays, their_hits, theirs);
      rates.push_back(double(rays.size()) / t / 1e6);
      ratio.push_back(their_t / t);
    }
    ratios.push_back(median(ratio));
    fmt::print("{:<16} {:<8} {:8.2f} {:8.2f} {:9.4f} {:9.4f}\n", world.name, kind, median(rates), ratios.back(),
               double(hits) / double(rays.size()), double(their_hits) / double(rays.size()));
    std::fflush(stdout);
  }

  void measure(const World& world, int side) {
    const std::size_t at_first = allocated();
    const auto shapes = world.shapes();
    const render::Bvh bvh{std::span(shapes)};
    const double bytes = double(allocated() - at_first), n = double(world.size());
    Durations build, their_build;
    const Peer peer(device, world, their_build);
    for (int i = 0; i < rounds; ++i) {
      std::optional<render::Bvh> again;
      build.add([&] { again.emplace(std::span(shapes)); });
      const Peer theirs(device, world, their_build);
    }
    fmt::print("{:<16} {} primitives: build {}, Embree's {}; {:.0f} bytes\n", world.name, world.size(), build.per(n),
               their_build.per(n), bytes / n);
    const Rays rays(world, shapes, bvh, side);
    const auto ours = [&](const Ray& r) { return bvh.intersect(r).has_value(); };
    const auto theirs = [&](const Ray& r) { return peer.intersect(r); };
    row(world, "primary", rays.primary, ours, theirs);
    row(world, "bounce", rays.bounce, ours, theirs);
    row(
        world, "shadow", rays.shadow, [&](const Ray& r) { return bvh.occluded(r); },
        [&](const Ray& r) { return peer.occluded(r); });
  }
};

} // namespace

int main(int argc, char** argv) {
  const Arguments arguments(argc, argv);
  const int side = arguments.number(0, 512);
  const RTCDevice device = rtcNewDevice(nullptr);
  Table table{device, arguments.number(1, 7)};
  fmt::print("{:<16} {:<8} {:>8} {:>8} {:>9} {:>9}\n", "world", "rays", "Mrays/s", "/Embree", "hit", "Embree's");
  for (const std::string& path : arguments.scenes) table.measure(scene_file(path), side);
  table.measure(bumpy_sphere("bumpy 10k", 70), side);
  table.measure(bumpy_sphere("bumpy 100k", 230), side);
  table.measure(bumpy_sphere("bumpy 1M", 707), side);
  table.measure(needles(100000), side);
  table.measure(balls(5000), side);
  double logs = 0;
  for (const double r : table.ratios) logs += std::log(r);
  fmt::print("geometric mean of our rate over Embree's {:.3f}, least {:.3f}\n",
             std::exp(logs / double(table.ratios.size())), *std::min_element(table.ratios.begin(), table.ratios.end()));
  rtcReleaseDevice(device);
}
