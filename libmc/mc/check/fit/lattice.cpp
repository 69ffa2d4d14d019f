#include <mc/check/fit/lattice.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace mc {
namespace {

// Samples that are equal up to the rounding of a sum of squares.
struct Run {
  double value = 0, count = 0;
  double pairs() const { return count * (count - 1) / 2; }
};

std::vector<Run> runs_of(std::span<const double> sorted, double epsilon) {
  std::vector<Run> runs;
  for (const double v : sorted) {
    if (runs.empty() || v > runs.back().value * (1 + 4 * epsilon)) runs.push_back({v, 0});
    runs.back().count += 1;
  }
  return runs;
}

// Number of equal pairs, without the pairs of the most frequent number, which may be an atom.
double equal_pairs(const std::vector<Run>& runs) {
  double pairs = 0, most = 0;
  for (const Run& run : runs) {
    pairs += run.pairs();
    most = std::max(most, run.pairs());
  }
  return pairs - most;
}

// Number of pairs within a unit of length: half the integral of the squared number density of the samples. Groups of
// samples are wide enough for several steps of a lattice.
double pairs_per_length(const std::vector<Run>& runs) {
  constexpr std::size_t fewest_runs = 8;
  constexpr double fewest_samples = 64;
  double sum = 0, count = 0;
  for (std::size_t first = 0, i = 0; i < runs.size(); ++i) {
    if (i >= first + fewest_runs && count >= fewest_samples) {
      sum += count * count / 2 / (runs[i].value - runs[first].value);
      first = i;
      count = 0;
    }
    count += runs[i].count;
  }
  return sum;
}

} // namespace

double lattice_step(const Subject& s, const Pilot& pilot, std::size_t axis) {
  constexpr double nearest = 1.0 / 64, fewest = 8;
  const std::vector<double>& all = pilot.sorted[axis];
  const auto first = std::upper_bound(all.begin(), all.end(), 0.0), last = std::lower_bound(first, all.end(), nearest);
  const std::vector<Run> runs = runs_of({first, last}, s.epsilon);
  const double pairs = equal_pairs(runs), per_length = pairs_per_length(runs);
  return pairs >= fewest && per_length > 0 ? pairs / per_length : 0;
}

Subject with_lattices(const Subject& subject, const Pilot& pilot) {
  PerAxis<double> steps{};
  bool any = false;
  for (std::size_t d = 0; d < static_cast<std::size_t>(subject.dim); ++d) {
    const double step = lattice_step(subject, pilot, d);
    if (step > widest_lattice_step(subject.epsilon)) continue;
    steps[d] = step;
    any = any || step > 0;
  }
  if (!any) return subject;
  Subject s = subject;
  s.resolution = [old = subject.resolution, epsilon = subject.epsilon, steps](const Subject::Coordinates& v, int axis) {
    const auto d = static_cast<std::size_t>(axis);
    return std::max(old ? old(v, axis) : epsilon * v[d], steps[d]);
  };
  return s;
}

} // namespace mc
