#include <mc/check/random_subjects.h>

#include <mc/check/subject/make_subject.h>
#include <mc/core/types.h>
#include <mc/domain/interval.h>
#include <mc/domain/sphere.h>
#include <mc/domain/triangle.h>
#include <mc/random/hash.h>
#include <mc/table/alias_table.h>

#include <fmt/format.h>

#include <array>

namespace checker_bench {
namespace {

using mc::pi;

double normal(Pcg& q) {
  const double radius = std::sqrt(-2 * std::log1p(-uniform(q)));
  return radius * std::cos(2 * pi<double> * uniform(q));
}

// Returns the logarithm of a gamma variate of any shape > 0, by [MarsagliaTsang00] and a power of a uniform.
double log_gamma(Pcg& q, double shape) {
  const double d = shape + 1 - 1.0 / 3, c = 1 / std::sqrt(9 * d);
  for (;;) {
    const double x = normal(q), w = 1 + c * x, v = w * w * w;
    if (v > 0 && std::log1p(-uniform(q)) < 0.5 * x * x + d - d * v + d * std::log(v))
      return std::log(d * v) + std::log1p(-uniform(q)) / shape;
  }
}

// A lobe of width (1 - g)^2 by the usual formula, which cancels near the pole.
template <mc::Real S> Subject cancelling_lobe(const char* name, double one_minus_g) {
  const S g = static_cast<S>(1 - one_minus_g);
  return make_subject(
      fmt::format("{} of g = 1 - {:.3g}", name, one_minus_g), mc::Sphere<S>{},
      [g](Pcg& q) -> mc::Vec3<S> {
        const S u = q.uniform<S>(), phi = 2 * pi<S> * q.uniform<S>(), s = (1 - g * g) / (1 - g + 2 * g * u);
        const S z = (1 + g * g - s * s) / (2 * g), r = std::sqrt(std::max(S(0), 1 - z * z));
        return {r * std::cos(phi), r * std::sin(phi), z};
      },
      [g](const mc::Vec3<S>& w) {
        const S d = 1 + g * g - 2 * g * w.z();
        return (1 - g * g) / (4 * pi<S> * d * std::sqrt(d));
      });
}

// Returns the cosine of [Wood94] for three dimensions, by rejection. It does not end if 1 + 1 / (2 kappa) rounds to 1.
template <mc::Real S> S wood_cosine(Pcg& q, S kappa) {
  const S b = 1 / (kappa + std::sqrt(kappa * kappa + 1)), x0 = (1 - b) / (1 + b),
          c = kappa * x0 + 2 * std::log(1 - x0 * x0);
  for (;;) {
    const S z = q.uniform<S>(), u = q.uniform<S>(), w = (1 - (1 + b) * z) / (1 - (1 - b) * z);
    if (kappa * w + 2 * std::log(1 - x0 * w) - c >= std::log(u)) return w;
  }
}

template <mc::Real S> Subject wood(const char* name, double kappa) {
  return make_subject(
      fmt::format("{} of kappa {:.3g}", name, kappa), mc::Sphere<S>{},
      [k = static_cast<S>(kappa)](Pcg& q) -> mc::Vec3<S> {
        const S z = wood_cosine(q, k), phi = 2 * pi<S> * q.uniform<S>(), r = std::sqrt(std::max(S(0), 1 - z * z));
        return {r * std::cos(phi), r * std::sin(phi), z};
      },
      [k = static_cast<S>(kappa)](const mc::Vec3<S>& w) {
        return k / (2 * pi<S> * (1 - std::exp(-2 * k))) * std::exp(k * (w.z() - 1));
      });
}

} // namespace

Subject beta_subject(double a, double b, double sampled_a, double sampled_b) {
  const double scale = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b));
  return make_subject(
      fmt::format("beta {:.3g} {:.3g}", a, b), mc::Interval<double>(0, 1),
      [=](Pcg& q) {
        const double x = log_gamma(q, sampled_a), y = log_gamma(q, sampled_b), t = std::exp(-std::abs(x - y));
        return x < y ? t / (1 + t) : 1 / (1 + t);
      },
      [=](double x) { return scale * std::pow(x, a - 1) * std::pow(1 - x, b - 1); });
}

Subject dirichlet_subject(const std::array<double, 3>& a, const std::array<double, 3>& sampled) {
  const double scale =
      std::exp(std::lgamma(a[0] + a[1] + a[2]) - std::lgamma(a[0]) - std::lgamma(a[1]) - std::lgamma(a[2]));
  return make_subject(
      fmt::format("Dirichlet {:.3g} {:.3g} {:.3g}", a[0], a[1], a[2]), mc::Triangle<double>{},
      [=](Pcg& q) {
        std::array<double, 3> g{log_gamma(q, sampled[0]), log_gamma(q, sampled[1]), log_gamma(q, sampled[2])};
        const double largest = std::max({g[0], g[1], g[2]});
        for (double& x : g) x = std::exp(x - largest);
        const double sum = g[0] + g[1] + g[2];
        return mc::Vec2<double>(g[0] / sum, g[1] / sum);
      },
      [=](const mc::Vec2<double>& x) {
        return scale * std::pow(x[0], a[0] - 1) * std::pow(x[1], a[1] - 1) * std::pow(1 - x[0] - x[1], a[2] - 1);
      });
}

Subject narrow_lobe(bool in_float, bool of_wood, double width) {
  if (of_wood) return in_float ? wood<float>("Wood in float", 1 / width) : wood<double>("Wood", 1 / width);
  return in_float ? cancelling_lobe<float>("Henyey-Greenstein in float", std::sqrt(width))
                  : cancelling_lobe<double>("Henyey-Greenstein", std::sqrt(width));
}

Subject uniform_outcomes(std::size_t n) {
  Subject s;
  s.name = fmt::format("{} uniform outcomes", n);
  s.atoms.assign(n, 1 / static_cast<double>(n));
  s.mass_tolerance = 64 * s.epsilon;
  s.draw = [n](std::uint64_t seed, std::size_t count, std::vector<Subject::Draw>& out) {
    Pcg q(seed);
    for (std::size_t i = 0; i < count; ++i) {
      out.emplace_back().kind = Subject::Draw::Kind::atom;
      out.back().atom = static_cast<int>(uniform(q) * static_cast<double>(n));
    }
  };
  return s;
}

Subject random_rounded(std::uint64_t seed) {
  Pcg r(mc::hash(seed, 79));
  const auto kind = random_index(r, 5);
  switch (kind) {
  case 0: {
    const double a = log_uniform(r, 0.05, 3), b = log_uniform(r, 0.05, 3);
    return beta_subject(a, b, a, b);
  }
  case 1: {
    const std::array<double, 3> a{log_uniform(r, 0.15, 3), log_uniform(r, 0.15, 3), log_uniform(r, 0.15, 3)};
    return dirichlet_subject(a, a);
  }
  case 2:
  case 3: {
    const bool in_float = kind == 2, of_wood = random_index(r, 2) == 0;
    return narrow_lobe(in_float, of_wood, log_uniform(r, in_float ? 1e-5 : 1e-14, 1));
  }
  default: return uniform_outcomes(static_cast<std::size_t>(log_uniform(r, 1, 1e7)));
  }
}

} // namespace checker_bench
