// Warps of the line.
#include "sweep.h"

#include <mc/warp/exponential.h>
#include <mc/warp/linear.h>
#include <mc/warp/logistic.h>
#include <mc/warp/normal.h>
#include <mc/warp/power.h>
#include <mc/warp/smoothstep.h>
#include <mc/warp/tent.h>
#include <mc/warp/uniform.h>

namespace sweep {
namespace {

double d(const auto& x) { return static_cast<double>(x); }

template <class S> S number(Draw& r) { return S(r.often(0.2) ? 0 : r.sign() * r.log(denormal<S>, largest<S>)); }
template <class S> S positive(Draw& r) { return S(r.log(denormal<S>, largest<S>)); }

template <class S> void add_polynomials(std::vector<Row>& rows, const std::string& scalar, const Effort& effort) {
  rows.push_back(run(
      "UniformInterval " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const S lo = number<S>(r), hi = number<S>(r);
        p = fmt::format("lo {} hi {}", lo, hi);
        return mc::UniformInterval<S>(lo, hi);
      },
      [](const auto& w) {
        const double lo = d(w.interval.lo), hi = d(w.interval.hi);
        const double stretch = 4 * std::max(std::abs(lo), std::abs(hi)) / (hi - lo);
        return [=](auto, auto) {
          return Bounds{
              .sample = 4, .pdf = 4, .invert = std::max(4.0, stretch), .scale = std::max(std::abs(lo), std::abs(hi))};
        };
      }));
  rows.push_back(run(
      "Linear " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const S a = r.often(0.1) ? S(0) : positive<S>(r), b = r.often(0.1) ? S(0) : positive<S>(r);
        p = fmt::format("a {} b {}", a, b);
        return mc::Linear<S>(a, b);
      },
      constant({.invert = 8})));
  rows.push_back(run(
      "Tent " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const S c = r.often(0.5) ? S(0) : number<S>(r), h = positive<S>(r);
        p = fmt::format("center {} radius {}", c, h);
        return mc::Tent<S>(c, h);
      },
      [](const mc::Tent<S>& w) {
        const double far = std::abs(d(w.center)) / d(w.radius);
        return [=](auto, auto x) {
          const double rest = 1 - std::abs(d(x) - d(w.center)) / d(w.radius);
          return Bounds{.sample = 8,
                        .pdf = rest > 1e-6 ? 16 + 4 * (1 + far) / rest : HUGE_VAL,
                        .invert = 8 + 4 * far,
                        .scale = d(w.radius)};
        };
      }));
  rows.push_back(run(
      "Smoothstep " + scalar, effort, [](Draw&, std::string&) { return mc::Smoothstep<S>{}; },
      constant({.invert = 8})));
  rows.push_back(run(
      "Power " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const S n = r.often(0.1) ? S(0) : positive<S>(r);
        p = fmt::format("n {}", n);
        return mc::Power<S>(n);
      },
      [](const auto& w) { return [=](auto, auto) { return Bounds{.pdf = 16 + d(w.n), .invert = 8 + d(w.n) / 2}; }; }));
}

template <class S> void add_exponentials(std::vector<Row>& rows, const std::string& scalar, const Effort& effort) {
  rows.push_back(run(
      "Exponential " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const S rate = positive<S>(r);
        p = fmt::format("rate {}", rate);
        return mc::Exponential<S>(rate);
      },
      [](const auto& w) {
        return [=](auto, auto x) {
          return Bounds{.sample = 8, .pdf = 4 + 2 * d(w.rate) * d(x), .invert = 8, .scale = 1 / d(w.rate)};
        };
      }));
  rows.push_back(run(
      "TrimmedExponential " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const S rate = number<S>(r), length = positive<S>(r);
        p = fmt::format("rate {} length {}", rate, length);
        return mc::TrimmedExponential<S>(rate, length);
      },
      [](const auto& w) {
        const double k = std::abs(d(w.rate)) * d(w.length);
        return [=](auto, auto x) {
          const double t = std::abs(d(w.rate)) * (w.rate < 0 ? d(w.length) - d(x) : d(x));
          const double shift = w.rate < 0 ? k : t; // from the rounding of x
          return Bounds{.sample = 16,
                        .pdf = 16 + 2 * t + 2 * shift,
                        .invert = std::max(16.0, w.rate < 0 ? k : 0),
                        .scale = w.rate < 0 ? d(w.length) : std::min(d(w.length), 1 / std::max(d(w.rate), 1e-300))};
        };
      }));
}

