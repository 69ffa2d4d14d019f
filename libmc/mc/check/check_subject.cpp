#include <mc/check/check_subject.h>

#include <mc/check/fit/cell_tests.h>
#include <mc/check/fit/cubature.h>
#include <mc/check/fit/partition.h>
#include <mc/check/fit/slabs.h>
#include <mc/check/fit/uniformity.h>
#include <mc/check/subject/rotation.h>
#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/random/hash.h>
#include <mc/stats/chi_square.h>
#include <mc/stats/multiple_testing.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace mc {
namespace {

using Kind = Subject::Draw::Kind;

// What single draws show, with the first witness of each fault.
struct Tally {
  struct Fault {
    std::uint64_t count = 0, seed = 0, index = 0;
  };
  Fault failed, outside, not_finite, leak, weight;
  double worst_weight = 0;
  std::uint64_t n = 0;
  std::vector<std::uint64_t> atoms;
  std::uint64_t milestone = ~std::uint64_t{0}; ///< on_milestone is called after so many draws
  std::function<void()> on_milestone;

  static void note(Fault& f, std::uint64_t seed, std::uint64_t index) {
    if (f.count++ == 0) f.seed = seed, f.index = index;
  }
};

constexpr std::size_t chunk = 1 << 15;
constexpr std::size_t most_inverted = 1 << 17;

// Shares of alpha; test_cells spends the other 0.91.
constexpr double atoms_share = 0.03, gaps_share = 0.02, failures_share = 0.03, uniformity_share = 0.01;

// At least 200 samples to a cell, at most 4096 cells.
int tree_depth(double samples) { return std::clamp(static_cast<int>(std::log2(std::max(samples, 1.0) / 200)), 0, 12); }

// Draws n samples in chunks; f(draw) for every point.
template <class F> void draw(const Subject& s, std::uint64_t seed, std::uint64_t n, Tally& tally, F&& f) {
  std::vector<Subject::Draw> draws;
  for (std::uint64_t first = 0; first < n; first += chunk) {
    const std::uint64_t stream = hash(seed, first / chunk);
    draws.clear();
    s.draw(stream, static_cast<std::size_t>(std::min<std::uint64_t>(chunk, n - first)), draws);
    require(!draws.empty(), "{}: it draws no samples", s.name);
    for (std::size_t i = 0; i < draws.size(); ++i) {
      const Subject::Draw& d = draws[i];
      if (tally.n == tally.milestone) tally.on_milestone();
      ++tally.n;
      switch (d.kind) {
      case Kind::failed: Tally::note(tally.failed, stream, i); continue;
      case Kind::outside: Tally::note(tally.outside, stream, i); continue;
      case Kind::not_finite: Tally::note(tally.not_finite, stream, i); continue;
      case Kind::atom:
      case Kind::point: break;
      }
      if (!d.pdf_positive) Tally::note(tally.leak, stream, i);
      const double off = std::abs(d.weight - 1);
      if (!(off <= s.weight_tolerance)) Tally::note(tally.weight, stream, i);
      if (!(off <= tally.worst_weight)) tally.worst_weight = off;
      if (d.kind == Kind::atom) {
        if (d.atom < 0 || static_cast<std::size_t>(d.atom) >= s.atoms.size()) Tally::note(tally.outside, stream, i);
        else ++tally.atoms[static_cast<std::size_t>(d.atom)];
        continue;
      }
      f(d.v);
    }
  }
}

void per_sample(const Subject& s, const Tally& t, Report& report) {
  const auto add = [&](const char* name, const Tally::Fault& f, Fault fault, double statistic, double limit) {
    Check c{name, f.count == 0 ? Verdict::pass : Verdict::fail, {}, 0, statistic, limit, fault, {}};
    if (f.count > 0) {
      c.detail = fmt::format("{} of {} samples", f.count, t.n);
      if (s.describe_draw) c.detail += fmt::format(", first {}", s.describe_draw(f.seed, f.index));
    }
    report.checks.push_back(std::move(c));
  };
  const auto count = [](const Tally::Fault& f) { return static_cast<double>(f.count); };
  add("finite", t.not_finite, Fault::not_finite, count(t.not_finite), 0);
  add("in the domain", t.outside, Fault::outside, count(t.outside), 0);
  add("pdf > 0 at samples", t.leak, Fault::leak, count(t.leak), 0);
  add("weight = f / pdf", t.weight, Fault::weight, t.worst_weight, s.weight_tolerance);
  if (!s.may_fail) add("never fails", t.failed, Fault::leak, count(t.failed), 0);
}

// Ranks of a cell's faces in the pilot, per axis.
struct Ranks {
  std::array<std::vector<double>, 3> sorted;
  Ranks(const std::vector<Partition::Coordinates>& pilot, int dim) {
    for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) {
      for (const auto& v : pilot) sorted[d].push_back(v[d]);
      std::sort(sorted[d].begin(), sorted[d].end());
    }
  }
  double operator()(std::size_t axis, double v) const {
    const auto& s = sorted[axis];
    return static_cast<double>(std::lower_bound(s.begin(), s.end(), v) - s.begin()) /
           static_cast<double>(std::max<std::size_t>(s.size(), 1));
  }
};

