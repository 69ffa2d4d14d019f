#include <mc/check/check_subject.h>

#include <mc/check/fit/alpha_shares.h>
#include <mc/check/fit/expected/mass.h>
#include <mc/check/fit/interior_density.h>
#include <mc/check/fit/lattice.h>
#include <mc/check/fit/tests/axis_intervals.h>
#include <mc/check/fit/tests/density_ratio.h>
#include <mc/check/fit/tests/marginal_bins.h>
#include <mc/check/fit/tests/rotation.h>
#include <mc/check/fit/tests/rounding.h>
#include <mc/check/fit/tests/spectrum.h>
#include <mc/check/fit/tests/uniformity.h>
#include <mc/check/fit/unresolved_ends.h>
#include <mc/check/summary.h>
#include <mc/core/error.h>
#include <mc/random/hash.h>
#include <mc/stats/binomial.h>
#include <mc/stats/multiple_testing.h>
#include <mc/stats/sort_numbers.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace mc {
namespace {

constexpr std::uint64_t most_inverted = 1 << 17;

constexpr std::size_t most_kept = 1 << 22;

// The cells and bins of the tests, with the expected counts.
struct Layout {
  std::optional<PilotCells> pilot_cells; ///< only for subjects with axes
  std::optional<StratifiedReference> reference;
  std::vector<UnitBox> boxes; ///< boxes of the first cells; the other cells are discrete outcomes
  std::vector<Cell> cells;
  std::optional<MarginalBins> marginal_bins;
  std::optional<SpectrumTest> spectrum;
  DensityRatioTest density_ratio;
  WeightedCounts all; ///< all samples and random points
  StratifiedReference::CellMasses masses;
  CubatureResult cubature;
};

// Sums over the samples in a cell: of their weights and of the squared weights.
struct WeightSums {
  double sum = 0, squares = 0;
  void add(double weight) {
    sum += weight;
    squares += weight * weight;
  }
};

// Results of counting the samples.
struct Counts {
  DrawStats stats;
  std::vector<WeightSums> cells;
  SampleWeights weights;
  std::array<std::vector<double>, 3> coordinates; ///< sorted on each axis: the pilot and the first samples
  double kept = 0;                                ///< number of draws behind the coordinates
};

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

// Adds points of the reference to the expected counts. Each test has a loop of its own, which keeps its memory in the
// cache.
void count_expected(std::span<const StratifiedReference::EvaluatedPoint> points, Layout& layout) {
  std::vector<double> weights(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) weights[i] = points[i].stratum->weight(points[i].density);
  for (std::size_t i = 0; i < points.size(); ++i)
    layout.marginal_bins->add_expected(points[i].v, points[i].share, weights[i]);
  for (const StratifiedReference::EvaluatedPoint& p : points) layout.spectrum->add_expected(p.v, p.share);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const StratifiedReference::EvaluatedPoint& p = points[i];
    layout.density_ratio.add_expected(p.density / p.stratum->density, p.share, weights[i]);
    layout.all.add_expected(p.share, weights[i]);
  }
}

void lay_out_cells(const Subject& s, const Pilot& pilot, const SubjectOptions& options, Layout& layout) {
  const double n = static_cast<double>(options.samples), draws = static_cast<double>(pilot.stats.draws);
  layout.pilot_cells.emplace(s, pilot, tree_depth(n * static_cast<double>(pilot.points.size()) / draws));
  layout.reference.emplace(s, pilot, *layout.pilot_cells, hash(options.seed, 3));
  StratifiedReference::Goal goal;
  goal.samples = n;
  goal.max_points = std::max<std::size_t>(options.max_evaluations / 3, 1 << 15);
  layout.marginal_bins.emplace(pilot, s.dim);
  layout.spectrum.emplace(s.dim, n, mean_step(s, pilot, 1 / std::sqrt(n)));
  layout.masses = layout.reference->integrate(
      s, goal, hash(options.seed, 4),
      [&](std::span<const StratifiedReference::EvaluatedPoint> points) { count_expected(points, layout); });
  layout.cubature = integrate_density(s, pilot, *layout.pilot_cells, n, options.max_evaluations / 12);
  const Partition& partition = layout.pilot_cells->partition;
  const std::vector<double> rounded = layout.pilot_cells->rounding_shares(s, pilot);
  for (int i = 0; i < partition.size(); ++i) {
    layout.boxes.push_back(partition.box(i));
    const EstimatedMass& mass = layout.masses.cells[static_cast<std::size_t>(i)];
    layout.cells.push_back(cell_of(s, pilot, layout.boxes.back(), mass, layout.masses.passes));
    layout.cells.back().variance += sqr(rounded[static_cast<std::size_t>(i)]);
  }
}