template <class S> void add_bells(std::vector<Row>& rows, const std::string& scalar, const Effort& effort) {
  rows.push_back(run(
      "Normal " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const S m = r.often(0.5) ? S(0) : number<S>(r), s = positive<S>(r);
        p = fmt::format("mean {} sigma {}", m, s);
        return mc::Normal<S>(m, s);
      },
      [](const auto& w) {
        return [=](auto, auto x) {
          const double t = (d(x) - d(w.mean)) / d(w.sigma), far = std::abs(d(w.mean)) / d(w.sigma);
          return Bounds{.sample = 16,
                        .pdf = 16 + 4 * t * t + 4 * std::abs(t) * far,
                        .invert = 16 + 4 * far,
                        .scale = d(w.sigma),
                        .reversal = w.mean == 0 ? 4.0 : 4 + 4 * far};
        };
      }));
  rows.push_back(run(
      "Logistic " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const S m = r.often(0.5) ? S(0) : number<S>(r), s = positive<S>(r);
        p = fmt::format("mean {} scale {}", m, s);
        return mc::Logistic<S>(m, s);
      },
      [](const auto& w) {
        return [=](auto, auto x) {
          const double t = std::abs(d(x) - d(w.mean)) / d(w.scale), far = std::abs(d(w.mean)) / d(w.scale);
          return Bounds{.sample = 16, .pdf = 8 + 2 * t + 2 * far, .invert = 8 + 4 * far, .scale = d(w.scale)};
        };
      }));
  rows.push_back(run(
      "TrimmedLogistic " + scalar, effort,
      [&](Draw& r, std::string& p) {
        const S s = positive<S>(r);
        const double around = r.often(0.5) ? d(s) * 100 : largest<S>;
        const auto end = [&] { return S(r.often(0.1) ? 0 : r.sign() * r.log(std::min(d(s) * 1e-9, around), around)); };
        const S lo = end(), hi = r.often(0.2) ? S(lo + std::abs(d(lo)) * r.log(1e-18, 1)) : end();
        p = fmt::format("scale {} lo {} hi {}", s, lo, hi);
        return mc::TrimmedLogistic<S>(s, lo, hi);
      },
      [](const auto& w) {
        const double least = std::min(d(w.scale), d(w.hi) - d(w.lo));
        const double stretch = std::max(1.0, std::max(std::abs(d(w.lo)), std::abs(d(w.hi))) / least);
        return [=](auto, auto x) {
          const double inner = d(w.lo) >= 0 ? d(w.lo) : std::min(d(w.hi), 0.0); // the end nearest to 0, or 0 inside
          return Bounds{
              .sample = 16, .pdf = 8 + 2 * std::abs(d(x) - inner) / d(w.scale), .invert = 8 * stretch, .scale = least};
        };
      }));
}

template <class S> void add(std::vector<Row>& rows, const std::string& scalar, const Effort& effort) {
  add_polynomials<S>(rows, scalar, effort);
  add_exponentials<S>(rows, scalar, effort);
  add_bells<S>(rows, scalar, effort);
}

} // namespace

std::vector<Row> intervals(const Effort& effort) {
  std::vector<Row> rows;
  add<float>(rows, "float", effort);
  add<double>(rows, "double", effort);
  return rows;
}

} // namespace sweep
