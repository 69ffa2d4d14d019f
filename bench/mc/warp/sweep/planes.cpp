// Warps of the plane.
#include "sweep.h"

#include <mc/warp/annulus.h>
#include <mc/warp/bilinear.h>
#include <mc/warp/disk.h>
#include <mc/warp/isotropic_normal.h>
#include <mc/warp/parallelogram.h>
#include <mc/warp/triangle.h>
#include <mc/warp/uniform.h>

namespace sweep {
namespace {

double d(const auto& x) { return static_cast<double>(x); }

// Inner radius of an annulus: 0, near the outer radius, or anywhere in between.
template <class S> S inner_radius(Draw& r, S outer) {
  if (r.often(0.2)) return S(0);
  if (r.often(0.5)) return S(outer * (1 - r.log(1e-18, 1)));
  return S(d(outer) * r.log(1e-20, 1));
}

template <class S> mc::Vec3<S> vector_of_length(Draw& r, double length) {
  return mc::Vec3<S>(r.direction<S>() * S(length));
}

// Origin of a parallelogram: 0, at a distance of about its size, or anywhere.
template <class S> mc::Vec3<S> origin(Draw& r, double size) {
  if (r.often(0.5)) return mc::Vec3<S>(0, 0, 0);
  return vector_of_length<S>(r, r.often(0.5) ? size : r.log(denormal<S>, largest<S>));
}

template <class S> void add_uniform(std::vector<Row>& rows, const std::string& scalar, const Effort& effort) {
  const auto number = [](Draw& r) { return S(r.often(0.2) ? 0 : r.sign() * r.log(denormal<S>, largest<S>)); };
  rows.push_back(run(
      "UniformDisk " + scalar, effort, [](Draw&, std::string&) { return mc::UniformDisk<S>{}; },
      constant({.invert = 8})));
  rows.push_back(run(
      "UniformDiskPolar " + scalar, effort, [](Draw&, std::string&) { return mc::UniformDiskPolar<S>{}; },
      constant({.invert = 8})));
  rows.push_back(run(
      "UniformTriangle " + scalar, effort, [](Draw&, std::string&) { return mc::UniformTriangle<S>{}; },
      constant({.invert = 4})));
  rows.push_back(run(
      "UniformAnnulus " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const S outer = S(r.log(denormal<S>, largest<S>));
        const S inner = inner_radius(r, outer);
        p = fmt::format("inner {} outer {}", inner, outer);
        return mc::UniformAnnulus<S>(inner, outer);
      },
      [](const auto& w) {
        const double inner = d(w.ring.inner), outer = d(w.ring.outer);
        return [=](auto, auto) { return Bounds{.invert = 8 * outer / (outer - inner), .scale = outer}; };
      }));
  rows.push_back(run(
      "UniformParallelogram " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const double size = r.log(denormal<S>, largest<S>);
        const mc::Vec3<S> o = origin<S>(r, size);
        const mc::Vec3<S> a = vector_of_length<S>(r, size), b = vector_of_length<S>(r, size * r.log(1e-6, 1e6));
        p = fmt::format("origin {} a {} b {}", detail::text(o), detail::text(a), detail::text(b));
        return mc::UniformParallelogram<S>{mc::Parallelogram<S>(o, a, b)};
      },
      [](const auto& w) {
        const auto& g = w.domain();
        const double o = d(g.origin.stableNorm()), a = d(g.a.stableNorm()), b = d(g.b.stableNorm());
        const double sine = d(g.area()) / a / b, scale = o + a + b;
        return [=](auto, auto) { return Bounds{.invert = 16 * scale / std::min(a, b) / sine, .scale = scale}; };
      }));
  rows.push_back(run(
      "UniformBox " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const mc::Vec2<S> lo(number(r), number(r)), hi(number(r), number(r));
        p = fmt::format("lo {} hi {}", detail::text(lo), detail::text(hi));
        return mc::UniformBox<S, 2>(lo, hi);
      },
      [](const auto& w) {
        const auto &lo = w.box.lo, &hi = w.box.hi;
        double far = 0, stretch = 1;
        for (int i = 0; i < 2; ++i) {
          const double most = std::max(std::abs(d(lo[i])), std::abs(d(hi[i])));
          far = std::max(far, most);
          stretch = std::max(stretch, most / (d(hi[i]) - d(lo[i])));
        }
        return [=](auto, auto) { return Bounds{.sample = 4, .pdf = 8, .invert = 4 * stretch, .scale = far}; };
      }));
}

template <class S> void add_densities(std::vector<Row>& rows, const std::string& scalar, const Effort& effort) {
  rows.push_back(run(
      "Bilinear " + scalar, effort,
      [&](Draw& r, std::string& p) {
        std::array<S, 4> w;
        for (S& x : w) x = r.often(0.2) ? S(0) : S(r.log(denormal<S>, largest<S>));
        p = fmt::format("{} {} {} {}", w[0], w[1], w[2], w[3]);
        return mc::Bilinear<S>(w[0], w[1], w[2], w[3]);
      },
      [](const auto&) {
        // The conditional density depends on y, so the rounding of y moves x, and the oracle has a different y.
        return [](auto, auto) { return Bounds{.sample = HUGE_VAL, .invert = 16}; };
      }));
  rows.push_back(run(
      "IsotropicNormal " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const S sigma = S(r.log(denormal<S>, largest<S>));
        p = fmt::format("sigma {}", sigma);
        return mc::IsotropicNormal<S>(sigma);
      },
      [](const auto& w) {
        return [s = d(w.sigma)](auto, const auto& x) {
          const double r = detail::size(x) / s;
          return Bounds{.pdf = 8 + 2 * r * r, .invert = 8, .scale = s};
        };
      }));
}

template <class S> void add(std::vector<Row>& rows, const std::string& scalar, const Effort& effort) {
  add_uniform<S>(rows, scalar, effort);
  add_densities<S>(rows, scalar, effort);
}

} // namespace

std::vector<Row> planes(const Effort& effort) {
  std::vector<Row> rows;
  add<float>(rows, "float", effort);
  add<double>(rows, "double", effort);
  return rows;
}

} // namespace sweep
