// Compares the checker with plain tests on random faults in the uniform distribution of the unit square: chi-square on
// k x k cells, and Kolmogorov-Smirnov of each axis, each at the alpha of the checker.
// Usage: bench_mc_check_plain [FAULTS [RUNS [SAMPLES [FIRST_SEED]]]]. The default is 300 faults, 20 runs of 1e5 samples
// each.
// Prints CSV: for each fault the share of runs that rejects it. The summary on the standard error counts, by kind, the
// faults that some plain test finds in all runs, and those among them that the checker finds in less than 90 %.

#include <mc/check/random_faults.h>

#include <mc/check/check_subject.h>
#include <mc/check/subject/make_subject.h>
#include <mc/core/parallel.h>
#include <mc/domain/box.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/ks_test.h>

#include <cstdlib>
#include <map>

namespace checker_bench {
namespace {

constexpr double alpha = 0.01;
constexpr std::array<std::size_t, 6> grids{16, 32, 64, 101, 128, 256};
constexpr std::size_t plain_tests = grids.size() + 2; // and KS of two axes

Subject uniform_square() {
  return make_subject(
      "uniform square", mc::Square<double>{}, [](const mc::Vec2<double>& u) { return u; },
      [](const mc::Vec2<double>&) { return 1.0; });
}

bool rejects_on_grid(const std::vector<Coordinates>& points, std::size_t k) {
  std::vector<double> counts(k * k);
  const auto bin = [k](double x) { return std::min(static_cast<std::size_t>(x * static_cast<double>(k)), k - 1); };
  for (const Coordinates& v : points) counts[bin(v[0]) * k + bin(v[1])] += 1;
  const double expected = static_cast<double>(points.size()) / static_cast<double>(counts.size());
  double sum = 0;
  for (const double c : counts) sum += mc::sqr(c - expected) / expected;
  return mc::chi_square_tail(sum, static_cast<double>(counts.size() - 1)) <= alpha;
}

bool rejects_by_ks(const std::vector<Coordinates>& points, std::size_t axis) {
  std::vector<double> x(points.size());
  std::ranges::transform(points, x.begin(), [axis](const Coordinates& v) { return v[axis]; });
  std::sort(x.begin(), x.end());
  const double n = static_cast<double>(x.size());
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    largest = std::max({largest, x[i] - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - x[i]});
  return mc::kolmogorov_tail(std::sqrt(n) * largest) <= alpha;
}

// Whether the checker, then each plain test, rejects a run.
std::array<bool, plain_tests + 1> rejections(const Subject& wrong, std::uint64_t samples, std::uint64_t seed) {
  std::array<bool, plain_tests + 1> rejected{};
  rejected[0] = check_subject(wrong, {.samples = samples, .seed = seed, .alpha = alpha}).verdict() == mc::Verdict::fail;
  std::vector<Draw> draws;
  wrong.draw(mc::hash(seed, 5), samples, draws);
  std::vector<Coordinates> points(draws.size());
  std::ranges::transform(draws, points.begin(), &Draw::v);
  for (std::size_t g = 0; g < grids.size(); ++g) rejected[1 + g] = rejects_on_grid(points, grids[g]);
  for (const std::size_t axis : {0, 1}) rejected[1 + grids.size() + axis] = rejects_by_ks(points, axis);
  return rejected;
}

void run(std::uint64_t faults, std::size_t runs, std::uint64_t samples, std::uint64_t first) {
  fmt::print("# bench_mc_check_plain {} {} {} {}\nseed,kind,size,checker", faults, runs, samples, first);
  for (const std::size_t k : grids) fmt::print(",chi_square_{}", k);
  fmt::print(",ks_x,ks_y\n");
  const Subject right = uniform_square();
  struct Count {
    int faults = 0, found_plainly = 0, behind = 0;
  };
  std::map<std::string, Count> kinds;
  for (std::uint64_t seed = first; seed < first + faults; ++seed) {
    const FaultySubject fault = random_fault(right, seed, static_cast<double>(samples));
    if (fault.kind == "mass") continue; // a fault of the density alone
    std::vector<std::array<bool, plain_tests + 1>> all(runs);
    mc::parallel_for(runs, 0, [&](std::size_t i) { all[i] = rejections(fault.subject, samples, seed * 1000 + i); });
    std::array<double, plain_tests + 1> shares{};
    for (const auto& one : all)
      for (std::size_t t = 0; t < one.size(); ++t) shares[t] += one[t] ? 1 / static_cast<double>(runs) : 0;
    fmt::print("{},{},{:.4g},{:.3g}\n", seed, fault.kind, fault.size, fmt::join(shares, ","));
    std::fflush(stdout);
    Count& count = kinds[fault.kind];
    ++count.faults;
    if (*std::max_element(shares.begin() + 1, shares.end()) < 0.99) continue;
    ++count.found_plainly;
    count.behind += shares[0] < 0.9;
  }
  for (const auto& [kind, c] : kinds)
    fmt::print(stderr,
               "{}: {} faults, {} found by a plain test in all runs, {} of these by the checker in fewer than "
               "90 %\n",
               kind, c.faults, c.found_plainly, c.behind);
}

} // namespace
} // namespace checker_bench

int main(int argc, char** argv) {
  const auto number = [&](int i, double otherwise) { return argc > i ? std::atof(argv[i]) : otherwise; };
  checker_bench::run(static_cast<std::uint64_t>(number(1, 300)), static_cast<std::size_t>(number(2, 20)),
                     static_cast<std::uint64_t>(number(3, 1e5)), static_cast<std::uint64_t>(number(4, 1)));
}
