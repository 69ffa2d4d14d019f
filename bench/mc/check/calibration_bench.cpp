// Measures the rate at which the checker rejects correct subjects at alpha = 1 %. power_bench.cpp measures its power.
// Usage: bench_mc_check_calibration [SEEDS [SAMPLES [right|promise [FIRST_SEED [NAME]]]]]. NAME selects the rows that
// contain it.
// Prints for each density: runs, rejections with the 95 % interval of their rate (Clopper-Pearson), inconclusive runs.
// The tests are conservative (discrete counts, KS on cells), so the rate is at most alpha. The kind `promise` measures
// how often the checker detects errors of the size that a report states, which should be .99 of the runs.

#include <mc/check/bsdf_laws.h>
#include <mc/check/check_subject.h>
#include <mc/check/subject/make_subject.h>
#include <mc/core/frame.h>
#include <mc/core/parallel.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/random/hash.h>
#include <mc/table/alias_table.h>
#include <mc/table/table_dist_1d.h>
#include <mc/table/table_dist_2d.h>
#include <mc/warp/beckmann.h>
#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/spherical_triangle.h>
#include <mc/warp/trowbridge_reitz.h>
#include <mc/warp/von_mises_fisher.h>

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <optional>

namespace {

using V = mc::Vec3<double>;
using mc::Pcg;
constexpr double pi = std::numbers::pi;

V incident(double degrees) {
  const double t = degrees * pi / 180;
  return {std::sin(t), 0, std::cos(t)};
}

// A mixture of a perfect mirror and a Lambertian lobe with absorption: an atom, a density and failures at once.
struct Coated {
  struct Sample {
    V wi;
    Eigen::Array3d f;
    double pdf;
    bool delta, transmission;
  };
  Eigen::Array3d eval(const V& wo, const V& wi) const {
    return Eigen::Array3d::Constant(wo.z() > 0 && wi.z() > 0 ? 0.5 / pi : 0);
  }
  double pdf(const V& wo, const V& wi) const { return wo.z() > 0 && wi.z() > 0 ? 0.6 * wi.z() / pi : 0.0; }
  std::optional<Sample> sample(const V& wo, double uc, const mc::Vec2<double>& u) const {
    if (uc < 0.1) return {};
    if (uc < 0.4) return Sample{V(-wo.x(), -wo.y(), wo.z()), Eigen::Array3d::Constant(0.3 / wo.z()), 0.3, true, false};
    const V wi = mc::CosineHemisphere<double>{}.sample(u);
    return Sample{wi, eval(wo, wi), pdf(wo, wi), false, false};
  }
};

// Mirror directions about visible normals; directions below the horizon fail.
template <class S> mc::Subject reflected(const std::string& name, S alpha, double theta) {
  using W = mc::Vec3<S>;
  const W wo = incident(theta).cast<S>();
  const mc::TrowbridgeReitzVisibleNormals<S> normals(wo, alpha, alpha);
  const auto sample = [=](Pcg& r) -> std::optional<W> {
    const W m = normals.sample(r.point<S, 2>());
    const W wi = (2 * wo.dot(m) * m - wo).normalized();
    if (!(wi.z() > 0)) return {};
    return wi;
  };
  const auto pdf = [=](const W& wi) {
    if (!(wi.z() > 0)) return S(0);
    const W m = (wo + wi).normalized();
    return S(normals.pdf(m) / (4 * wo.dot(m)));
  };
  return make_subject(name, mc::Hemisphere<S>{}, sample, pdf);
}

std::vector<mc::Subject> subjects() {
  std::vector<mc::Subject> subjects;
  const auto right = [&](const std::string& name, const auto& warp) { subjects.push_back(make_subject(name, warp)); };
  right("cosine hemisphere", mc::CosineHemisphere<double>{});
  right("uniform hemisphere", mc::UniformHemisphere<double>{});
  for (const double a : {0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 1e-3, 1e-4})
    right(fmt::format("GGX normals alpha={:g}", a), mc::TrowbridgeReitzNormals<double>(a));
  for (const double a : {0.1, 0.05})
    right(fmt::format("Beckmann normals alpha={:g}", a), mc::BeckmannNormals<double>(a));
  for (const double g : {0.8, 0.95, 0.99, 0.999})
    right(fmt::format("Henyey-Greenstein g={:g}", g), mc::HenyeyGreenstein<double>(g));
  right("von Mises-Fisher kappa=1e6", mc::VonMisesFisher<double>(1e6));
  const auto visible = [](double ax, double ay, double theta) {
    return mc::TrowbridgeReitzVisibleNormals<double>(incident(theta), ax, ay);
  };
  right("GGX visible alpha=0.3 theta=60", visible(0.3, 0.3, 60));
  right("GGX visible alpha=0.1 theta=75", visible(0.1, 0.1, 75));
  right("GGX visible alpha=0.05 theta=85", visible(0.05, 0.05, 85));
  right("GGX visible alpha=0.3,0.05 theta=60", visible(0.3, 0.05, 60));
  for (const double a : {1e-3, 1e-4})
    for (const double theta : {0.0, 60.0, 85.0, 89.9})
      right(fmt::format("GGX visible alpha={:g} theta={:g}", a, theta), visible(a, a, theta));
  right("spherical triangle of 1e-7 sr", mc::SphericalTriangle<double>(V(0, 0, 1), V(4.5e-4, 0, 0), V(0, 4.5e-4, 0)));
  right("table 2048x1024 with a sun", [] {
    std::vector<double> w(2048 * 1024);
    double sum = 0;
    for (std::size_t i = 0; i < w.size(); ++i) {
      const std::size_t row = i / 2048;
      sum += w[i] = 1 + std::cos(3.0 * static_cast<double>(row) / 1024);
    }
    for (std::size_t y = 200; y < 206; ++y)
      for (std::size_t x = 700; x < 706; ++x) w[y * 2048 + x] += sum / 36;
    return mc::TableDist2D<double>(w, 2048, 1024);
  }());

  // Additional subjects: float at the extremes, failures, atoms, outcomes.
  for (const float a : {1e-2f, 1e-4f})
    right(fmt::format("GGX normals alpha={:g} float", a), mc::TrowbridgeReitzNormals<float>(a));
  for (const double theta : {0.0, 89.9})
    right(fmt::format("GGX visible alpha=0.001 theta={:g} float", theta),
          mc::TrowbridgeReitzVisibleNormals<float>(incident(theta).cast<float>(), 1e-3f, 1e-3f));
  right("Henyey-Greenstein g=0.999 float", mc::HenyeyGreenstein<float>(0.999f));
  right("von Mises-Fisher kappa=1e6 float", mc::VonMisesFisher<float>(1e6f));
  subjects.push_back(reflected<double>("GGX reflection alpha=0.5 theta=80, failures", 0.5, 80));
  subjects.push_back(reflected<float>("GGX reflection alpha=0.3 theta=85, failures", 0.3f, 85));
  subjects.push_back(mc::bsdf_subject<double>(Coated{}, incident(30), {.name = "coated: mirror, Lambert, absorption"}));
  subjects.push_back(make_discrete_subject("alias table of 1000, weights 1e-3 to 1e3", mc::AliasTable([] {
                                             std::vector<double> w(1000);
                                             for (std::size_t i = 0; i < w.size(); ++i)
                                               if (i % 5 != 0)
                                                 w[i] = std::pow(10.0, static_cast<double>(i * 37 % 61) / 10.0 - 3);
                                             return w;
                                           }())));
  return subjects;
}

std::string interval(std::size_t hits, std::size_t runs) {
  using boost::math::binomial;
  const double n = static_cast<double>(runs), k = static_cast<double>(hits);
  return fmt::format("{:>7.4f} - {:>7.4f}", binomial::find_lower_bound_on_p(n, k, 0.025),
                     binomial::find_upper_bound_on_p(n, k, 0.025));
}

// Tests a uniform density with samples that have random signs from cell to cell, of the size that the report of correct
// samples calls detectable. The cells are dyadic with equal mass, so they coincide approximately with the checker's
// cells. The statement about a single cell holds only for the checker's own cells, which the pilot moves if one is
// heavier; run_tests_test.cpp tests it.
void promise(std::size_t seeds, std::uint64_t samples, std::uint64_t first) {
  const mc::Interval<double> unit(0, 1);
  const auto uniform = [](double) { return 1.0; };
  const auto subject = [&](const char* name, const std::vector<double>& weights) {
    return make_subject(
        name, unit, [table = mc::TableDist1D<double>(weights)](double u) { return table.sample(u); }, uniform);
  };
  const mc::Report stated = check_subject(subject("right", {1}), {.samples = samples, .seed = first, .alpha = 0.01});
  const std::size_t cells = std::size_t{1} << static_cast<int>(std::log2(static_cast<double>(samples) / 200));
  std::vector<char> caught(seeds);
  mc::parallel_for(seeds, 0, [&](std::size_t i) {
    Pcg random(first + i, 3);
    std::vector<double> w(cells, 1);
    for (double& x : w) x += (random.next32() & 1 ? 1 : -1) * stated.detectable;
    caught[i] = check_subject(subject("off", w), {.samples = samples, .seed = first + i, .alpha = 0.01}).verdict() ==
                mc::Verdict::fail;
  });
  const auto hits = static_cast<std::size_t>(std::count(caught.begin(), caught.end(), 1));
  fmt::print("{} of {} runs caught an error of {:.3g} % of random sign in every cell, {} samples: rate {}\n", hits,
             seeds, 100 * stated.detectable, samples, interval(hits, seeds));
}

} // namespace

