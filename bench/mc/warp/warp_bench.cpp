// Speed of warps: sample, or sample and density, at precomputed points; scalar float unless a name says double. "made
// anew" includes the construction for each sample, as a renderer constructs a warp at each surface point.
#include "../../speed.h"

#include <mc/warp/cone.h>
#include <mc/warp/disk.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/sample_n.h>
#include <mc/warp/sphere.h>
#include <mc/warp/spherical_rectangle.h>
#include <mc/warp/trowbridge_reitz.h>

#include <string>

namespace {

using mc::Vec3;

// make(u) returns the warp to sample at u.
template <class S, class F> void measure(const std::string& name, double aim, bool with_pdf, F make) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    const auto points = bench::random_points<S>();
    for ([[maybe_unused]] const auto _ : state) {
      for (const auto& u : points) {
        const auto& warp = make(u);
        const auto x = warp.sample(u);
        benchmark::DoNotOptimize(x);
        if (with_pdf) benchmark::DoNotOptimize(warp.pdf(x));
      }
    }
    bench::set_counters(state, static_cast<double>(points.size()), aim);
  });
}

template <class W> void measure(const std::string& name, double aim, const W& warp, bool with_pdf) {
  measure<typename W::Scalar>(name, aim, with_pdf, [warp](const auto&) -> const W& { return warp; });
}

template <class W> void with_batch(const std::string& name, double aim, const W& warp) {
  measure(name, aim, warp, false);
  benchmark::RegisterBenchmark((name + "/n").c_str(), [=](benchmark::State& state) {
    using S = typename W::Scalar;
    const auto points = bench::random_points<S>();
    std::array<std::vector<S>, 5> columns;
    for (auto& column : columns) column.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      columns[0][i] = points[i][0];
      columns[1][i] = points[i][1];
    }
    mc::PointColumns<W> x;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = columns[2 + k];
    for ([[maybe_unused]] const auto _ : state) {
      mc::sample_n(warp, {columns[0], columns[1]}, x);
      benchmark::ClobberMemory();
    }
    bench::set_counters(state, static_cast<double>(points.size()));
  });
}

template <class S> void batches(const std::string& suffix, double scale) {
  with_batch("UniformDisk" + suffix, 7 * scale, mc::UniformDisk<S>{});
  with_batch("UniformSphere" + suffix, 0, mc::UniformSphere<S>{});
  with_batch("UniformHemisphere" + suffix, 0, mc::UniformHemisphere<S>{});
  with_batch("CosineHemisphere" + suffix, 8 * scale, mc::CosineHemisphere<S>{});
  with_batch("UniformCone" + suffix, 0, mc::UniformCone<S>::from_angle(S(0.3)));
  with_batch("HenyeyGreenstein" + suffix, 0, mc::HenyeyGreenstein<S>(S(0.7)));
}

const bool registered = [] {
  batches<float>("", 1);
  batches<double>(", double", 0);

  measure("HenyeyGreenstein, sample + pdf", 12, mc::HenyeyGreenstein<float>(0.7f), true);
  using Normals = mc::TrowbridgeReitzVisibleNormals<float>;
  measure("visible normal, sample + pdf", 30, Normals({0.6f, 0, 0.8f}, 0.2f, 0.3f), true);
  measure<float>("visible normal, made anew, sample + pdf", 30, true,
                 [](const auto& u) { return Normals(Vec3<float>(0.6f * u[0], 0, 1).normalized(), 0.2f, 0.3f); });
  // A square of 2 x 2 at height 2, as a light over a table.
  const auto corner = [](const auto& u) { return Vec3<float>(u[0] - 1.5f, u[1] - 1.5f, 2); };
  const Vec3<float> ex(2, 0, 0), ey(0, 2, 0);
  measure("SphericalTriangle, sample + pdf", 90,
          mc::SphericalTriangle<float>(corner(mc::Vec2<float>(0.5f, 0.5f)), ex, ey), true);
  measure<float>("SphericalTriangle, made anew, sample + pdf", 90, true,
                 [=](const auto& u) { return mc::SphericalTriangle<float>(corner(u), ex, ey); });
  measure("SphericalRectangle, sample + pdf", 90,
          mc::SphericalRectangle<float>(corner(mc::Vec2<float>(0.5f, 0.5f)), ex, ey), true);
  measure<float>("SphericalRectangle, made anew, sample + pdf", 90, true,
                 [=](const auto& u) { return mc::SphericalRectangle<float>(corner(u), ex, ey); });
  return true;
}();

} // namespace
