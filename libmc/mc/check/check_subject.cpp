#include <mc/check/check_subject.h>

#include <mc/check/fit/alpha_shares.h>
#include <mc/check/fit/tests/cell_masses.h>
#include <mc/check/fit/tests/rotation.h>
#include <mc/check/fit/tests/slabs.h>
#include <mc/check/fit/tests/uniformity.h>
#include <mc/check/summary.h>
#include <mc/core/error.h>
#include <mc/random/hash.h>
#include <mc/stats/binomial.h>
#include <mc/stats/multiple_testing.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mc {
namespace {

constexpr std::size_t most_inverted = 1 << 17;

// Where the samples will be counted, and how many the density claims there.
struct Layout {
  std::optional<Partition> partition; ///< of subjects with axes
  std::vector<UnitBox> boxes;         ///< of its cells; the cells beyond them are discrete outcomes
  std::vector<Cell> cells;
  std::vector<Slab> slabs;
  CubatureResult integrals;
  double mass = 0; ///< of density and outcomes
};

// What was counted there.
struct Counts {
  DrawTally tally;
  std::vector<Subject::Coordinates> inverted; ///< the first samples, through the subject's own inverse
};

Layout lay_out(const Subject& s, const Pilot& pilot, const SubjectOptions& options) {
  Layout layout;
  const double n = static_cast<double>(options.samples);
  if (s.dim > 0) {
    CellMasses masses = integrate_cells(s, pilot, n, options.max_evaluations);
    layout.slabs = suspect_slabs(s, pilot.points, pilot.sorted);
    integrate_slabs(s, layout.slabs, n, options.max_evaluations / 8);
    for (int i = 0; i < masses.partition.size(); ++i) layout.boxes.push_back(masses.partition.box(i));
    layout.partition = std::move(masses.partition);
    layout.cells = std::move(masses.cells);
    layout.integrals = std::move(masses.integrals);
  }
  layout.mass = layout.integrals.total.value;
  for (std::size_t i = 0; i < s.atoms.size(); ++i) {
    require(s.atoms[i] >= 0 && s.atoms[i] <= 1 + 1e-6, "{}: probability of outcome {} = {} must lie in [0, 1]", s.name,
            i, s.atoms[i]);
    layout.cells.emplace_back().p = s.atoms[i];
    layout.mass += s.atoms[i];
  }
  return layout;
}

// The integral of the density that samples are held against: failures make up what it lacks to 1.
double claimed_total(const Subject& s, double mass) { return s.may_fail ? 1.0 : std::max(mass, 1e-300); }

// The rate of failures against what the density leaves of 1. The error of its integral is conceded to the sampler;
// where that would matter the mass itself is inconclusive.
Check test_failures(const Subject& s, const DrawTally& t, double mass, double mass_error, double alpha) {
  Check c{"failures", Verdict::pass, {}, alpha_share(FitTest::failures, s.dim), static_cast<double>(t.failed.count),
          0,          Fault::mass,   {}};
  const double expected = std::clamp(1 - mass, 0.0, 1.0), slack = mass_error + s.mass_tolerance;
  const double rate = static_cast<double>(t.failed.count) / static_cast<double>(t.draws);
  const double conceded = rate > expected ? std::min(expected + slack, rate) : std::max(expected - slack, rate);
  c.p = binomial_tail(t.failed.count, t.draws, conceded);
  if (*c.p > sidak_level(alpha, c.share)) return c;
  c.verdict = Verdict::fail;
  c.detail = fmt::format("{} of {} samples failed, {:.1f} expected of a density of mass {:.8g} +- {:.2g}",
                         t.failed.count, t.draws, expected * static_cast<double>(t.draws), mass, mass_error);
  return c;
}

// Every test of the counts so far.
CellTests judge_counts(const Subject& s, Layout& layout, const DrawTally& tally, double alpha) {
  for (std::size_t i = 0; i < s.atoms.size(); ++i) layout.cells[layout.boxes.size() + i].observed = tally.atoms[i];
  CellTests tests = test_cells(layout.cells, s.dim, alpha);
  if (s.dim > 0) {
    const double n = static_cast<double>(tally.draws), total = claimed_total(s, layout.mass);
    tests.checks.insert(tests.checks.begin(), {test_slabs(s, Slab::Kind::atom, layout.slabs, n, total, alpha),
                                               test_slabs(s, Slab::Kind::gap, layout.slabs, n, total, alpha)});
  }
  if (s.may_fail) tests.checks.push_back(test_failures(s, tally, layout.mass, layout.integrals.total.error, alpha));
  return tests;
}

// Draws and counts; `so_far` is called with the tally after 1024, 2048, ... draws.
Counts count_samples(const Subject& s, const SubjectOptions& options, Layout& layout,
                     const std::function<void(const DrawTally&)>& so_far) {
  Counts counts;
  const auto count = [&](const Subject::Coordinates& v) {
    ++layout.cells[static_cast<std::size_t>(layout.partition->cell(v))].observed;
    if (s.invert && counts.inverted.size() < most_inverted) counts.inverted.push_back(s.invert(v));
    for (Slab& slab : layout.slabs)
      slab.observed += v[slab.axis] >= slab.box.lo[slab.axis] && v[slab.axis] <= slab.box.hi[slab.axis];
  };
  std::uint64_t milestone = 1024;
  const auto before = [&](const DrawTally& tally) {
    if (tally.draws != milestone) return;
    so_far(tally);
    milestone *= 2;
  };
  counts.tally = draw_samples(s, hash(options.seed, 2), options.samples, count,
                              so_far ? std::function<void(const DrawTally&)>(before) : nullptr);
  return counts;
}

std::vector<Check> judge_mass(const Subject& s, const Layout& layout, double samples) {
  std::vector<Check> checks;
  if (const auto& bad = layout.integrals.bad)
    checks.push_back({"pdf finite and >= 0",
                      Verdict::fail,
                      {},
                      0,
                      1,
                      0,
                      Fault::not_finite,
                      fmt::format("at chart coordinates ({:.17g}, {:.17g}, {:.17g}){}", (*bad)[0], (*bad)[1], (*bad)[2],
                                  s.describe_point ? ", " + s.describe_point(*bad) : std::string())});
  const double excess = layout.mass - 1, off = s.may_fail ? std::max(excess, 0.0) : std::abs(excess);
  const double error = layout.integrals.total.error;
  Check c{"mass", Verdict::pass, {}, 0, off, error + s.mass_tolerance, Fault::mass, {}};
  if (!(off <= c.limit)) c.verdict = Verdict::fail;
  else if (error > 1 / std::sqrt(samples)) c.verdict = Verdict::inconclusive;
  if (c.verdict != Verdict::pass)
    c.detail = fmt::format("the density integrates to {:.10g} +- {:.2g}; {} evaluations", layout.mass, error,
                           layout.integrals.evaluations);
  checks.push_back(std::move(c));
  return checks;
}

// Where a turn about the pole explains the counts, the faults of shape are called a rotation.
void recognise_rotation(const Subject& s, const std::vector<Axis>& axes, const Layout& layout, const Pilot& pilot,
                        std::vector<Check>& checks) {
  const auto of_shape = [](const Check& c) {
    return c.verdict == Verdict::fail && (c.fault == Fault::shape || c.fault == Fault::local);
  };
  const auto first = std::find_if(checks.begin(), checks.end(), of_shape);
  if (first == checks.end() || s.dim < 2) return;
  for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
    if (axes[d].scale != Axis::Scale::azimuth) continue;
    const std::optional<double> turn = find_rotation(s, d, *layout.partition, layout.cells, pilot.points);
    if (!turn) continue;
    first->detail += fmt::format("; as if {} were turned by {:.3g} deg", axes[d].name, 360 * *turn);
    for (Check& c : checks)
      if (of_shape(c)) c.fault = Fault::rotation;
  }
}

