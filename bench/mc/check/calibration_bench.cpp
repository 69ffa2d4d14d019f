// How often the checker rejects right samplers, and how often it finds wrong ones, at alpha = 1 %.
// Usage: bench_mc_check_calibration [SEEDS [SAMPLES]]; prints one line per density: runs, false rejections, inconclusive.
// Within the binomial range of alpha, right samplers of N runs are rejected at most N / 100 + 3 sqrt(N / 100) times.

#include <mc/check/check_subject.h>
#include <mc/check/make_subject.h>
#include <mc/core/frame.h>
#include <mc/core/parallel.h>
#include <mc/domain/hemisphere.h>
#include <mc/table/table_dist_2d.h>
#include <mc/warp/beckmann.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/spherical_triangle.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/von_mises_fisher.h>

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

namespace {

using V = mc::Vec3<double>;
using mc::Pcg;
constexpr double pi = std::numbers::pi;

struct Row { mc::Subject subject; bool right; };

V incident(double degrees) {
  const double t = degrees * pi / 180;
  return {std::sin(t), 0, std::cos(t)};
}

V cosine(Pcg& r) { return mc::CosineHemisphere<double>{}.sample(r.point<double, 2>()); }
double cosine_pdf(const V& w) { return w.z() > 0 ? w.z() / pi : 0.0; }
V rotated(const V& w, double degrees) {
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  return {c * w.x() - s * w.y(), s * w.x() + c * w.y(), w.z()};
}

std::vector<Row> rows() {
  std::vector<Row> rows;
  const auto right = [&](const std::string& name, const auto& warp) { rows.push_back({make_subject(name, warp), true}); };
  right("cosine hemisphere", mc::CosineHemisphere<double>{});
  right("uniform hemisphere", mc::UniformHemisphere<double>{});
  for (const double a : {0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 1e-3, 1e-4}) right(fmt::format("GGX normals alpha={:g}", a), mc::TrowbridgeReitzNormals<double>(a));
  for (const double a : {0.1, 0.05}) right(fmt::format("Beckmann normals alpha={:g}", a), mc::BeckmannNormals<double>(a));
  for (const double g : {0.8, 0.95, 0.99, 0.999}) right(fmt::format("Henyey-Greenstein g={:g}", g), mc::HenyeyGreenstein<double>(g));
  right("von Mises-Fisher kappa=1e6", mc::VonMisesFisher<double>(1e6));
  const auto visible = [](double ax, double ay, double theta) { return mc::TrowbridgeReitzVisibleNormals<double>(incident(theta), ax, ay); };
  right("GGX visible alpha=0.3 theta=60", visible(0.3, 0.3, 60));
  right("GGX visible alpha=0.1 theta=75", visible(0.1, 0.1, 75));
  right("GGX visible alpha=0.05 theta=85", visible(0.05, 0.05, 85));
  right("GGX visible alpha=0.3,0.05 theta=60", visible(0.3, 0.05, 60));
  for (const double a : {1e-3, 1e-4})
    for (const double theta : {0.0, 60.0, 85.0, 89.9}) right(fmt::format("GGX visible alpha={:g} theta={:g}", a, theta), visible(a, a, theta));
  right("spherical triangle of 1e-7 sr", mc::SphericalTriangle<double>(V(0, 0, 1), V(4.5e-4, 0, 0), V(0, 4.5e-4, 0)));
  right("table 2048x1024 with a sun", [] {
    std::vector<double> w(2048 * 1024);
    double sum = 0;
    for (std::size_t i = 0; i < w.size(); ++i) sum += w[i] = 1 + std::cos(3.0 * static_cast<double>(i / 2048) / 1024);
    for (std::size_t y = 200; y < 206; ++y)
      for (std::size_t x = 700; x < 706; ++x) w[y * 2048 + x] += sum / 36;
    return mc::TableDist2D<double>(w, 2048, 1024);
  }());

  const mc::Hemisphere<double> hemisphere;
  const auto wrong = [&](const char* name, auto sampler, auto pdf) { rows.push_back({make_subject(name, hemisphere, sampler, pdf), false}); };
  const auto mixed = [](double share, auto other) { return [=](Pcg& r) { return r.uniform<double>() < share ? V(other(r)) : cosine(r); }; };
  const auto uniform = [](Pcg& r) { return mc::UniformHemisphere<double>{}.sample(r.point<double, 2>()); };
  const auto below = [](Pcg& r) {
    V w = cosine(r);
    w.z() = -w.z();
    return w;
  };
  const auto power = [](double exponent) {
    return [=](Pcg& r) {
      const double c = std::pow(1 - r.uniform<double>(), 0.5 * exponent);
      return mc::spherical_direction<double>(std::sqrt(1 - c * c), c, 2 * pi * r.uniform<double>());
    };
  };
  wrong("cosine: pdf x 1.01", cosine, [](const V& w) { return 1.01 * cosine_pdf(w); });
  wrong("cosine: pdf x 1.003", cosine, [](const V& w) { return 1.003 * cosine_pdf(w); });
  wrong("cosine: 1e-3 uniform", mixed(1e-3, uniform), cosine_pdf);
  wrong("cosine: 1e-2 uniform", mixed(1e-2, uniform), cosine_pdf);
  wrong("cosine: 1e-4 NaN", mixed(1e-4, [](Pcg&) { return V(std::nan(""), 0, 1); }), cosine_pdf);
  wrong("cosine: 5e-6 below horizon", mixed(5e-6, below), cosine_pdf);
  wrong("cosine: 1e-3 below horizon", mixed(1e-3, below), cosine_pdf);
  wrong("cosine: not unit", [](Pcg& r) { const V w = cosine(r); return V(1.1 * w.x(), 1.1 * w.y(), w.z()); }, cosine_pdf);
  wrong("cosine: 1e-2 mirrored", [](Pcg& r) { V w = cosine(r); if (w.x() < 0 && r.uniform<double>() < 0.01) w.x() = -w.x(); return w; }, cosine_pdf);
  wrong("cosine: 1e-3 spike", mixed(1e-3, [](Pcg&) { return V(0, 0, 1); }), cosine_pdf);
  wrong("cosine: exponent 1.005", power(1.005), cosine_pdf);
  wrong("cosine: exponent 1.02", power(1.02), cosine_pdf);
  wrong("cosine: u clamped to 1e-3", [](Pcg& r) {
    const double u = std::clamp(r.uniform<double>(), 1e-3, 1 - 1e-3), v = std::clamp(r.uniform<double>(), 1e-3, 1 - 1e-3), c = std::sqrt(1 - u);
    return mc::spherical_direction<double>(std::sqrt(u), c, 2 * pi * v);
  }, cosine_pdf);
  wrong("cosine: phi = 2 * 3.14 v", [](Pcg& r) {
    const double u = r.uniform<double>();
    return mc::spherical_direction<double>(std::sqrt(u), std::sqrt(1 - u), 6.28 * r.uniform<double>());
  }, cosine_pdf);
  const auto ggx = visible(0.3, 0.3, 60);
  const auto ggx_pdf = [ggx](const V& m) { return ggx.pdf(m); };
  const auto from = [](auto warp) { return [warp](Pcg& r) { return warp.sample(r.point<double, 2>()); }; };
  wrong("visible: pdf x 1.01", from(ggx), [ggx](const V& m) { return 1.01 * ggx.pdf(m); });
  wrong("visible: 1e-3 uniform", [=](Pcg& r) { return r.uniform<double>() < 1e-3 ? uniform(r) : ggx.sample(r.point<double, 2>()); }, ggx_pdf);
  wrong("visible: phi rotated by 0.5 degree", [=](Pcg& r) { return rotated(ggx.sample(r.point<double, 2>()), 0.5); }, ggx_pdf);
  wrong("visible: alpha x 1.003", from(visible(0.3009, 0.3009, 60)), ggx_pdf);
  wrong("visible: alpha x 1.01", from(visible(0.303, 0.303, 60)), ggx_pdf);
  wrong("visible: alpha x 1.03", from(visible(0.309, 0.309, 60)), ggx_pdf);
  wrong("visible: 60.5 instead of 60 degrees", from(visible(0.3, 0.3, 60.5)), ggx_pdf);
  wrong("visible: alpha_y x 1.01", from(visible(0.3, 0.303, 60)), ggx_pdf);
  return rows;
}

} // namespace

