#include <mc/check/random_subjects.h>

#include <mc/check/subject/make_subject.h>
#include <mc/core/types.h>
#include <mc/domain/box.h>
#include <mc/random/hash.h>

#include <fmt/format.h>

#include <array>

namespace checker_bench {
namespace {

using mc::sqr;
using V2 = mc::Vec2<double>;
using V3 = mc::Vec3<double>;

// Returns x modulo 1, on a torus.
double wrapped(double x) { return std::min(x - std::floor(x), 1 - 0x1p-53); }

// A mixture of an annulus and a uniform square.
Subject ring(Pcg& r) {
  const double k = log_uniform(r, 1e-3, 1), inner = log_uniform(r, 0.01, 0.35),
               width = inner * log_uniform(r, 1e-4, 0.3), outer = inner + width;
  const double x = uniform_between(r, outer, 1 - outer), y = uniform_between(r, outer, 1 - outer),
               squares = width * (inner + outer);
  return make_subject(
      fmt::format("{:.2g} in a ring of {:.3g}, {:.2g} wide", k, inner, width), mc::Square<double>{},
      [=](Pcg& q) {
        const V2 p(uniform(q), uniform(q));
        if (uniform(q) >= k) return p;
        const double distance = std::sqrt(sqr(inner) + p[0] * squares), angle = 2 * mc::pi<double> * p[1];
        return V2(x + distance * std::cos(angle), y + distance * std::sin(angle));
      },
      [=](const V2& p) {
        const double distance = std::hypot(p[0] - x, p[1] - y);
        return 1 - k + (distance >= inner && distance < outer ? k / (mc::pi<double> * squares) : 0.0);
      });
}

// The density proportional to exp(-|x - centre| / scale) on [0,1].
struct Peak {
  double centre, scale;
  double below() const { return -std::expm1(-centre / scale); }
  double above() const { return -std::expm1(-(1 - centre) / scale); }
  double sample(double u) const {
    u *= below() + above();
    return u < below() ? std::max(0.0, centre + scale * std::log1p(-u))
                       : std::min(1 - 0x1p-53, centre - scale * std::log1p(-(u - below())));
  }
  double pdf(double x) const { return std::exp(-std::abs(x - centre) / scale) / (scale * (below() + above())); }
};

// A mixture of a peak and a uniform square; half of the coordinates of the peak are at an edge.
Subject spot(Pcg& r) {
  const auto place = [&] {
    switch (random_index(r, 4)) {
    case 0: return 0.0;
    case 1: return 1.0;
    case 2: return log_uniform(r, 1e-5, 0.5);
    default: return uniform(r);
    }
  };
  const double k = log_uniform(r, 1e-3, 1);
  const Peak x{place(), log_uniform(r, 1e-6, 0.3)}, y{place(), log_uniform(r, 1e-6, 0.3)};
  return make_subject(
      fmt::format("{:.2g} in a spot at ({:.3g}, {:.3g}) of {:.2g} by {:.2g}", k, x.centre, y.centre, x.scale, y.scale),
      mc::Square<double>{},
      [=](Pcg& q) {
        const V2 p(uniform(q), uniform(q));
        return uniform(q) >= k ? p : V2(x.sample(p[0]), y.sample(p[1]));
      },
      [=](const V2& p) { return 1 - k + k * x.pdf(p[0]) * y.pdf(p[1]); });
}

// A band across a square with a density that is a power of y.
Subject ridge(Pcg& r) {
  const double k = log_uniform(r, 1e-2, 1), width = log_uniform(r, 1e-5, 0.2), at = uniform(r),
               a = uniform_between(r, 0.4, 3), slope = log_uniform(r, 0.01, 30) * (random_index(r, 2) == 0 ? 1 : -1);
  return make_subject(
      fmt::format("{:.2g} in a ridge of slope {:.2f}, {:.2g} wide, y^{:.2f}", k, slope, width, a - 1),
      mc::Square<double>{},
      [=](Pcg& q) {
        const double u = uniform(q), y = std::pow(uniform(q), 1 / a);
        return uniform(q) >= k ? V2(u, y) : V2(wrapped(at + slope * y + width * u), y);
      },
      [=](const V2& p) {
        const bool inside = wrapped(p[0] - at - slope * p[1]) < width;
        return (1 - k + (inside ? k / width : 0.0)) * a * std::pow(p[1], a - 1);
      });
}

// A skew tube through a box with a density that is a power of z.
Subject tube(Pcg& r) {
  const double k = log_uniform(r, 1e-2, 1), a = uniform_between(r, 0.4, 3);
  const std::array<double, 2> width{log_uniform(r, 1e-3, 0.2), log_uniform(r, 1e-3, 0.2)}, at{uniform(r), uniform(r)},
      slope{uniform_between(r, -2, 2), uniform_between(r, -2, 2)};
  return make_subject(
      fmt::format("{:.2g} in a tube of {:.2g} by {:.2g}, z^{:.2f}", k, width[0], width[1], a - 1), mc::Box<double, 3>{},
      [=](Pcg& q) {
        V3 p(uniform(q), uniform(q), std::pow(uniform(q), 1 / a));
        if (uniform(q) >= k) return p;
        for (std::size_t i = 0; i < 2; ++i) {
          double& x = p[static_cast<int>(i)];
          x = wrapped(at[i] + slope[i] * p[2] + width[i] * x);
        }
        return p;
      },
      [=](const V3& p) {
        bool inside = true;
        for (std::size_t i = 0; i < 2; ++i)
          inside = inside && wrapped(p[static_cast<int>(i)] - at[i] - slope[i] * p[2]) < width[i];
        return (1 - k + (inside ? k / (width[0] * width[1]) : 0.0)) * a * std::pow(p[2], a - 1);
      });
}

} // namespace

Subject random_narrow(std::uint64_t seed) {
  Pcg r(mc::hash(seed, 80));
  switch (random_index(r, 4)) {
  case 0: return ring(r);
  case 1: return spot(r);
  case 2: return ridge(r);
  default: return tube(r);
  }
}

} // namespace checker_bench