Layout lay_out(const Subject& s, const Pilot& pilot, const SubjectOptions& options) {
  Layout layout;
  if (s.dim > 0) lay_out_cells(s, pilot, options, layout);
  for (std::size_t i = 0; i < s.atoms.size(); ++i) {
    require(s.atoms[i] >= 0 && s.atoms[i] <= 1 + 1e-6, "{}: probability of outcome {} = {} must lie in [0, 1]", s.name,
            i, s.atoms[i]);
    layout.cells.emplace_back().p = s.atoms[i];
  }
  return layout;
}

// The total to which the claimed probabilities are normalised. Failures supply the rest of 1.
double claimed_total(const Subject& s, double mass) { return s.may_fail ? 1.0 : std::max(mass, 1e-300); }

// Tests the rate of failures against 1 - mass. The error of the integral is conceded; if it is large, the check of the
// mass is inconclusive.
Check test_failures(const Subject& s, const DrawStats& t, double mass, double mass_error, double alpha) {
  Check c{"failure rate",
          Verdict::pass,
          {},
          alpha_share(FitTest::failures, s.dim),
          static_cast<double>(t.failed.count),
          0,
          Fault::failure,
          {}};
  const double expected = std::clamp(1 - mass, 0.0, 1.0), slack = mass_error + s.mass_tolerance;
  const double rate = static_cast<double>(t.failed.count) / static_cast<double>(t.draws);
  const double conceded = rate > expected ? std::min(expected + slack, rate) : std::max(expected - slack, rate);
  c.p = binomial_tail(static_cast<double>(t.failed.count), static_cast<double>(t.draws), conceded);
  if (*c.p > sidak_level(alpha, c.share)) return c;
  c.verdict = Verdict::fail;
  c.detail = fmt::format("{} of {} samples failed, {:.1f} expected since the density integrates to {:.8g} +- {:.2g}",
                         t.failed.count, t.draws, expected * static_cast<double>(t.draws), mass, mass_error);
  return c;
}

// Runs all tests of the current counts.
CellTests judge_counts(const Subject& s, Layout& layout, const std::vector<WeightSums>& cells, const DrawStats& stats,
                       double alpha) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    layout.cells[i].observed = cells[i].sum;
    layout.cells[i].squares = cells[i].squares;
  }
  for (std::size_t i = 0; i < s.atoms.size(); ++i) {
    const double count = static_cast<double>(stats.atoms[i]);
    layout.cells[layout.boxes.size() + i].observed = layout.cells[layout.boxes.size() + i].squares = count;
  }
  return test_cells(layout.cells, s.dim, alpha, s.axes);
}

// Counts the samples that are points, in the same order as count_expected.
void count_points(const Subject& s, std::span<const Subject::Coordinates> points, std::span<const double> densities,
                  Layout& layout, Counts& counts) {
  const std::vector<const StratifiedReference::Stratum*> strata = layout.reference->find_strata(points);
  std::vector<double> weights(points.size()), shares(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    weights[i] = strata[i]->weight(densities[i]);
    shares[i] = strata[i]->share(densities[i]);
    counts.cells[strata[i]->cell].add(weights[i]);
    counts.weights.points += 1;
    counts.weights.sum += weights[i];
    counts.weights.squares += sqr(weights[i]);
    layout.all.add_sample(weights[i], shares[i]);
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    layout.density_ratio.add_sample(densities[i] / strata[i]->density, weights[i], shares[i]);
  for (std::size_t i = 0; i < points.size(); ++i) layout.marginal_bins->add_sample(points[i], weights[i], shares[i]);
  for (std::size_t i = 0; i < points.size(); ++i) layout.spectrum->add_sample(points[i], weights[i]);
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d)
    for (std::size_t i = 0; i < points.size() && counts.coordinates[d].size() < most_kept; ++i)
      counts.coordinates[d].push_back(points[i][d]);
}

