/// Closest-hit and any-hit rates of our BVH, and of Embree 3 (rtcIntersect1, rtcOccluded1) where it was found: single
/// thread, one ray per call, the same rays and the same mesh of 105k triangles, in one run.

#include <render/accel/bvh.h>

#include <mc/random/pcg.h>
#include <mc/warp/sphere.h>

#include <benchmark/benchmark.h>

#if defined(MC_WITH_EMBREE)
#include <embree3/rtcore.h>
#endif

namespace {

using namespace render;

struct World {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c, d});
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
};

/// A bumpy sphere of 230 x 230 quads less the poles in an enclosure of five walls.
const World& world() {
  static const World built = [] {
    World w;
    const int n = 230;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const double theta = mc::pi<double> * (i + 0.02) / (n + 0.04), phi = 2 * mc::pi<double> * j / n;
        const double r = 1 + 0.08 * std::sin(17 * theta) * std::cos(13 * phi) + 0.02 * std::sin(61 * theta + 47 * phi);
        w.positions.push_back(Vec3(Float(r * std::sin(theta) * std::cos(phi)),
                                   Float(r * std::sin(theta) * std::sin(phi)), Float(r * std::cos(theta))));
      }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto a = static_cast<std::uint32_t>(i * (n + 1) + j), b = a + n + 1;
        w.triangles.push_back({a, b, b + 1});
        w.triangles.push_back({a, b + 1, a + 1});
      }
    const Float s = 2;
    w.quad({-s, -s, -s}, {s, -s, -s}, {s, -s, s}, {-s, -s, s});
    w.quad({-s, s, -s}, {-s, s, s}, {s, s, s}, {s, s, -s});
    w.quad({-s, -s, -s}, {-s, -s, s}, {-s, s, s}, {-s, s, -s});
    w.quad({s, -s, -s}, {s, s, -s}, {s, s, s}, {s, -s, s});
    w.quad({-s, -s, s}, {s, -s, s}, {s, s, s}, {-s, s, s});
    return w;
  }();
  return built;
}

const Bvh& ours() {
  static const Bvh bvh = [] {
    const Shape shape = TriangleMesh(world().positions, world().triangles);
    return Bvh(std::span(&shape, 1));
  }();
  return bvh;
}

enum Kind { primary, bounce, shadow };

/// primary: pinhole, scanline order; bounce: from its hits into the hemisphere; shadow: from its hits toward a small
///          light.
const std::vector<Ray>& rays(Kind kind) {
  static const std::array<std::vector<Ray>, 3> built = [] {
    std::array<std::vector<Ray>, 3> r;
    const Shape shape = TriangleMesh(world().positions, world().triangles);
    mc::Pcg random(1);
    const int n = 512;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const Ray ray{Vec3(0, 0, -5), Vec3(Float(x - n / 2) / n, Float(y - n / 2) / n, 1).normalized()};
        r[primary].push_back(ray);
        const auto hit = ours().intersect(ray);
        if (!hit) continue;
        const SurfacePoint p = shape.surface_point(ray, *hit);
        const Vec3 side = p.ng.dot(ray.d) < 0 ? p.ng : Vec3(-p.ng);
        const Vec3 d = side + mc::UniformSphere<Float>{}.sample(random.point<Float, 2>());
        r[bounce].push_back(p.spawn_ray(d.normalized()));
        const Vec3 light(random.uniform<Float>() - Float(0.5), Float(1.9), random.uniform<Float>() - Float(0.5));
        const Vec3 o = p.offset_origin(light - p.p);
        r[shadow].push_back({o, Vec3(light - o), Float(0.9999)});
      }
    return r;
  }();
  return built[kind];
}

void ours_closest(benchmark::State& state, Kind kind) {
  const auto& batch = rays(kind);
  for (auto _ : state)
    for (const Ray& ray : batch) benchmark::DoNotOptimize(ours().intersect(ray));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * batch.size()));
}

void ours_any(benchmark::State& state, Kind kind) {
  const auto& batch = rays(kind);
  for (auto _ : state)
    for (const Ray& ray : batch) benchmark::DoNotOptimize(ours().occluded(ray));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * batch.size()));
}

void ours_build(benchmark::State& state) {
  const Shape shape = TriangleMesh(world().positions, world().triangles);
  for (auto _ : state) benchmark::DoNotOptimize(Bvh(std::span(&shape, 1)));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * world().triangles.size()));
}

BENCHMARK_CAPTURE(ours_closest, primary, primary);
#if defined(MC_WITH_EMBREE)

RTCScene embree() {
  static const RTCScene scene = [] {
    const RTCDevice device = rtcNewDevice("threads=1");
    const RTCScene s = rtcNewScene(device);
    const RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* p = static_cast<float*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, world().positions.size()));
    for (const Vec3& v : world().positions) {
      *p++ = v.x();
      *p++ = v.y();
      *p++ = v.z();
    }
    auto* t = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, world().triangles.size()));
    for (const auto& v : world().triangles) {
      *t++ = v[0];
      *t++ = v[1];
      *t++ = v[2];
    }
    rtcCommitGeometry(g);
    rtcAttachGeometry(s, g);
    rtcCommitScene(s);
    return s;
  }();
  return scene;
}

void fill(RTCRay& to, const Ray& from) {
  to = {from.o.x(), from.o.y(), from.o.z(), 0, from.d.x(), from.d.y(), from.d.z(), 0, from.t_max, ~0u, 0, 0};
}

void embree_closest(benchmark::State& state, Kind kind) {
  const auto& batch = rays(kind);
  const RTCScene scene = embree();
  for (auto _ : state)
    for (const Ray& ray : batch) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRayHit query;
      fill(query.ray, ray);
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &context, &query);
      benchmark::DoNotOptimize(query);
    }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * batch.size()));
}

void embree_any(benchmark::State& state, Kind kind) {
  const auto& batch = rays(kind);
  const RTCScene scene = embree();
  for (auto _ : state)
    for (const Ray& ray : batch) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRay query;
      fill(query, ray);
      rtcOccluded1(scene, &context, &query);
      benchmark::DoNotOptimize(query);
    }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * batch.size()));
}

BENCHMARK_CAPTURE(embree_closest, primary, primary);
BENCHMARK_CAPTURE(ours_closest, bounce, bounce);
BENCHMARK_CAPTURE(embree_closest, bounce, bounce);
BENCHMARK_CAPTURE(ours_any, shadow, shadow);
BENCHMARK_CAPTURE(embree_any, shadow, shadow);
#else
BENCHMARK_CAPTURE(ours_closest, bounce, bounce);
BENCHMARK_CAPTURE(ours_any, shadow, shadow);
#endif
BENCHMARK(ours_build);

} // namespace
