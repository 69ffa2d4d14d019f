// How often the checker rejects right samplers at alpha = 1 %; power_bench.cpp counts how often it finds wrong ones.
// Usage: bench_mc_check_calibration [SEEDS [SAMPLES]]; prints one line per density: runs, false rejections, inconclusive.
// Within the binomial range of alpha, right samplers of N runs are rejected at most N / 100 + 3 sqrt(N / 100) times.

#include <mc/check/check_subject.h>
#include <mc/check/make_subject.h>
#include <mc/core/parallel.h>
#include <mc/table/table_dist_2d.h>
#include <mc/warp/beckmann.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/spherical_triangle.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/von_mises_fisher.h>

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>

namespace {

using V = mc::Vec3<double>;
constexpr double pi = std::numbers::pi;

V incident(double degrees) {
  const double t = degrees * pi / 180;
  return {std::sin(t), 0, std::cos(t)};
}

std::vector<mc::Subject> subjects() {
  std::vector<mc::Subject> subjects;
  const auto right = [&](const std::string& name, const auto& warp) { subjects.push_back(make_subject(name, warp)); };
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
  return subjects;
}

} // namespace

int main(int argc, char** argv) {
  const auto seeds = static_cast<std::size_t>(argc > 1 ? std::atoi(argv[1]) : 20);
  const auto samples = static_cast<std::uint64_t>(argc > 2 ? std::atof(argv[2]) : 1e6);
  fmt::print("{:<42} {:>6} {:>9} {:>13} {:>9}\n", "density, alpha = 1 %", "runs", "rejected", "inconclusive", "s per run");
  for (const mc::Subject& subject : subjects()) {
    std::vector<mc::Report> reports(seeds);
    mc::parallel_for(seeds, 0, [&](std::size_t i) { reports[i] = check_subject(subject, {.samples = samples, .seed = i + 1, .alpha = 0.01}); });
    std::size_t rejected = 0, inconclusive = 0;
    double seconds = 0;
    for (const mc::Report& r : reports) {
      rejected += r.verdict() == mc::Verdict::fail;
      inconclusive += r.verdict() == mc::Verdict::inconclusive;
      seconds += r.seconds;
    }
    fmt::print("{:<42} {:>6} {:>9} {:>13} {:>9.3f}\n", subject.name, seeds, rejected, inconclusive, seconds / static_cast<double>(seeds));
    for (const mc::Report& r : reports)
      if (!r.passed()) {
        fmt::print("  {}\n", r.to_string());
        break;
      }
    std::fflush(stdout);
  }
}