// Pieces of the cells for the cubature. Where the pilot fills only a corner of its cell, the rest is cut in steps that
// grow by a factor of four, so that a lobe far narrower than the cell cannot slip between the nodes.
struct Pieces {
  std::vector<UnitBox> boxes;
  std::vector<std::size_t> owner;
};

Pieces cut_into_pieces(const Partition& partition, const std::vector<Partition::Coordinates>& pilot, int dim) {
  const auto cells = static_cast<std::size_t>(partition.size());
  std::vector<UnitBox> extent(cells);
  for (UnitBox& e : extent) e.lo = {2, 2, 2}, e.hi = {-1, -1, -1};
  for (const auto& v : pilot) {
    UnitBox& e = extent[static_cast<std::size_t>(partition.cell(v))];
    for (std::size_t d = 0; d < 3; ++d) e.lo[d] = std::min(e.lo[d], v[d]), e.hi[d] = std::max(e.hi[d], v[d]);
  }
  Pieces pieces;
  for (std::size_t i = 0; i < cells; ++i) {
    std::vector<UnitBox> parts{partition.box(static_cast<int>(i))};
    for (std::size_t d = 0; d < static_cast<std::size_t>(dim); ++d) {
      const double lo = parts[0].lo[d], hi = parts[0].hi[d], size = extent[i].hi[d] - extent[i].lo[d];
      if (!(size > 0)) continue;
      std::vector<double> cuts;
      double step = size;
      for (double at = extent[i].lo[d] - size; at > lo + step; step *= 4, at -= step) cuts.push_back(at);
      step = size;
      for (double at = extent[i].hi[d] + size; at < hi - step; step *= 4, at += step) cuts.push_back(at);
      if (cuts.empty()) continue;
      std::sort(cuts.begin(), cuts.end());
      std::vector<UnitBox> finer;
      for (UnitBox part : parts) {
        for (const double at : cuts) {
          if (!(at > part.lo[d] && at < part.hi[d])) continue;
          finer.push_back(part);
          finer.back().hi[d] = part.lo[d] = at;
        }
        finer.push_back(part);
      }
      parts = std::move(finer);
    }
    for (const UnitBox& part : parts) pieces.boxes.push_back(part), pieces.owner.push_back(i);
  }
  return pieces;
}

// Atoms or gaps: the counts of the slabs of one kind against their mass, on the side that the kind suspects.
Check suspects(const Subject& s, Slab::Kind kind, const std::vector<Slab>& slabs, const Report& report, double n) {
  const bool crowd = kind == Slab::Kind::crowd;
  Check c{crowd ? "no atoms" : "no gaps",
          Verdict::pass,
          1.0,
          crowd ? atoms_share : gaps_share,
          0,
          0,
          crowd ? Fault::atom : Fault::local,
          {}};
  double sure = 1;
  const double total = s.may_fail ? 1.0 : std::max(report.mass, 1e-300);
  for (const Slab& slab : slabs) {
    if (slab.kind != kind) continue;
    const double share = static_cast<double>(slab.observed) / n, claimed = crowd ? slab.mass : slab.mass / total;
    if (crowd ? share <= claimed : share >= claimed) continue;
    const double kinder = crowd ? std::min(claimed + slab.error, share) : std::max(claimed - slab.error, share);
    const auto tail = [&](double p) {
      return sidak(binomial_tail(slab.observed, static_cast<std::uint64_t>(n), std::min(p, 1.0)),
                   crowd ? s.dim : 3 * s.dim);
    };
    sure = std::min(sure, tail(kinder));
    // An immaterial error is simply conceded to the sampler.
    const double p = tail(n * slab.error > 0.5 * std::sqrt(std::max(n * claimed, 1.0)) ? claimed : kinder);
    if (p >= *c.p) continue;
    c.p = p;
    c.statistic = static_cast<double>(slab.observed);
    c.detail = fmt::format("{} samples, {:.3g} expected, with coordinate {} of the chart in [{:.17g}, {:.17g}]",
                           slab.observed, n * claimed, slab.axis, slab.box.lo[slab.axis], slab.box.hi[slab.axis]);
  }
  const double level = sidak_level(report.alpha, c.share);
  if (sure <= level) c.verdict = Verdict::fail;
  else if (*c.p <= level) c.verdict = Verdict::inconclusive;
  if (c.verdict == Verdict::pass) c.detail.clear();
  return c;
}

