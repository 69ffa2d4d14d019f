// Correct subjects in four to six dimensions, and rotations.

#include <mc/check/random_subjects.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/box.h>
#include <mc/warp/rotation.h>

#include <fmt/format.h>

#include <memory>

namespace checker_bench {

using mc::sqr;

namespace {

// A mixture of densities that are products over the axes of a box.
template <int N> struct ProductMixture {
  using Point = mc::Vec<double, N>;
  // Each axis of a part has a power a x^(a - 1), or is uniform between two ends.
  struct Part {
    double weight;
    bool is_power;
    Point a, lo, hi;
  };
  std::vector<Part> parts;

  ProductMixture(Pcg& r, bool powers) {
    double sum = 0;
    for (int k = 1 + random_index(r, 4); k > 0; --k) {
      Part part{log_uniform(r, 0.01, 1), powers, {}, {}, {}};
      for (int i = 0; i < N; ++i) {
        part.a[i] = log_uniform(r, 0.2, 4);
        part.lo[i] = uniform_between(r, 0, 0.5);
        part.hi[i] = uniform_between(r, 0.6, 1);
      }
      sum += part.weight;
      parts.push_back(part);
    }
    for (Part& part : parts) part.weight /= sum;
  }
  Point sample(Pcg& r) const {
    double u = uniform(r);
    std::size_t k = 0;
    for (; k + 1 < parts.size() && u >= parts[k].weight; ++k) u -= parts[k].weight;
    const Part& part = parts[k];
    Point x;
    for (int i = 0; i < N; ++i) {
      const double v = uniform(r);
      x[i] = part.is_power ? std::pow(v, 1 / part.a[i]) : uniform_between(r, part.lo[i], part.hi[i]);
    }
    return x;
  }
  double pdf(const Point& x) const {
    double sum = 0;
    for (const Part& part : parts) {
      double product = part.weight;
      for (int i = 0; i < N; ++i)
        if (part.is_power) product *= part.a[i] * std::pow(x[i], part.a[i] - 1);
        else product *= x[i] >= part.lo[i] && x[i] <= part.hi[i] ? 1 / (part.hi[i] - part.lo[i]) : 0;
      sum += product;
    }
    return sum;
  }
};

template <int N> Subject in_box(Pcg& r) {
  using Point = mc::Vec<double, N>;
  const int kind = random_index(r, 3);
  if (kind < 2) {
    const auto shared = std::make_shared<ProductMixture<N>>(r, kind == 0);
    return make_subject(
        fmt::format("{} {} in {} dimensions", shared->parts.size(), kind == 0 ? "powers" : "boxes", N),
        mc::Box<double, N>{}, [shared](Pcg& random) { return shared->sample(random); },
        [shared](const Point& x) { return shared->pdf(x); });
  }
  const auto inside = [](const Point& x) { return (x.array() - 0.5).matrix().squaredNorm() < 0.25; };
  const double volume = std::pow(std::sqrt(mc::pi<double>) / 2, N) / std::tgamma(1 + N / 2.0);
  return make_subject(
      fmt::format("ball in {} dimensions", N), mc::Box<double, N>{},
      [inside](Pcg& random) {
        for (;;) {
          Point x;
          for (int i = 0; i < N; ++i) x[i] = uniform(random);
          if (inside(x)) return x;
        }
      },
      [inside, volume](const Point& x) { return inside(x) ? 1 / volume : 0.0; });
}

} // namespace

Subject many_dimensions(Pcg& r) {
  switch (random_index(r, 3)) {
  case 0: return in_box<4>(r);
  case 1: return in_box<5>(r);
  default: return in_box<6>(r);
  }
}

Subject rotations(Pcg& r) {
  using Quaternion = mc::Vec<double, 4>;
  const mc::UniformRotation<double> uniform_rotation;
  const auto any = [=](Pcg& random) {
    const double a = uniform(random), b = uniform(random), c = uniform(random);
    return uniform_rotation.sample({a, b, c});
  };
  const Quaternion near = any(r);
  const int power = random_index(r, 12); // of the squared cosine
  // The mean of (q near)^(2 power) over uniform q.
  const double mean = std::tgamma(power + 0.5) / (std::sqrt(mc::pi<double>) * std::tgamma(power + 2.0));
  return make_subject(
      fmt::format("rotations, power {}", power), mc::UnitQuaternions<double>{},
      [=](Pcg& random) {
        for (;;)
          if (const Quaternion q = any(random); uniform(random) < std::pow(sqr(q.dot(near)), power)) return q;
      },
      [=](const Quaternion& q) { return std::pow(sqr(q.dot(near)), power) / (mean * sqr(mc::pi<double>)); });
}

} // namespace checker_bench
