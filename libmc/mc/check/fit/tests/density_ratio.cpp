#include <mc/check/fit/tests/density_ratio.h>

#include <mc/check/fit/tests/fit_test.h>

#include <mc/stats/chi_square.h>
#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <vector>

namespace mc {
namespace {

// Required information of a level: its squared z must be chi-square far out in the tail.
constexpr double least_information = 30;

} // namespace

Check DensityRatioTest::test(double share, double alpha) const {
  Check c{"density ratio", Verdict::pass, 1.0, share, 0, 0, Fault::shape, {}};
  WeightedCounts all;
  for (const WeightedCounts& l : levels_) all.join(l);
  if (!(all.observed > 0 && all.expected > 0)) return c;
  const double scale = all.observed / all.expected;
  const auto enough = [&](const WeightedCounts& l) { return compare(l, scale).information() >= least_information; };
  std::vector<WeightedCounts> pooled{WeightedCounts{}};
  for (const WeightedCounts& l : levels_) {
    if (enough(pooled.back())) pooled.emplace_back();
    pooled.back().join(l);
  }
  if (!enough(pooled.back()) && pooled.size() > 1) {
    const WeightedCounts rest = pooled.back();
    pooled.pop_back();
    pooled.back().join(rest);
  }
  for (const WeightedCounts& l : pooled) c.statistic += sqr(compare(l, scale).z());
  // The given sum takes one degree of freedom.
  const double dof = static_cast<double>(pooled.size() - 1);
  if (!(dof > 0)) return c;
  c.p = chi_square_tail(c.statistic, dof);
  if (*c.p <= sidak_level(alpha, share)) {
    c.verdict = Verdict::fail;
    c.detail =
        fmt::format("chi-square over ranges of the density is {:.4g}, {:.0f} expected; the samples do not follow "
                    "the density within cells",
                    c.statistic, dof);
  }
  return c;
}

namespace {

struct DensityRatioInProgress {
  DensityRatioTest levels;
  double share;

  void expect(const ReferenceBlock& block) {
    for (std::size_t i = 0; i < block.points.size(); ++i) {
      const StratifiedReference::EvaluatedPoint& p = block.points[i];
      levels.add_expected(p.density / p.stratum->density, p.share, block.weights[i]);
    }
  }
  void count(const SampleBlock& block) {
    for (std::size_t i = 0; i < block.points.size(); ++i)
      levels.add_sample(block.densities[i] / block.strata[i]->density, block.weights[i], block.shares[i]);
  }
  Findings judge(const FitCounts& counts) const { return {{levels.test(share, counts.setup.options.alpha)}}; }
};

} // namespace

FitTest density_ratio_test(const FitSetup&, double share) { return make_fit_test(DensityRatioInProgress{{}, share}); }

} // namespace mc