int main(int argc, char** argv) {
  const auto seeds = static_cast<std::size_t>(argc > 1 ? std::atoi(argv[1]) : 20);
  const auto samples = static_cast<std::uint64_t>(argc > 2 ? std::atof(argv[2]) : 1e6);
  const std::string only = argc > 3 ? argv[3] : "";
  fmt::print("{:<42} {:>6} {:>9} {:>13} {:>9}\n", "density, alpha = 1 %", "runs", "rejected", "inconclusive", "s per run");
  for (const Row& row : rows()) {
    if (!only.empty() && only != (row.right ? "right" : "wrong")) continue;
    std::vector<mc::Report> reports(seeds);
    mc::parallel_for(seeds, 0, [&](std::size_t i) { reports[i] = check_subject(row.subject, {.samples = samples, .seed = i + 1, .alpha = 0.01}); });
    std::size_t rejected = 0, inconclusive = 0;
    double seconds = 0;
    for (const mc::Report& r : reports) {
      rejected += r.verdict() == mc::Verdict::fail;
      inconclusive += r.verdict() == mc::Verdict::inconclusive;
      seconds += r.seconds;
    }
    fmt::print("{:<42} {:>6} {:>9} {:>13} {:>9.3f}\n", row.subject.name, seeds, rejected, inconclusive, seconds / static_cast<double>(seeds));
    for (const mc::Report& r : reports)
      if (row.right && !r.passed()) {
        fmt::print("  {}\n", r.to_string());
        break;
      }
    std::fflush(stdout);
  }
}