// Draws and counts the samples. `on_progress` receives the counts after 1024, 2048, ... draws.
using ProgressCallback = std::function<void(const std::vector<WeightSums>& cells, const DrawStats& stats)>;

Counts count_samples(const Subject& s, const Pilot& pilot, const SubjectOptions& options, Layout& layout,
                     const ProgressCallback& on_progress) {
  Counts counts;
  counts.cells.resize(layout.boxes.size());
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
    counts.coordinates[d].reserve(std::min<std::size_t>(pilot.points.size() + options.samples, most_kept));
    counts.coordinates[d] = pilot.sorted[d];
  }
  const auto count = [&](std::span<const Subject::Coordinates> points, std::span<const double> densities) {
    count_points(s, points, densities, layout, counts);
  };
  std::function<void(const DrawStats&)> judge;
  if (on_progress) judge = [&](const DrawStats& stats) { on_progress(counts.cells, stats); };
  counts.stats = draw_samples(s, hash(options.seed, 2), options.samples, count, judge);
  SampleWeights& weights = counts.weights;
  weights.draws = static_cast<double>(counts.stats.draws);
  weights.total_points = weights.points + static_cast<double>(pilot.points.size());
  const double draws = weights.draws + static_cast<double>(pilot.stats.draws);
  counts.kept = draws * static_cast<double>(counts.coordinates[0].size()) / std::max(weights.total_points, 1.0);
  for (std::vector<double>& axis : counts.coordinates) sort_numbers(axis);
  return counts;
}

std::string describe_density(double density) {
  if (density < 0) return "negative";
  return std::isnan(density) ? "not a number" : "infinite";
}

std::vector<Check> judge_density(const Subject& s, const Layout& layout) {
  const auto& bad = layout.masses.invalid_point ? layout.masses.invalid_point : layout.cubature.invalid_point;
  if (!bad) return {};
  const double density = interior_density(s, *bad);
  return {{"pdf finite and >= 0",
           Verdict::fail,
           {},
           0,
           1,
           0,
           density < 0 ? Fault::negative : Fault::not_finite,
           fmt::format("pdf is {}, should be finite and >= 0, at {}", describe_density(density),
                       s.describe_point ? "x = " + s.describe_point(*bad)
                                        : fmt::format("chart coordinates ({:.17g}, {:.17g}, {:.17g})", (*bad)[0],
                                                      (*bad)[1], (*bad)[2]))}};
}

void append(std::vector<Check>& all, std::vector<Check> more) {
  for (Check& c : more) all.push_back(std::move(c));
}

// Tests the samples after the subject's own inverse.
std::vector<Check> judge_inverse(const Subject& s, std::uint64_t seed, std::uint64_t samples, double alpha) {
  if (!s.inverted) return {};
  const std::uint64_t n = std::min(samples, most_inverted);
  const std::vector<Subject::Coordinates> inverted = s.inverted(seed, n);
  if (inverted.empty()) return {};
  if (auto lost = check_inverse_finite(s, seed, n, inverted)) return {*lost};
  std::vector<Check> checks;
  if (auto c = test_uniformity(inverted, s.dim, s.invert_error, alpha, alpha_share(FitTest::inverse, s.dim)))
    checks.push_back(std::move(*c));
  SpectrumTest grid(s.dim, static_cast<double>(inverted.size()), s.invert_error);
  grid.expect_uniform();
  WeightedCounts all;
  for (const Subject::Coordinates& u : inverted) {
    grid.add_sample(u, 1);
    all.add_sample(1, 0);
  }
  append(checks, grid.test(all, alpha_share(FitTest::spectrum, s.dim) / 2, alpha, "inverted samples"));
  return checks;
}