// The rate of failures against what the density leaves of 1. The error of its integral is conceded to the sampler;
// where that would matter the mass itself is inconclusive.
Check failures(const Subject& s, const Tally& t, const Report& report) {
  Check c{"failures", Verdict::pass, {}, failures_share, static_cast<double>(t.failed.count), 0, Fault::mass, {}};
  const double expected = std::clamp(1 - report.mass, 0.0, 1.0), slack = report.mass_error + s.mass_tolerance;
  const double rate = static_cast<double>(t.failed.count) / static_cast<double>(t.n);
  const double kinder = rate > expected ? std::min(expected + slack, rate) : std::max(expected - slack, rate);
  c.p = binomial_tail(t.failed.count, t.n, kinder);
  if (*c.p > sidak_level(report.alpha, c.share)) return c;
  c.verdict = Verdict::fail;
  c.detail = fmt::format("{} of {} samples failed, {:.1f} expected of a density of mass {:.8g} +- {:.2g}",
                         t.failed.count, t.n, expected * static_cast<double>(t.n), report.mass, report.mass_error);
  return c;
}

} // namespace

Report check_subject(const Subject& s, const SubjectOptions& options) {
  require(options.samples >= 1000, "check_subject: samples = {}; at least 1000 are needed", options.samples);
  require(options.alpha > 0 && options.alpha < 1, "check_subject: alpha = {} must lie in (0, 1)", options.alpha);
  const auto start = std::chrono::steady_clock::now();
  Report report;
  report.subject = s.name;
  report.alpha = options.alpha;
  report.samples = options.samples;
  if (s.dim > 0) report.axes = s.axes;
  for (int i = static_cast<int>(report.axes.size()); i < s.dim; ++i) report.axes.push_back({fmt::format("v{}", i)});
  if (options.evidence) report.evidence.emplace();

  Tally tally;
  tally.atoms.assign(s.atoms.size(), 0);
  Tally pilot_tally = tally;
  std::vector<Partition::Coordinates> pilot;
  std::optional<Partition> partition;
  std::vector<UnitBox> boxes;
  CubatureResult masses;
  std::vector<Cell> cells;
  std::vector<Slab> slabs;
  std::vector<Subject::Coordinates> inverted;
  const double n = static_cast<double>(options.samples);

  double atoms_mass = 0;
  for (std::size_t i = 0; i < s.atoms.size(); ++i) {
    require(s.atoms[i] >= 0 && s.atoms[i] <= 1 + 1e-6, "{}: probability of outcome {} = {} must lie in [0, 1]", s.name,
            i, s.atoms[i]);
    atoms_mass += s.atoms[i];
  }

  if (s.dim > 0) {
    draw(s, hash(options.seed, 1), pilot_samples(options.samples), pilot_tally,
         [&](const auto& v) { pilot.push_back(v); });
    const double continuous = n * static_cast<double>(pilot.size()) / static_cast<double>(pilot_tally.n);
    const int depth = tree_depth(continuous);
    const Ranks ranks(pilot, s.dim);
    slabs = suspect_slabs(s, pilot, ranks.sorted);
    partition.emplace(pilot, s.dim, depth);
    for (int i = 0; i < partition->size(); ++i) {
      boxes.push_back(partition->box(i));
      Cell c;
      for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d)
        c.rank_lo[d] = ranks(d, boxes.back().lo[d]),
        c.rank_hi[d] = boxes.back().hi[d] < 1 ? ranks(d, boxes.back().hi[d]) : 1.0;
      cells.push_back(c);
    }
    CubatureGoal goal;
    goal.total_error = 0.06 / std::sqrt(n);
    goal.box_error = [n](double value) { return 0.04 * std::sqrt(std::max(value, 1 / n) / n); };
    goal.max_evaluations = options.max_evaluations;
    const Pieces pieces = cut_into_pieces(*partition, pilot, s.dim);
    masses = integrate_boxes(s.density, s.dim, pieces.boxes, goal);
    for (std::size_t i = 0; i < pieces.boxes.size(); ++i) {
      Cell& c = cells[pieces.owner[i]];
      c.p += masses.boxes[i].value, c.error += masses.boxes[i].error;
    }
    weigh(s, slabs, n, options.max_evaluations / 8);
  }
  report.mass = masses.total.value + atoms_mass;
  report.mass_error = masses.total.error;
  cells.resize(boxes.size() + s.atoms.size());
  for (std::size_t i = 0; i < s.atoms.size(); ++i) cells[boxes.size() + i].p = s.atoms[i];

  // Every test of the counts so far.
  const auto statistics = [&] {
    for (std::size_t i = 0; i < s.atoms.size(); ++i) cells[boxes.size() + i].observed = tally.atoms[i];
    CellTests tests = test_cells(cells, s.dim, options.alpha);
    if (s.dim > 0) {
      const auto of = [&](Slab::Kind kind) { return suspects(s, kind, slabs, report, static_cast<double>(tally.n)); };
      tests.checks.insert(tests.checks.begin(), {of(Slab::Kind::crowd), of(Slab::Kind::gap)});
    }
    if (s.may_fail) tests.checks.push_back(failures(s, tally, report));
    return tests;
  };
  if (options.evidence) {
    tally.milestone = 1024;
    tally.on_milestone = [&] {
      Report so_far;
      so_far.checks = statistics().checks;
      report.evidence->p_after.push_back({tally.n, so_far.p()});
      tally.milestone *= 2;
    };
  }

  if (s.dim > 0) {
    draw(s, hash(options.seed, 2), options.samples, tally, [&](const auto& v) {
      ++cells[static_cast<std::size_t>(partition->cell(v))].observed;
      if (s.invert && inverted.size() < most_inverted) inverted.push_back(s.invert(v));
      for (Slab& slab : slabs)
        slab.observed += v[slab.axis] >= slab.box.lo[slab.axis] && v[slab.axis] <= slab.box.hi[slab.axis];
    });
  } else {
    draw(s, hash(options.seed, 2), options.samples, tally, [](const auto&) {});
  }

  // The pilot's draws obey the same laws.
  Tally all = tally;
  const auto merge = [](Tally::Fault& a, const Tally::Fault& b) {
    if (a.count == 0) a = b;
    else a.count += b.count;
  };
  merge(all.failed, pilot_tally.failed), merge(all.outside, pilot_tally.outside),
      merge(all.not_finite, pilot_tally.not_finite);
  merge(all.leak, pilot_tally.leak), merge(all.weight, pilot_tally.weight);
  all.n += pilot_tally.n;
  all.worst_weight = std::max(all.worst_weight, pilot_tally.worst_weight);
  per_sample(s, all, report);

  if (masses.bad)
    report.checks.push_back(
        {"pdf finite and >= 0",
         Verdict::fail,
         {},
         0,
         1,
         0,
         Fault::not_finite,
         fmt::format("at chart coordinates ({:.17g}, {:.17g}, {:.17g}){}", (*masses.bad)[0], (*masses.bad)[1],
                     (*masses.bad)[2], s.describe_point ? ", " + s.describe_point(*masses.bad) : std::string())});
  {
    const double excess = report.mass - 1, off = s.may_fail ? std::max(excess, 0.0) : std::abs(excess);
    Check c{"mass", Verdict::pass, {}, 0, off, report.mass_error + s.mass_tolerance, Fault::mass, {}};
    if (!(off <= c.limit)) c.verdict = Verdict::fail;
    else if (report.mass_error > 1 / std::sqrt(n)) c.verdict = Verdict::inconclusive;
    if (c.verdict != Verdict::pass)
      c.detail = fmt::format("the density integrates to {:.10g} +- {:.2g}; {} evaluations", report.mass,
                             report.mass_error, masses.evaluations);
    report.checks.push_back(std::move(c));
  }

  for (std::size_t i = 0; i < s.atoms.size(); ++i) {
    if (s.atoms[i] == 0 && tally.atoms[i] > 0)
      report.checks.push_back({"outcomes of probability 0",
                               Verdict::fail,
                               {},
                               0,
                               static_cast<double>(tally.atoms[i]),
                               0,
                               Fault::leak,
                               fmt::format("outcome {} came {} times", i, tally.atoms[i])});
  }
  CellTests tests = statistics();
  const auto of_shape = [](const Check& c) {
    return c.verdict == Verdict::fail && (c.fault == Fault::shape || c.fault == Fault::local);
  };
  if (const auto first = std::find_if(tests.checks.begin(), tests.checks.end(), of_shape);
      first != tests.checks.end() && s.dim > 1) {
    for (std::size_t d = 0; d < static_cast<std::size_t>(s.dim); ++d) {
      if (report.axes[d].scale != Axis::Scale::azimuth) continue;
      const std::optional<double> turn = find_rotation(s, d, *partition, cells, pilot);
      if (!turn) continue;
      first->detail += fmt::format("; as if {} were turned by {:.3g} deg", report.axes[d].name, 360 * *turn);
      for (Check& c : tests.checks)
        if (of_shape(c)) c.fault = Fault::rotation;
    }
  }
  if (!inverted.empty())
    if (auto c = test_uniformity(inverted, s.dim, s.invert_error, options.alpha, uniformity_share))
      report.checks.push_back(std::move(*c));
  for (Check& c : tests.checks) report.checks.push_back(std::move(c));
  report.detectable = tests.detectable;
  report.detectable_cell = tests.detectable_cell;

  const double total = s.may_fail ? 1.0 : std::max(report.mass, 1e-300);
  const auto expected = [&](std::size_t i) { return n * cells[i].p / total; };
  const auto z = [&](std::size_t i) {
    return (static_cast<double>(cells[i].observed) - expected(i)) / std::sqrt(std::max(expected(i), 0.5));
  };
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto five = order.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(order.size(), 5));
  std::partial_sort(order.begin(), five, order.end(),
                    [&](std::size_t a, std::size_t b) { return std::abs(z(a)) > std::abs(z(b)); });
  for (auto i = order.begin(); i != five; ++i) {
    WorstCell w{{}, {}, static_cast<double>(cells[*i].observed), expected(*i), z(*i), {}};
    if (*i < boxes.size()) {
      w.lo = boxes[*i].lo, w.hi = boxes[*i].hi;
      Subject::Coordinates centre;
      for (std::size_t d = 0; d < 3; ++d) centre[d] = 0.5 * (w.lo[d] + w.hi[d]);
      if (s.describe_point) w.where = s.describe_point(centre);
    } else {
      w.where = fmt::format("outcome {}", *i - boxes.size());
    }
    report.worst.push_back(std::move(w));
  }
  if (report.evidence) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      CellCount c{{}, {}, static_cast<double>(cells[i].observed), expected(i)};
      if (i < boxes.size()) c.lo = boxes[i].lo, c.hi = boxes[i].hi;
      (i < boxes.size() ? report.evidence->cells : report.evidence->outcomes).push_back(c);
    }
    report.evidence->p_after.push_back({tally.n, report.p()});
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

std::uint64_t pilot_samples(std::uint64_t samples) { return std::clamp<std::uint64_t>(samples / 8, 1000, 1 << 20); }

std::uint64_t samples_to_detect(double error, double alpha) {
  require(error > 0, "samples_to_detect: error = {} must be > 0", error);
  require(alpha > 0 && alpha < 1, "samples_to_detect: alpha = {} must lie in (0, 1)", alpha);
  // What test_cells reports for cells of equal shares, as a function of the samples.
  const auto detectable = [&](double n) {
    std::vector<Cell> cells(std::size_t{1} << tree_depth(n));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells[i].p = 1 / static_cast<double>(cells.size());
      cells[i].observed = static_cast<std::uint64_t>(n / static_cast<double>(cells.size()));
    }
    return test_cells(std::move(cells), 1, alpha).detectable;
  };
  double lo = 1000, hi = 1e12;
  for (int i = 0; i < 60 && hi > 1.001 * lo; ++i) {
    const double middle = std::sqrt(lo * hi), found = detectable(middle);
    (found > 0 && found <= error ? hi : lo) = middle;
  }
  return static_cast<std::uint64_t>(std::ceil(hi));
}

} // namespace mc
