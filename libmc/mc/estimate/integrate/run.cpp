#include <mc/core/types.h>
#include <mc/estimate/integrate/run.h>
#include <mc/random/hash.h>

#include <algorithm>
#include <limits>

namespace mc::detail {

void Round::compare(const Means& answer) {
  for (std::size_t k = 0; k < answer.size(); ++k) {
    const auto z = normal_deviate(means[k], answer[k]);
    chi2.push_back(z ? sqr(*z) : std::numeric_limits<double>::quiet_NaN());
  }
}

std::vector<PointSet> Run::sobol_sets(Stream stream, std::uint64_t round, std::uint32_t begin,
                                      std::uint32_t end) const {
  std::vector<PointSet> sets;
  for (std::uint32_t r = begin; r < end; ++r) {
    const std::uint64_t seed = hash(options().seed, static_cast<std::uint64_t>(stream), round, r);
    const bool warped = stream == Stream::rqmc;
    if (interlaced(stream)) sets.emplace_back(InterlacedSobol{seed, warped});
    else sets.emplace_back(ScrambledSobol{seed, warped});
  }
  return sets;
}

void Run::record(Method method, const Means& means, bool learning) {
  rounds.push_back({method, learning, evaluator.calls, means});
  if (options().progress) options().progress({estimate(means.front(), evaluator.calls), evaluator.calls, seconds()});
}

double Run::excess(const Means& means) const {
  double most = 0;
  for (std::size_t k = 0; k < primary(); ++k) {
    const double wanted = wanted_error(means[k]);
    const double error = estimate(means[k], evaluator.calls).std_error;
    most = std::max(most, wanted > 0 ? error / wanted : infinity<double>);
  }
  return most;
}

bool Run::converged(const Means& means) const {
  return evaluator.calls >= std::min(options().min_calls, options().max_calls) && excess(means) <= 1;
}

} // namespace mc::detail
