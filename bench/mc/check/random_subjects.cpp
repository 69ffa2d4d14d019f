#include <mc/check/random_subjects.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/box.h>
#include <mc/domain/interval.h>
#include <mc/domain/sphere.h>
#include <mc/random/hash.h>
#include <mc/table/alias_table.h>
#include <mc/table/table_dist_1d.h>
#include <mc/table/table_dist_2d.h>
#include <mc/warp/annulus.h>
#include <mc/warp/ball.h>
#include <mc/warp/bilinear.h>
#include <mc/warp/cone.h>
#include <mc/warp/disk.h>
#include <mc/warp/exponential.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/logistic.h>
#include <mc/warp/normal.h>
#include <mc/warp/product.h>
#include <mc/warp/rotated.h>
#include <mc/warp/spherical_triangle.h>
#include <mc/warp/tent.h>
#include <mc/warp/triangle.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/von_mises_fisher.h>

#include <fmt/format.h>

#include <memory>

namespace checker_bench {
namespace {

using mc::sqr;
using V2 = mc::Vec2<double>;
using V3 = mc::Vec3<double>;

// Returns the subject of a warp without inverse and oracle, which the statistical tests of most cases do not need.
template <mc::Warp W> Subject plain(const std::string& name, const W& warp) {
  const auto shared = std::make_shared<const W>(warp);
  return make_subject(
      name + (sizeof(typename W::Scalar) == 4 ? " in float" : ""), typename W::Domain(warp.domain()),
      [shared](const typename W::Domain::UnitPoint& u) { return shared->sample(u); },
      [shared](const typename W::Domain::Point& x) { return shared->pdf(x); });
}

template <mc::Real S> Subject table(const std::string& name, const std::vector<double>& w, bool named) {
  const mc::TableDist1D<S> table(w);
  Subject s = plain(name, table);
  if (named) s.breaks[0] = table.breaks()[0];
  return s;
}

template <mc::Real S>
Subject table(const std::string& name, const std::vector<double>& w, std::size_t width, std::size_t height,
              bool named) {
  const mc::TableDist2D<S> table(w, width, height);
  Subject s = plain(name, table);
  if (named)
    for (std::size_t axis = 0; axis < 2; ++axis) s.breaks[axis] = table.breaks()[axis];
  return s;
}

// Returns the weights of n cells: random, random to the fourth power, nearly uniform with one bright cell, smooth, or a
// multiplicative cascade. Some have zeros.
std::vector<double> texture(Pcg& r, std::size_t n, std::string& name) {
  std::vector<double> w(n, 1);
  switch (random_index(r, 5)) {
  case 0:
    name += " u";
    for (double& x : w) x = uniform(r);
    break;
  case 1:
    name += " u^4";
    for (double& x : w) x = sqr(sqr(uniform(r)));
    break;
  case 2:
    name += " sun";
    for (double& x : w) x = 1 + 0.1 * uniform(r);
    w[r.next64() % n] *= log_uniform(r, 10, 1e6);
    break;
  case 3:
    name += " smooth";
    for (std::size_t i = 0; i < n; ++i) w[i] = 1.2 + std::sin(40.0 * static_cast<double>(i) / static_cast<double>(n));
    break;
  default: {
    name += " cascade";
    const double low = uniform_between(r, 0.5, 0.95);
    const std::uint64_t seed = r.next64();
    for (std::size_t bit = 1; bit < n; bit *= 2)
      for (std::size_t i = 0; i < n; ++i) w[i] *= mc::hash(seed, i / bit, bit) & 1 ? low : 2 - low;
  }
  }
  if (random_index(r, 4) == 0) {
    name += " with holes";
    for (double& x : w)
      if (random_index(r, 3) == 0) x = 0;
    w[0] = 1;
  }
  return w;
}

V3 random_direction(Pcg& r) { return mc::Sphere<double>{}.from_unit(V2(uniform(r), uniform(r))); }

template <mc::Real S> Subject lobes(Pcg& r) {
  switch (random_index(r, 5)) {
  case 0: return make_subject("cosine", mc::CosineHemisphere<S>{});
  case 1: {
    const double alpha = log_uniform(r, 0.01, 1);
    return make_subject(fmt::format("GGX normals {:.3f}", alpha), mc::TrowbridgeReitzNormals<S>(static_cast<S>(alpha)));
  }
  case 2: {
    const double g = 1 - log_uniform(r, 1e-3, 1);
    return plain(fmt::format("Henyey-Greenstein {:.4f}", g), mc::HenyeyGreenstein<S>(static_cast<S>(g)));
  }
  case 3:
    return plain("cosine about a random axis",
                 mc::Rotated(mc::CosineHemisphere<S>{}, mc::Vec3<S>(random_direction(r).cast<S>().normalized())));
  default: {
    const double t = uniform_between(r, 0, 1.5), ax = log_uniform(r, 0.02, 1), ay = log_uniform(r, 0.02, 1);
    const mc::Vec3<S> wo(static_cast<S>(std::sin(t)), S(0), static_cast<S>(std::cos(t)));
    return plain(fmt::format("GGX visible {:.3f} {:.3f} at {:.2f}", ax, ay, t),
                 mc::TrowbridgeReitzVisibleNormals<S>(wo, static_cast<S>(ax), static_cast<S>(ay)));
  }
  }
}

// Returns a warp on a domain that no other kind uses.
template <mc::Real S> Subject shapes(Pcg& r) {
  const auto real = [&](double lo, double hi) { return static_cast<S>(log_uniform(r, lo, hi)); };
  switch (random_index(r, 11)) {
  case 0: return plain("disk", mc::UniformDisk<S>{});
  case 1: {
    const S outer = real(0.1, 10);
    return plain("annulus", mc::UniformAnnulus<S>(outer * static_cast<S>(uniform(r)), outer));
  }
  case 2: return plain("ball", mc::UniformBall<S>{});
  case 3: return plain("cone", mc::UniformCone<S>::from_angle(real(1e-2, 3)));
  case 4: return plain("triangle", mc::UniformTriangle<S>{});
  case 5: {
    const mc::Vec3<S> a(real(0.1, 1), real(0.1, 1), real(0.5, 2)), ab(real(0.1, 1), S(0), -real(0.01, 0.1)),
        ac(S(0), real(0.1, 1), S(0));
    return plain("spherical triangle", mc::SphericalTriangle<S>(a, ab, ac));
  }
  case 6: return plain("exponential", mc::Exponential<S>(real(0.01, 100)));
  case 7: return plain("logistic", mc::Logistic<S>(static_cast<S>(uniform_between(r, -3, 3)), real(0.1, 3)));
  case 8: return plain("bilinear", mc::Bilinear<S>(real(0.01, 1), real(0.01, 1), real(0.01, 1), real(0.01, 1)));
  case 9: {
    const mc::Normal<S> x(static_cast<S>(uniform_between(r, -1, 1)), real(0.1, 2)), y(S(0), real(0.1, 2));
    return plain("normal in the plane", mc::Product{x, y});
  }
  default: {
    const mc::Tent<S> x(S(0), real(0.1, 3)), y(static_cast<S>(uniform_between(r, -1, 1)), real(0.1, 3));
    return plain("tent in the plane", mc::Product{x, y});
  }
  }
}

} // namespace

Subject table_subject(const std::string& name, const std::vector<double>& weights, bool named) {
  return table<double>(name, weights, named);
}
Subject table_subject(const std::string& name, const std::vector<double>& weights, std::size_t width,
                      std::size_t height, bool named) {
  return table<double>(name, weights, width, height, named);
}

Subject table_1d(Pcg& r) {
  const auto n = static_cast<std::size_t>(log_uniform(r, 4, 1e5));
  std::string name = fmt::format("table of {}", n);
  const std::vector<double> w = texture(r, n, name);
  const bool named = random_index(r, 2) == 0;
  return random_index(r, 2) == 0 ? table<double>(name, w, named) : table<float>(name, w, named);
}

Subject table_2d(Pcg& r) {
  const auto width = static_cast<std::size_t>(log_uniform(r, 4, 700)),
             height = static_cast<std::size_t>(log_uniform(r, 4, 700));
  std::string name = fmt::format("table {}x{}", width, height);
  const std::vector<double> w = texture(r, width * height, name);
  const bool named = random_index(r, 2) == 0;
  return random_index(r, 2) == 0 ? table<double>(name, w, width, height, named)
                                 : table<float>(name, w, width, height, named);
}

Subject lobe_on_sphere(double k, double kappa, const V3& pole) {
  const mc::VonMisesFisher<double> lobe(kappa);
  const V3 side = mc::cross(pole, std::abs(pole.x()) < 0.5 ? V3(V3::UnitX()) : V3(V3::UnitY())).normalized();
  const V3 other = mc::cross(pole, side);
  return make_subject(
      fmt::format("uniform sphere and {:.2g} of kappa {:.2g}", k, kappa), mc::Sphere<double>{},
      [=](Pcg& random) -> V3 {
        const bool in_lobe = uniform(random) < k;
        const V2 u(uniform(random), uniform(random));
        if (!in_lobe) return mc::Sphere<double>{}.from_unit(u);
        const V3 w = lobe.sample(u);
        return (w.x() * side + w.y() * other + w.z() * pole).normalized();
      },
      [=](const V3& w) {
        const double far = (w - pole).squaredNorm() / 2; // 1 - cos, without cancellation
        const double z = 1 - far, s = std::sqrt(std::max(0.0, far * (1 + z)));
        return (1 - k) / (4 * mc::pi<double>)+k * lobe.pdf(V3(s, 0, z));
      });
}

Subject lobe_on_sphere(Pcg& r) {
  const double kappa = log_uniform(r, 1, 1e8), k = log_uniform(r, 1e-5, 1);
  return lobe_on_sphere(k, kappa, random_direction(r));
}

Subject heavy_tail(Pcg& r) {
  if (random_index(r, 2) == 0) {
    const double a = uniform_between(r, 0.3, 3);
    return make_subject(
        fmt::format("Pareto {:.2f}", a), mc::HalfLine<double>(1, 1),
        [a](Pcg& random) { return std::pow(1 - uniform(random), -1 / a); },
        [a](double x) { return x >= 1 ? a * std::pow(x, -a - 1) : 0.0; });
  }
  const double b = uniform_between(r, 0.5, 4), s = log_uniform(r, 0.1, 10);
  return make_subject(
      fmt::format("log-logistic {:.2f} scale {:.2f}", b, s), mc::HalfLine<double>(0, 1),
      [=](Pcg& random) {
        const double u = uniform(random);
        return s * std::pow(u / (1 - u), 1 / b);
      },
      [=](double x) {
        const double t = std::pow(x / s, b);
        return x > 0 ? b / x * t / sqr(1 + t) : 0.0;
      });
}

Subject powers_in_box(Pcg& r) {
  const V3 a(log_uniform(r, 0.05, 3), log_uniform(r, 0.05, 3), log_uniform(r, 0.05, 3));
  return make_subject(
      fmt::format("x^{:.2f} y^{:.2f} z^{:.2f}", a[0] - 1, a[1] - 1, a[2] - 1), mc::Box<double, 3>{},
      [a](const V3& u) { return V3(std::pow(u[0], 1 / a[0]), std::pow(u[1], 1 / a[1]), std::pow(u[2], 1 / a[2])); },
      [a](const V3& x) {
        double p = 1;
        for (int i = 0; i < 3; ++i) p *= a[i] * std::pow(x[i], a[i] - 1);
        return p;
      });
}

Subject uniform_inside(std::string name, double area, const std::function<bool(const V2&)>& inside) {
  return make_subject(
      std::move(name), mc::Square<double>{},
      [inside](Pcg& random) {
        for (;;)
          if (const V2 p(uniform(random), uniform(random)); inside(p)) return p;
      },
      [inside, area](const V2& p) { return inside(p) ? 1 / area : 0.0; });
}

Subject set_in_box(Pcg& r) {
  switch (random_index(r, 3)) {
  case 0: {
    const double slope = uniform_between(r, -0.7, 0.7), width = uniform_between(r, 0.02, 0.2),
                 at = uniform_between(r, 0.4, 0.4 + 0.1);
    // The strip starts at y = at + slope (x - 1/2) / 2, and is inside the square for every x.
    return uniform_inside(fmt::format("strip {:.2f} wide {:.2f}", slope, width), width, [=](const V2& p) {
      const double y = p[1] - at - 0.5 * slope * (p[0] - 0.5);
      return y >= 0 && y < width;
    });
  }
  case 1: {
    const double radius = log_uniform(r, 0.05, 0.5), x = uniform_between(r, radius, 1 - radius),
                 y = uniform_between(r, radius, 1 - radius);
    return uniform_inside(fmt::format("disk of {:.3f}", radius), mc::pi<double> * radius * radius,
                          [=](const V2& p) { return sqr(p[0] - x) + sqr(p[1] - y) < radius * radius; });
  }
  default: {
    const int n = 2 * (1 + random_index(r, 150)), m = 2 * (1 + random_index(r, 150));
    return uniform_inside(fmt::format("checkerboard {}x{}", n, m), 0.5, [=](const V2& p) {
      return (static_cast<int>(p[0] * n) + static_cast<int>(p[1] * m)) % 2 == 0;
    });
  }
  }
}

Subject uniform_ball_in_box(double radius) {
  const auto inside = [=](const V3& p) { return (p - V3(0.5, 0.5, 0.5)).squaredNorm() < radius * radius; };
  const double density = 1 / (4 * mc::pi<double> / 3 * radius * radius * radius);
  return make_subject(
      fmt::format("ball of {:.2f}", radius), mc::Box<double, 3>{},
      [=](Pcg& random) {
        for (;;)
          if (const V3 p(uniform(random), uniform(random), uniform(random)); inside(p)) return p;
      },
      [=](const V3& p) { return inside(p) ? density : 0.0; });
}

Subject ball_in_box(Pcg& r) { return uniform_ball_in_box(uniform_between(r, 0.2, 0.5)); }

Subject normals(Pcg& r) {
  const double k = log_uniform(r, 1e-4, 1), s = log_uniform(r, 1e-6, 1), m = uniform_between(r, -2, 2);
  return make_subject(
      fmt::format("normal and {:.2g} of sigma {:.2g}", k, s), mc::RealLine<double>(0, 1),
      [=](Pcg& random) {
        const double z = std::sqrt(-2 * std::log(1 - uniform(random))) * std::cos(2 * mc::pi<double> * uniform(random));
        return uniform(random) < k ? m + s * z : z;
      },
      [=](double x) {
        const auto phi = [](double z) { return std::exp(-z * z / 2) / std::sqrt(2 * mc::pi<double>); };
        return (1 - k) * phi(x) + k / s * phi((x - m) / s);
      });
}

Subject product(Pcg& r) {
  const auto n = static_cast<std::size_t>(log_uniform(r, 4, 1e4));
  std::string name = fmt::format("table of {}", n);
  const auto x = std::make_shared<mc::TableDist1D<double>>(texture(r, n, name));
  const double a = uniform_between(r, 0.4, 3), shift = uniform(r),
               slope = random_index(r, 2) == 0 ? 0 : uniform_between(r, -2, 2);
  // On a torus, with a shift along x that depends on y.
  const auto moved = [=](double by) { return by - std::floor(by); };
  return make_subject(
      fmt::format("{} beside y^{:.2f} sheared by {:.2f}", name, a - 1, slope), mc::Square<double>{},
      [=](const V2& u) {
        const double y = std::pow(u[1], 1 / a);
        return V2(std::min(moved(x->sample(u[0]) + shift + slope * y), 1 - 0x1p-53), y);
      },
      [=](const V2& p) {
        return x->pdf(std::min(moved(p[0] - shift - slope * p[1]), 1 - 0x1p-53)) * a * std::pow(p[1], a - 1);
      });
}

Subject outcomes(Pcg& r) {
  const auto n = static_cast<std::size_t>(log_uniform(r, 2, 1e6));
  std::string name = fmt::format("{} outcomes", n);
  return make_discrete_subject(name, mc::AliasTable(texture(r, n, name)));
}

Subject random_correct(std::uint64_t seed) {
  Pcg r(mc::hash(seed, 77));
  switch (random_index(r, 17)) {
  case 0:
  case 1: return table_2d(r);
  case 2: return table_1d(r);
  case 3: return lobe_on_sphere(r);
  case 4: return heavy_tail(r);
  case 5: return powers_in_box(r);
  case 6: return set_in_box(r);
  case 7: return ball_in_box(r);
  case 8: return normals(r);
  case 9: return product(r);
  case 10: return lobes<double>(r);
  case 11: return lobes<float>(r);
  case 12: return shapes<double>(r);
  case 13: return shapes<float>(r);
  case 14: return many_dimensions(r);
  case 15: return rotations(r);
  default: return outcomes(r);
  }
}

Subject random_continuous(std::uint64_t seed) {
  for (std::uint64_t k = 0;; ++k)
    if (Subject right = random_correct(mc::hash(seed, k)); right.dim > 0) return right;
}

} // namespace checker_bench