// Tests structure that is thinner or finer than the cells.
std::vector<Check> judge_detail(const Subject& s, const Pilot& pilot, const Layout& layout, const Counts& counts,
                                double mass, double alpha) {
  const double points = std::max(mass - std::accumulate(s.atoms.begin(), s.atoms.end(), 0.0), 1e-300);
  std::vector<Check> checks{layout.marginal_bins->test(s, pilot, counts.weights.points, points,
                                                       alpha_share(FitTest::marginal_bins, s.dim), alpha),
                            layout.density_ratio.test(alpha_share(FitTest::density_ratio, s.dim), alpha)};
  append(checks, layout.spectrum->test(layout.all, alpha_share(FitTest::spectrum, s.dim) / (s.inverted ? 2 : 1), alpha,
                                       "chart"));
  return checks;
}

// Puts a finding before the detail of the failed check that explains a report: the first, or the first with a tiny p.
void prepend_finding(std::vector<Check>& checks, const std::string& finding) {
  if (finding.empty()) return;
  const auto prepend = [&](auto accepts) {
    const auto first = std::find_if(checks.begin(), checks.end(),
                                    [&](const Check& c) { return c.verdict == Verdict::fail && accepts(c); });
    if (first != checks.end() && !first->detail.starts_with(finding)) first->detail = finding + "; " + first->detail;
  };
  prepend([](const Check&) { return true; });
  prepend([](const Check& c) { return c.p && *c.p < 1e-9; });
}

// Whether a failed test of the mass shows wrong samples: the samples, which estimate the mass, contradict the density
// also given their number, and random points alone do not find too much mass.
bool is_of_samples(const Check& test, const ClaimedMass& mass, const std::vector<Check>& of_counts) {
  const auto failed = [](const Check& c) { return c.verdict == Verdict::fail; };
  return failed(test) && !mass.by_cubature && std::any_of(of_counts.begin(), of_counts.end(), failed) &&
         !(mass.from_points > 1 + 4 * mass.from_points_error);
}

// Changes a failed test of the mass into a finding about the samples, in the worst region.
void blame_samples(Check& mass_test, const std::string& region) {
  if (mass_test.fault == Fault::mass)
    mass_test.detail = "the mean weight of the samples is off, since they do not follow the density";
  mass_test.fault = Fault::shape;
  if (!region.empty()) mass_test.detail = region + "; " + mass_test.detail;
}

// If a rotation about the pole explains the counts, reports it as the likely cause.
void recognise_rotation(const Subject& s, const std::vector<Axis>& axes, const Layout& layout, const Pilot& pilot,
                        std::vector<Check>& checks) {
  const auto of_shape = [](const Check& c) {
    return c.verdict == Verdict::fail && (c.fault == Fault::shape || c.fault == Fault::local);
  };
  if (s.dim < 2 || std::none_of(checks.begin(), checks.end(), of_shape)) return;
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
    if (axes[d].scale != Axis::Scale::azimuth) continue;
    const std::optional<double> turn = find_rotation(s, d, layout.pilot_cells->partition, layout.cells, pilot.points);
    if (!turn) continue;
    prepend_finding(checks, fmt::format("the samples seem rotated by {:.3g} deg in {}", 360 * *turn, axes[d].name));
    for (Check& c : checks)
      if (of_shape(c)) c.fault = Fault::rotation;
  }
}

} // namespace

