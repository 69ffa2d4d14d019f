#include <mc/check/regression_subjects.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/box.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/random/hash.h>

#include <fmt/format.h>

#include <numbers>

namespace checker_bench {
namespace {

using mc::sqr;
using V2 = mc::Vec2<double>;
using V3 = mc::Vec3<double>;
constexpr double pi = std::numbers::pi;

using RegressionSubjects = std::vector<RegressionSubject>;

std::vector<double> texels(std::size_t n, double power) {
  Pcg random(n);
  std::vector<double> w;
  for (std::size_t i = 0; i < n; ++i) w.push_back(std::pow(uniform(random), power));
  return w;
}

// Returns a multiplicative cascade: each of `digits` digits in base `base` multiplies by .6 or 1.4.
std::vector<double> cascade(std::size_t base, int digits, std::uint64_t seed) {
  std::vector<double> w{1};
  for (int level = 0; level < digits; ++level) {
    std::vector<double> finer;
    for (std::size_t i = 0; i < w.size(); ++i)
      for (std::size_t k = 0; k < base; ++k)
        finer.push_back(w[i] * (mc::hash(mc::hash(seed, i), k, static_cast<std::uint64_t>(level)) & 1 ? 0.6 : 1.4));
    w = std::move(finer);
  }
  return w;
}

std::vector<double> sky(std::size_t width, std::size_t height) {
  std::vector<double> w(width * height);
  double sum = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    const std::size_t row = i / width;
    sum += w[i] = 1 + std::cos(3 * static_cast<double>(row) / static_cast<double>(height));
  }
  for (std::size_t y = height / 5; y < height / 5 + 4; ++y)
    for (std::size_t x = width / 3; x < width / 3 + 4; ++x) w[y * width + x] += sum / 16;
  return w;
}

void tables(RegressionSubjects& all) {
  for (const bool named : {true, false}) {
    const auto plane = [&](const char* what, const std::vector<double>& w, std::size_t width) {
      const std::size_t height = w.size() / width;
      const char* breaks = named ? "with breaks" : "without breaks";
      all.push_back(
          {table_subject(fmt::format("table {}x{} {} {}", width, height, what, breaks), w, width, height, named),
           true});
    };
    const auto line = [&](const char* what, const std::vector<double>& w) {
      all.push_back(
          {table_subject(fmt::format("table of {} {} {}", w.size(), what, named ? "with breaks" : "without breaks"), w,
                         named),
           true});
    };
    plane("u^4", texels(256 * 128, 4), 256);
    std::vector<double> bright(512 * 256, 1);
    bright[70'000] = 5e4;
    plane("one bright texel", bright, 512);
    plane("u", texels(256 * 128, 1), 256);
    plane("u", texels(100 * 50, 1), 100);
    plane("u", texels(64 * 32, 1), 64);
    plane("sky with sun", sky(1000, 500), 1000);
    plane("sky with sun", sky(2048, 1024), 2048);
    line("u^4", texels(100'000, 4));
    line("u", texels(100'000, 1));
    line("cascade", cascade(2, 14, 1));
    const std::vector<double> x = cascade(3, 7, 2), y = cascade(3, 7, 3);
    std::vector<double> both;
    for (const double a : y)
      for (const double b : x) both.push_back(a * b);
    plane("two cascades", both, x.size());
  }
}

void lobes_tails_and_edges(RegressionSubjects& all) {
  const V3 pole = V3(0.3, -0.5, 0.6).normalized();
  all.push_back({lobe_on_sphere(1e-4, 1e8, pole), true});
  all.push_back({lobe_on_sphere(1e-5, 1e6, pole), true});
  all.push_back(
      {make_subject(
           "Pareto of alpha .5", mc::HalfLine<double>(0, 1), [](Pcg& r) { return 1 / sqr(1 - uniform(r)) - 1; },
           [](double x) { return x >= 0 ? 0.5 * std::pow(1 + x, -1.5) : 0.0; }),
       true});
  all.push_back({make_subject(
                     "log-logistic of scale 1.5", mc::HalfLine<double>(0, 1),
                     [](Pcg& r) {
                       const double u = uniform(r);
                       return 1.5 * u / (1 - u);
                     },
                     [](double x) { return x >= 0 ? 1 / (1.5 * sqr(1 + x / 1.5)) : 0.0; }),
                 true});
  all.push_back({make_subject(
                     "1 / (2 sqrt x) thrice", mc::Box<double, 3>{},
                     [](const V3& u) { return V3(sqr(u[0]), sqr(u[1]), sqr(u[2])); },
                     [](const V3& x) { return 0.125 / std::sqrt(x[0] * x[1] * x[2]); }),
                 true});
  all.push_back({uniform_inside("skew strip", 0.1,
                                [](const V2& p) {
                                  const double y = p[1] - 0.45 - 0.35 * (p[0] - 0.5);
                                  return y >= 0 && y < 0.1;
                                }),
                 true});
  all.push_back({uniform_ball_in_box(0.5), true});
  all.push_back({uniform_inside("checkerboard 100x100", 0.5,
                                [](const V2& p) {
                                  return (static_cast<int>(100 * p[0]) + static_cast<int>(100 * p[1])) % 2 == 0;
                                }),
                 true});
}

Subject square(std::string name, std::function<V2(Pcg&)> sample) {
  return make_subject(std::move(name), mc::Square<double>{}, std::move(sample), [](const V2&) { return 1.0; });
}

// Returns samples of the square with a density proportional to f <= most.
Subject thinned(std::string name, double most, const std::function<double(double, double)>& f) {
  return square(std::move(name), [=](Pcg& r) {
    for (;;)
      if (const double x = uniform(r), y = uniform(r); most * uniform(r) < f(x, y)) return V2(x, y);
  });
}

void fine_faults(RegressionSubjects& all) {
  for (const double n : {128.0, 256.0})
    all.push_back({square(fmt::format("one offset for both axes of {:.0f}", n),
                          [=](Pcg& r) {
                            const double offset = uniform(r);
                            return V2((std::floor(n * uniform(r)) + offset) / n,
                                      (std::floor(n * uniform(r)) + offset) / n);
                          }),
                   false});
  all.push_back({thinned("50 % on a checkerboard of 1/128", 1.5,
                         [](double x, double y) {
                           return (static_cast<int>(128 * x) + static_cast<int>(128 * y)) % 2 ? 1.5 : 0.5;
                         }),
                 false});
  all.push_back({thinned("half of all 1/256 squares empty", 1,
                         [](double x, double y) {
                           const auto cell =
                               static_cast<std::uint64_t>(256 * x) * 256 + static_cast<std::uint64_t>(256 * y);
                           return mc::mix64(cell + 1) & 1 ? 1.0 : 0.0;
                         }),
                 false});
  all.push_back({square("8 bits sheared",
                        [](Pcg& r) {
                          const double y = uniform(r), x = std::floor(256 * uniform(r)) / 256 + y;
                          return V2(x - std::floor(x), y);
                        }),
                 false});
  const auto sign = [](double x, double y) {
    const auto cell = static_cast<std::uint64_t>(61 * x) * 61 + static_cast<std::uint64_t>(61 * y);
    return mc::mix64(cell + 1) & 1 ? 1.0 : -1.0;
  };
  // Sizes that a report of 1e6 samples at alpha = 1 % states as detectable.
  all.push_back(
      {thinned("random signs of 5.5 % on 61x61", 1.055, [=](double x, double y) { return 1 + 0.055 * sign(x, y); }),
       false});
  all.push_back({thinned("one of 61x61 cells 100 % more", 2,
                         [](double x, double y) {
                           return static_cast<int>(61 * x) == 17 && static_cast<int>(61 * y) == 40 ? 2.0 : 1.0;
                         }),
                 false});
  all.push_back({thinned("waves of 40 periods", 1.1,
                         [](double x, double y) { return 1 + 0.1 * std::cos(80 * pi * x) * std::cos(80 * pi * y); }),
                 false});
}

// Returns directions with cosine c and azimuth t that claim to be cosine distributed.
Subject cosine(std::string name, const std::function<std::array<double, 2>(Pcg&)>& sample) {
  return make_subject(
      std::move(name), mc::Hemisphere<double>{},
      [=](Pcg& r) {
        const auto [c, t] = sample(r);
        const double s = std::sqrt(1 - c * c);
        return V3(s * std::cos(t), s * std::sin(t), c);
      },
      [](const V3& w) { return w.z() > 0 ? w.z() / pi : 0.0; });
}

void rare_faults(RegressionSubjects& all) {
  using Pair = std::array<double, 2>;
  all.push_back({cosine(".03 % in cos^10000 at the pole",
                        [](Pcg& r) {
                          const double c =
                              uniform(r) < 3e-4 ? std::pow(1 - uniform(r), 1 / 10001.0) : std::sqrt(1 - uniform(r));
                          return Pair{c, 2 * pi * uniform(r)};
                        }),
                 false});
  all.push_back({cosine("a gap of 1e-4 in azimuth",
                        [](Pcg& r) {
                          return Pair{std::sqrt(1 - uniform(r)), 2 * pi * (0.3 + (1 - 1e-4) * uniform(r))};
                        }),
                 false});
  all.push_back({cosine("a polar hole of 1e-4",
                        [](Pcg& r) {
                          return Pair{std::sqrt((1 - 1e-4) * (1 - uniform(r))), 2 * pi * uniform(r)};
                        }),
                 false});
  all.push_back({make_subject(
                     "exponential clamped at 12", mc::HalfLine<double>(0, 1),
                     [](Pcg& r) { return std::min(-std::log(1 - uniform(r)), 12.0); },
                     [](double x) { return x >= 0 ? std::exp(-x) : 0.0; }),
                 false});
  all.push_back({cosine("z clamped at 1 - 1e-5",
                        [](Pcg& r) {
                          return Pair{std::min(std::sqrt(1 - uniform(r)), 1 - 1e-5), 2 * pi * uniform(r)};
                        }),
                 false});
}

} // namespace

std::vector<RegressionSubject> regression_subjects() {
  RegressionSubjects all;
  tables(all);
  lobes_tails_and_edges(all);
  fine_faults(all);
  rare_faults(all);
  return all;
}

} // namespace checker_bench