void append(std::vector<Check>& all, std::vector<Check> more) {
  for (Check& c : more) all.push_back(std::move(c));
}

} // namespace

Report check_subject(const Subject& s, const SubjectOptions& options) {
  require(options.samples >= 1000, "check_subject: samples = {}; at least 1000 are needed", options.samples);
  require(options.alpha > 0 && options.alpha < 1, "check_subject: alpha = {} must lie in (0, 1)", options.alpha);
  const auto start = std::chrono::steady_clock::now();
  const double n = static_cast<double>(options.samples);
  Report report;
  report.subject = s.name;
  report.alpha = options.alpha;
  report.samples = options.samples;
  report.axes = named_axes(s);
  if (options.evidence) report.evidence.emplace();

  const Pilot pilot = s.dim > 0 ? draw_pilot(s, hash(options.seed, 1), options.samples) : Pilot{};
  Layout layout = lay_out(s, pilot, options);
  report.mass = layout.mass;
  report.mass_error = layout.integrals.total.error;

  std::function<void(const DrawTally&)> so_far;
  if (options.evidence)
    so_far = [&](const DrawTally& tally) {
      Report then;
      then.checks = judge_counts(s, layout, tally, options.alpha).checks;
      report.evidence->p_after.push_back({tally.draws, then.p()});
    };
  const Counts counts = count_samples(s, options, layout, so_far);

  // The pilot's draws obey the same laws.
  append(report.checks, check_draws(s, merged(counts.tally, pilot.tally)));
  append(report.checks, judge_mass(s, layout, n));
  if (!counts.inverted.empty())
    if (auto c = test_uniformity(counts.inverted, s.dim, s.invert_error, options.alpha,
                                 alpha_share(FitTest::inverse, s.dim)))
      report.checks.push_back(std::move(*c));
  CellTests tests = judge_counts(s, layout, counts.tally, options.alpha);
  recognise_rotation(s, report.axes, layout, pilot, tests.checks);
  append(report.checks, std::move(tests.checks));
  report.detectable = tests.detectable;
  report.detectable_cell = tests.detectable_cell;

  const double scale = n / claimed_total(s, layout.mass);
  report.worst = worst_cells(s, layout.boxes, layout.cells, scale);
  if (report.evidence) {
    add_counts(layout.boxes, layout.cells, scale, *report.evidence);
    report.evidence->p_after.push_back({counts.tally.draws, report.p()});
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

std::uint64_t samples_to_detect(double error, double alpha) {
  require(error > 0, "samples_to_detect: error = {} must be > 0", error);
  require(alpha > 0 && alpha < 1, "samples_to_detect: alpha = {} must lie in (0, 1)", alpha);
  // What test_cells reports for cells of equal shares, as a function of the samples.
  const auto detectable = [&](double n) {
    std::vector<Cell> cells(std::size_t{1} << tree_depth(n));
    for (Cell& c : cells) {
      c.p = 1 / static_cast<double>(cells.size());
      c.observed = static_cast<std::uint64_t>(n / static_cast<double>(cells.size()));
    }
    return test_cells(cells, 1, alpha).detectable;
  };
  double lo = 1000, hi = 1e12;
  for (int i = 0; i < 60 && hi > 1.001 * lo; ++i) {
    const double middle = std::sqrt(lo * hi), found = detectable(middle);
    (found > 0 && found <= error ? hi : lo) = middle;
  }
  return static_cast<std::uint64_t>(std::ceil(hi));
}

} // namespace mc