int main(int argc, char** argv) {
  const auto seeds = static_cast<std::size_t>(argc > 1 ? std::atoi(argv[1]) : 20);
  const auto samples = static_cast<std::uint64_t>(argc > 2 ? std::atof(argv[2]) : 1e6);
  const std::string kind = argc > 3 ? argv[3] : "right";
  const auto first = static_cast<std::uint64_t>(argc > 4 ? std::atof(argv[4]) : 1);
  const std::string name = argc > 5 ? argv[5] : "";
  if (kind == "promise") {
    promise(seeds, samples, first);
    return 0;
  }
  fmt::print("{:<44} {:>6} {:>9} {:>17} {:>13} {:>9}\n", "density, alpha = 1 %", "runs", "rejected", "rate, 95 %",
             "inconclusive", "s per run");
  for (const mc::Subject& subject : subjects()) {
    if (subject.name.find(name) == std::string::npos) continue;
    // Each density has its own seeds, because many warps turn equal numbers into equal counts.
    const std::uint64_t own = mc::hash(first, std::hash<std::string>{}(subject.name));
    std::vector<mc::Report> reports(seeds);
    mc::parallel_for(seeds, 0, [&](std::size_t i) {
      reports[i] = check_subject(subject, {.samples = samples, .seed = own + i, .alpha = 0.01});
    });
    std::size_t rejected = 0, inconclusive = 0;
    double seconds = 0;
    for (const mc::Report& r : reports) {
      rejected += r.verdict() == mc::Verdict::fail;
      inconclusive += r.verdict() == mc::Verdict::inconclusive;
      seconds += r.seconds;
    }
    fmt::print("{:<44} {:>6} {:>9} {} {:>13} {:>9.3f}\n", subject.name, seeds, rejected, interval(rejected, seeds),
               inconclusive, seconds / static_cast<double>(seeds));
    for (const mc::Report& r : reports)
      if (r.verdict() == mc::Verdict::inconclusive) {
        fmt::print("  {}\n", r.to_string());
        break;
      }
    std::fflush(stdout);
  }
}
