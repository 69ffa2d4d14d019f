/// Renders random scenes with every unbiased strategy and sampler and compares them with the expected radiance. Prints
/// one row of CSV per picture to stdout, and statistics of the z-scores to stderr.
/// Usage: bench_render_truth [FAMILIES [SEED [SETS [POINTS [FIRST]]]]], starting with family FIRST
///   should : the closed form. If its error is not 0, the mean of the first picture of the family by mis, with eight
///            times the number of sets.
///   z      : see z_score in measure.h.
///   state  : decided; undecided; dark if no light was found; or rare. It is rare if a strategy hits lights only by
///            chance and expects fewer than 100 hits of the smallest one.

#include "truth/measure.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>

namespace {

using namespace render;
using namespace render::truth;

struct Scores {
  int rows = 0, others = 0, above_2 = 0, above_3 = 0;
  double squares = 0, largest = 0;

  void add(std::string_view state, double z) {
    ++rows;
    if (state != "decided") ++others;
    else {
      above_2 += std::abs(z) > 1.96;
      above_3 += std::abs(z) > 2.576;
      squares += z * z;
      largest = std::max(largest, std::abs(z));
    }
  }
  void print(const std::string& name) const {
    const double n = rows - others;
    fmt::print(stderr, "{:<32} {:5} {:7} {:8.4f} {:8.4f} {:8.3f} {:8.2f}\n", name, rows, n, above_2 / n, above_3 / n,
               std::sqrt(squares / n), largest);
  }
};

struct RenderSetup {
  Strategy strategy;
  bool in_tile = false; ///< see measure

  std::string name() const { return std::string(strategy.name) + (in_tile ? " tiles" : ""); }
};

// All strategies that estimate single rays without light paths. Paths shared in tiles are independent of the strategy,
// so three strategies suffice for them.
std::vector<RenderSetup> ways() {
  std::vector<RenderSetup> all;
  for (const Strategy& strategy : strategies)
    if (strategy.name != "light" && strategy.light_path_rate == 0) all.push_back({strategy});
  for (const char* name : {"mixture", "nee", "mis"}) all.push_back({strategy_from(name), true});
  return all;
}

struct Run {
  std::uint64_t seed;
  std::uint32_t sets, points;
  std::uint64_t estimates = 0;
  std::map<std::string, Scores> scores = {};

  std::string_view state_of(const Family& family, const Strategy& strategy, const Measured& m) const {
    const bool bsdf_only =
        strategy.direct_lighting == DirectLighting::bsdf_only && strategy.guiding_target != GuidingTarget::lights;
    if (bsdf_only && family.rarest * sets * points < 100) return "rare";
    if (m.means.mean() == 0) return "dark";
    return m.outlier_dominated ? "undecided" : "decided";
  }

  void show(int number, const Family& family) {
    double should = family.truth.value_or(0), error = 0, dof = mc::infinity<double>;
    if (!family.truth) {
      const auto m = measure(family.pictures[0], strategy_from("mis"), PixelSampler::sobol, seed + 1, 8 * sets, points);
      should = m.means.mean();
      error = m.means.std_error();
      dof = double(m.means.count() - 1);
    }
    std::size_t turn = static_cast<std::size_t>(number);
    for (const Picture& picture : family.pictures)
      for (const RenderSetup& way : ways())
        for (const auto sampler : {PixelSampler::independent, PixelSampler::stratified, PixelSampler::sobol}) {
          // In all pictures but the first of a family, each setup uses one sampler in turn.
          if (&picture != &family.pictures[0] && ++turn % 3 != 0) continue;
          const Measured m =
              measure(picture, way.strategy, sampler, mc::hash(seed, estimates++), sets, points, way.in_tile);
          const double z = z_score(m, should, error, dof, family.rounding * should);
          const std::string_view state = state_of(family, way.strategy, m);
          fmt::print("{},{},{},{},{},{:.9g},{:.3g},{:.9g},{:.3g},{:.3f},{}\n", number, family.kind, picture.variant,
                     way.name(), name(sampler), m.means.mean(), m.means.std_error(), should, error, z, state);
          for (const std::string& key : {family.kind + ": " + picture.variant, "strategy: " + way.name(),
                                         "sampler: " + std::string(name(sampler)), std::string("all")})
            scores[key].add(state, z);
        }
  }
};

} // namespace

int main(int argc, char** argv) {
  const int families = argc > 1 ? std::atoi(argv[1]) : 300;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  Run run{seed, argc > 3 ? std::uint32_t(std::atoi(argv[3])) : 32, argc > 4 ? std::uint32_t(std::atoi(argv[4])) : 256};
  fmt::print("family,kind,variant,strategy,sampler,mean,std_error,should,should_error,z,state\n");
  const int first = argc > 5 ? std::atoi(argv[5]) : 0;
  for (int i = first; i < first + families; ++i) {
    mc::Pcg random(seed, std::uint64_t(i));
    run.show(i, any(random));
  }
  fmt::print(stderr, "{:<32} {:>5} {:>7} {:>8} {:>8} {:>8} {:>8}\n", "", "rows", "decided", "|z|>1.96", "|z|>2.58",
             "rms z", "largest");
  for (const auto& [name, scores] : run.scores) scores.print(name);
}
