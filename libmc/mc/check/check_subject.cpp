#include <mc/check/check_subject.h>

#include <mc/check/fit/expected/mass.h>
#include <mc/check/fit/explanations/summary.h>
#include <mc/check/fit/lattice.h>
#include <mc/check/fit/unresolved_ends.h>
#include <mc/check/run_tests.h>
#include <mc/check/table.h>
#include <mc/core/error.h>
#include <mc/random/hash.h>
#include <mc/stats/sort_numbers.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mc {
namespace {

constexpr std::size_t most_kept = 1 << 22;

// Depth of the tree: at least 200 samples per cell, at most 4096 cells.
int tree_depth(double samples) { return std::clamp(static_cast<int>(std::log2(std::max(samples, 1.0) / 200)), 0, 12); }

Cell cell_of(const Subject& s, const Pilot& pilot, const UnitBox& box, const EstimatedMass& mass, std::size_t passes) {
  Cell c;
  c.p = mass.value;
  c.variance = mass.variance_with_jumps(passes);
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
    c.rank_lo[d] = pilot.rank(d, box.lo[d]);
    c.rank_hi[d] = box.hi[d] < 1 ? pilot.rank(d, box.hi[d]) : 1.0;
  }
  return c;
}

// Expected counts from the claimed density.
struct Expectation {
  PilotCells cells;
  StratifiedReference reference;
  CubatureResult cubature = {};
  EstimatedMass total = {}, uncapped = {};
};

// Passes points of the reference to the tests, and counts them. Each test has a loop of its own, which keeps its memory
// in the cache.
void count_expected(std::span<const StratifiedReference::EvaluatedPoint> points, const std::vector<RunningTest>& tests,
                    FitCounts& counts) {
  std::vector<double> weights(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    weights[i] = points[i].stratum->weight(points[i].density);
    counts.all.add_expected(points[i].share, weights[i]);
  }
  for (const RunningTest& t : tests)
    if (t.test.expect) t.test.expect({points, weights});
}

Expectation expect_cells(const FitSetup& setup, const std::vector<RunningTest>& tests, FitCounts& counts) {
  const auto& [s, options, pilot] = setup;
  const double n = static_cast<double>(options.samples), draws = static_cast<double>(pilot.stats.draws);
  PilotCells cells(s, pilot, tree_depth(n * static_cast<double>(pilot.points.size()) / draws));
  StratifiedReference reference(s, pilot, cells, hash(options.seed, 3));
  Expectation e{std::move(cells), std::move(reference)};
  StratifiedReference::Goal goal;
  goal.samples = n;
  goal.max_points = std::max<std::size_t>(options.max_evaluations / 3, 1 << 15);
  const StratifiedReference::CellMasses masses = e.reference.integrate(
      s, goal, hash(options.seed, 4),
      [&](std::span<const StratifiedReference::EvaluatedPoint> points) { count_expected(points, tests, counts); });
  e.cubature = integrate_density(s, pilot, e.cells, n, options.max_evaluations / 12);
  e.total = masses.total;
  e.uncapped = masses.uncapped;
  counts.invalid_point = masses.invalid_point ? masses.invalid_point : e.cubature.invalid_point;
  const std::vector<double> rounded = e.cells.rounding_shares(s, pilot);
  for (std::size_t i = 0; i < rounded.size(); ++i) {
    counts.boxes.push_back(e.cells.partition.box(static_cast<int>(i)));
    counts.cells.push_back(cell_of(s, pilot, counts.boxes.back(), masses.cells[i], masses.passes));
    counts.cells.back().variance += sqr(rounded[i]);
  }
  return e;
}

void add_outcomes(const Subject& s, FitCounts& counts) {
  for (std::size_t i = 0; i < s.atoms.size(); ++i) {
    require(s.atoms[i] >= 0 && s.atoms[i] <= 1 + 1e-6, "{}: probability of outcome {} = {} must lie in [0, 1]", s.name,
            i, s.atoms[i]);
    counts.cells.emplace_back().p = s.atoms[i];
  }
}