Report check_subject(const Subject& given, const SubjectOptions& options) {
  if (options.before_draws) {
    Subject watched = given;
    watched.draw = [&](std::uint64_t stream, std::size_t n, std::vector<Subject::Draw>& draws) {
      (*options.before_draws)();
      given.draw(stream, n, draws);
    };
    SubjectOptions others = options;
    others.before_draws = nullptr;
    return check_subject(watched, others);
  }
  require(options.samples >= 1000, "check_subject: samples = {}; at least 1000 are needed", options.samples);
  require(options.alpha > 0 && options.alpha < 1, "check_subject: alpha = {} must lie in (0, 1)", options.alpha);
  const auto start = std::chrono::steady_clock::now();
  const double n = static_cast<double>(options.samples);
  const Subject averaged = average_unresolved_ends(given);
  const Pilot pilot = given.dim > 0 ? draw_pilot(averaged, hash(options.seed, 1), options.samples) : Pilot{};
  const Subject s = with_lattices(averaged, pilot);
  Report report;
  report.subject = s.name;
  report.alpha = options.alpha;
  report.samples = options.samples;
  report.axes = named_axes(s);
  if (options.evidence) report.evidence.emplace();

  Layout layout = lay_out(s, pilot, options);
  ProgressCallback on_progress;
  if (options.evidence)
    on_progress = [&](const std::vector<WeightSums>& cells, const DrawStats& stats) {
      Report then;
      then.checks = judge_counts(s, layout, cells, stats, options.alpha).checks;
      report.evidence->p_after.push_back({stats.draws, then.p()});
    };
  const Counts counts = count_samples(s, pilot, options, layout, on_progress);
  const ClaimedMass mass =
      claimed_mass(s, layout.cubature, layout.masses.total, layout.masses.uncapped, counts.weights);
  report.mass = mass.value;
  report.mass_error = mass.error;

  // The laws of single draws include the pilot.
  append(report.checks, check_draws(s, merge(counts.stats, pilot.stats), options.open_interval));
  append(report.checks, judge_density(s, layout));
  append(report.checks, find_unresolved(s, pilot));
  CellTests tests = judge_counts(s, layout, counts.cells, counts.stats, options.alpha);
  const std::string region = describe_worst_region(s, layout.boxes, layout.cells);
  Check mass_test = test_mass(s, mass, options.alpha);
  explain_mass_by_rounding(s, pilot, mass, mass_test);
  const bool of_samples = is_of_samples(mass_test, mass, tests.checks);
  if (of_samples || mass_test.fault == Fault::shape) blame_samples(mass_test, region);
  if (!of_samples) report.checks.push_back(mass_test);
  append(report.checks, judge_inverse(s, hash(options.seed, 5), options.samples, options.alpha));
  const auto intervals = s.dim > 0 ? find_axis_intervals(s, pilot, counts.coordinates) : std::vector<AxisInterval>();
  const auto judge_intervals = [&](AxisInterval::Kind kind) {
    if (s.dim == 0) return;
    const double total = claimed_total(s, mass.value);
    report.checks.push_back(test_axis_intervals(s, kind, intervals, counts.kept, total, options.alpha));
  };
  judge_intervals(AxisInterval::Kind::atom);
  prepend_finding(tests.checks, region);
  recognise_rotation(s, report.axes, layout, pilot, tests.checks);
  append(report.checks, std::move(tests.checks));
  if (of_samples) report.checks.push_back(mass_test);
  judge_intervals(AxisInterval::Kind::gap); // after the shape tests, which also find wide gaps
  if (s.dim > 0) append(report.checks, judge_detail(s, pilot, layout, counts, mass.value, options.alpha));
  if (s.may_fail) report.checks.push_back(test_failures(s, counts.stats, mass.value, mass.error, options.alpha));
  explain_by_rounding(s, pilot, report.checks);
  report.detectable = tests.detectable;
  report.detectable_cell = tests.detectable_cell;

  double claimed = 0;
  for (const Cell& c : layout.cells) claimed += c.p;
  const double scale = n / claimed_total(s, claimed);
  report.worst = worst_cells(s, layout.boxes, layout.cells, scale);
  if (report.evidence) {
    add_counts(layout.boxes, layout.cells, scale, *report.evidence);
    report.evidence->p_after.push_back({counts.stats.draws, report.p()});
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

double check_memory(std::uint64_t samples) {
  const double n = static_cast<double>(samples);
  constexpr double most_tables = 36e6, tables_per_sample = 120; // of the spectrum, of the reference and of cells
  constexpr double per_pilot_point = 85, per_kept_sample = 2 * sizeof(double); // each kept and sorted
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