void count_outcomes(const DrawStats& draws, FitCounts& counts) {
  for (std::size_t i = 0; i < draws.atoms.size(); ++i) {
    Cell& cell = counts.cells[counts.boxes.size() + i];
    cell.observed = cell.squares = static_cast<double>(draws.atoms[i]);
  }
}

// Coordinates of samples on each axis: of the pilot and of the first samples.
using KeptCoordinates = PerAxis<std::vector<double>>;

// Counts samples that are points, in the same order as count_expected.
void count_points(std::span<const Subject::Coordinates> points, std::span<const double> densities,
                  const StratifiedReference& reference, const std::vector<RunningTest>& tests, FitCounts& counts,
                  KeptCoordinates& kept) {
  const std::vector<const StratifiedReference::Stratum*> strata = reference.find_strata(points);
  std::vector<double> weights(points.size()), shares(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    weights[i] = strata[i]->weight(densities[i]);
    shares[i] = strata[i]->share(densities[i]);
    count_in(counts.cells[strata[i]->cell], weights[i]);
    counts.weights.points += 1;
    counts.weights.sum += weights[i];
    counts.weights.squares += sqr(weights[i]);
    counts.all.add_sample(weights[i], shares[i]);
  }
  for (const RunningTest& t : tests)
    if (t.test.count) t.test.count({points, densities, weights, shares, strata});
  for (std::size_t d = 0; d < static_cast<std::size_t>(counts.setup.subject.dim); ++d)
    for (std::size_t i = 0; i < points.size() && kept[d].size() < most_kept; ++i) kept[d].push_back(points[i][d]);
}

// Draws and counts the samples. `on_progress` is called after 1024, 2048, ... draws.
void count_samples(const std::optional<Expectation>& expected, const std::vector<RunningTest>& tests, FitCounts& counts,
                   const std::function<void(const DrawStats& draws)>& on_progress) {
  const auto& [s, options, pilot] = counts.setup;
  KeptCoordinates kept;
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
    kept[d].reserve(std::min<std::size_t>(pilot.points.size() + options.samples, most_kept));
    kept[d] = pilot.sorted[d];
  }
  const auto count = [&](std::span<const Subject::Coordinates> points, std::span<const double> densities) {
    count_points(points, densities, expected->reference, tests, counts, kept);
  };
  counts.draws = draw_samples(s, hash(options.seed, 2), options.samples, count, on_progress);
  count_outcomes(counts.draws, counts);
  counts.pooled = pool(counts.cells);
  SampleWeights& weights = counts.weights;
  weights.draws = static_cast<double>(counts.draws.draws);
  weights.total_points = weights.points + static_cast<double>(pilot.points.size());
  const double draws = weights.draws + static_cast<double>(pilot.stats.draws);
  counts.kept = draws * static_cast<double>(kept[0].size()) / std::max(weights.total_points, 1.0);
  if (s.dim == 0) return;
  for (std::vector<double>& axis : kept) sort_numbers(axis);
  counts.intervals = find_axis_intervals(s, pilot, kept);
}

// Runs all tests: the table decides which.
JudgedTests run_tests(const FitSetup& setup, FitCounts& counts, PlotData* evidence) {
  const Subject& s = setup.subject;
  const std::vector<RunningTest> tests = start_tests(setup);
  std::optional<Expectation> expected;
  if (s.dim > 0) expected.emplace(expect_cells(setup, tests, counts));
  if (expected) counts.partition = &expected->cells.partition;
  add_outcomes(s, counts);
  std::function<void(const DrawStats&)> on_progress;
  if (evidence)
    on_progress = [&](const DrawStats& draws) {
      count_outcomes(draws, counts);
      Report then;
      then.checks = test_cells(counts.cells, s.dim, setup.options.alpha, s.axes).checks;
      evidence->p_after.push_back({draws.draws, then.p()});
    };
  count_samples(expected, tests, counts, on_progress);
  counts.mass =
      claimed_mass(s, expected ? expected->cubature : CubatureResult{}, expected ? expected->total : EstimatedMass{},
                   expected ? expected->uncapped : EstimatedMass{}, counts.weights);
  if (s.inverted) counts.inverted = s.inverted(inverted_stream(setup.options), inverted_count(setup.options));
  JudgedTests judged = judge_tests(tests, counts);
  for (const ExplanationRow& row : explanations()) row.explain(counts, judged.findings);
  return judged;
}

} // namespace

Report check_subject(const Subject& given, const SubjectOptions& options) {
  if (options.before_draws) {
    Subject watched = given;
    watched.draw = [&](std::uint64_t stream, std::size_t n, std::vector<Subject::Draw>& draws) {
      (*options.before_draws)(n);
      given.draw(stream, n, draws);
    };
    SubjectOptions others = options;
    others.before_draws = nullptr;
    return check_subject(watched, others);
  }
  require(options.samples >= 1000, "check_subject: samples = {}; at least 1000 are needed", options.samples);
  require(options.alpha > 0 && options.alpha < 1, "check_subject: alpha = {} must lie in (0, 1)", options.alpha);
  const auto start = std::chrono::steady_clock::now();
  const Subject averaged = average_unresolved_ends(given);
  const Pilot pilot = given.dim > 0 ? draw_pilot(averaged, hash(options.seed, 1), options.samples) : Pilot{};
  const Subject s = with_lattices(averaged, pilot);
  Report report;
  report.subject = s.name;
  report.alpha = options.alpha;
  report.samples = options.samples;
  report.axes = named_axes(s);
  if (options.evidence) report.evidence.emplace();

  const FitSetup setup{s, options, pilot};
  FitCounts counts{.setup = setup};
  JudgedTests judged = run_tests(setup, counts, report.evidence ? &*report.evidence : nullptr);
  for (TestFindings& f : judged.findings)
    for (Check& c : f.checks) report.checks.push_back(std::move(c));
  report.mass = counts.mass.value;
  report.mass_error = counts.mass.error;
  report.detectable = judged.detectable;
  report.detectable_cell = judged.detectable_cell;

  double claimed = 0;
  for (const Cell& c : counts.cells) claimed += c.p;
  const double scale = static_cast<double>(options.samples) / (s.may_fail ? 1.0 : std::max(claimed, 1e-300));
  report.worst = worst_cells(s, counts.boxes, counts.cells, scale);
  if (report.evidence) {
    add_counts(counts.boxes, counts.cells, scale, *report.evidence);
    report.evidence->p_after.push_back({counts.draws.draws, report.p()});
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

double check_memory(std::uint64_t samples) {
  const double n = static_cast<double>(samples);
  constexpr double most_tables = 36e6, tables_per_sample = 120; // of the spectrum, of the reference and of cells
  constexpr double per_pilot_point = 117, per_kept_sample = 2 * sizeof(double); // each kept and sorted
  return std::min(most_tables, tables_per_sample * n) + per_pilot_point * static_cast<double>(pilot_samples(samples)) +
         per_kept_sample * std::min(n, static_cast<double>(most_kept));
}

std::uint64_t samples_to_detect(double error, double alpha, int dim) {
  require(error > 0, "samples_to_detect: error = {} must be > 0", error);
  require(alpha > 0 && alpha < 1, "samples_to_detect: alpha = {} must lie in (0, 1)", alpha);
  // Returns the detectable error of test_cells for cells of equal probability, as a function of the number of samples.
  const auto detectable = [&](double n) {
    std::vector<Cell> cells(std::size_t{1} << tree_depth(n));
    for (Cell& c : cells) {
      c.p = 1 / static_cast<double>(cells.size());
      c.variance = 0.25 * c.p / n; // of a smooth density with random points of the reference
      c.observed = c.squares = n / static_cast<double>(cells.size());
    }
    return test_cells(cells, dim, alpha).detectable;
  };
  double lo = 1000, hi = 1e12;
  for (int i = 0; i < 60 && hi > 1.001 * lo; ++i) {
    const double middle = std::sqrt(lo * hi), found = detectable(middle);
    (found > 0 && found <= error ? hi : lo) = middle;
  }
  return static_cast<std::uint64_t>(std::ceil(hi));
}

} // namespace mc
