#include <mc/check/fit/draw_stats.h>

#include <mc/check/fit/interior_density.h>
#include <mc/check/fit/pilot.h>
#include <mc/core/error.h>
#include <mc/random/hash.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mc {
namespace {

using Kind = Subject::Draw::Kind;

constexpr std::size_t chunk = 1 << 15;

void note(DrawStats::Violation& b, std::uint64_t seed, std::uint64_t index) {
  if (b.count++ == 0) {
    b.seed = seed;
    b.index = index;
  }
}

void merge(DrawStats::Violation& x, const DrawStats::Violation& y) {
  const std::uint64_t count = x.count + y.count;
  if (x.count == 0) x = y;
  x.count = count;
}

// Returns whether the draw is a point or a listed outcome; else counts the violation.
bool is_sample(const Subject::Draw& d, std::uint64_t seed, std::uint64_t index, DrawStats& stats) {
  switch (d.kind) {
  case Kind::failed: note(stats.failed, seed, index); return false;
  case Kind::outside: note(stats.outside, seed, index); return false;
  case Kind::not_finite: note(stats.not_finite, seed, index); return false;
  case Kind::atom:
    if (d.atom >= 0 && static_cast<std::size_t>(d.atom) < stats.atoms.size()) return true;
    note(stats.outside, seed, index);
    return false;
  case Kind::point: return true;
  }
  return false;
}

// Rounding moves very few samples onto a zero of the density, but many onto a pole.
constexpr std::uint64_t most_rounded = 3;

// Returns the density next to a point that has none itself. Once violations exceed the tolerance the distribution is
// broken, and the search stops: its density may be slow.
std::optional<double> rounded_from(const Subject& s, const Subject::Draw& d, const DrawStats& stats) {
  if (d.pdf_positive || d.kind != Kind::point) return {};
  if (d.at_pole) return d.density;
  if (stats.zero_pdf.count + stats.non_finite_pdf.count > most_rounded) return {};
  if (d.density == 0) // the map through the chart rounds, too
    if (const double there = s.density(d.v); there > 0 && std::isfinite(there)) return there;
  return adjacent_density(s, d.v);
}

DrawStats::Violation& density_violation(const Subject& s, const Subject::Draw& d, bool is_rounded, DrawStats& stats) {
  if (d.at_pole) return stats.boundary_non_finite_pdf;
  if (is_rounded) { // NaN and negative values are no result of rounding
    const double there = s.density(d.v);
    if (there >= 0) return std::isfinite(there) ? stats.boundary_zero_pdf : stats.boundary_non_finite_pdf;
  }
  if (!std::isfinite(d.density)) return stats.non_finite_pdf;
  return d.kind == Kind::point && d.density < 0 && s.density(d.v) < 0 ? stats.negative_pdf : stats.zero_pdf;
}

// Returns the relative change of the claimed density within four steps of rounding about a point. The distribution
// computes its stated density before it rounds the point, so the two densities may differ by this amount. In sharp
// lobes over float it exceeds any fixed tolerance.
double spread_by_rounding(const Subject& s, const Subject::Coordinates& v) {
  double spread = 0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(s.dim); ++axis) {
    const double step = 4 * rounding_step(s, v, axis);
    double along = 0;
    for (const double to : {v[axis] - step, v[axis] + step}) {
      Subject::Coordinates moved = v;
      moved[axis] = std::clamp(to, 0.0, 1.0);
      along = std::max(along, std::abs(s.density(moved) / s.density(v) - 1));
    }
    spread += along;
  }
  return std::isfinite(spread) ? spread : 0.0;
}

// Returns |weight - 1| beyond the error that rounding of the point explains.
double weight_error(const Subject& s, const Subject::Draw& d) {
  const double off = std::abs(d.weight - 1);
  if (off <= s.weight_tolerance || d.kind != Kind::point) return off;
  return std::max(off - spread_by_rounding(s, d.v), s.weight_tolerance);
}

// Counts the violations of a draw. Returns the density of a point of the domain; no value for other draws.
std::optional<double> count_draw(const Subject& s, const Subject::Draw& d, std::uint64_t stream, std::uint64_t index,
                                 DrawStats& stats) {
  ++stats.draws;
  if (!is_sample(d, stream, index, stats)) return {};
  const std::optional<double> rounded = rounded_from(s, d, stats);
  if (!d.pdf_positive) note(density_violation(s, d, rounded.has_value(), stats), stream, index);
  const double off = weight_error(s, d);
  if (!(off <= s.weight_tolerance)) note(stats.weight, stream, index);
  // NaN counts as the largest error.
  stats.max_weight_error =
      std::max(stats.max_weight_error, std::isnan(off) ? std::numeric_limits<double>::infinity() : off);
  if (d.kind == Kind::atom) {
    ++stats.atoms[static_cast<std::size_t>(d.atom)];
    return {};
  }
  if (rounded) return rounded;
  return d.density >= 0 ? d.density : s.density(d.v);
}

// Whether only the position of a draw matters, which is true for nearly all draws.
bool is_plain(const Subject::Draw& d) {
  return d.kind == Kind::point && d.pdf_positive && d.weight == 1 && d.density >= 0;
}

} // namespace

DrawStats draw_samples(const Subject& s, std::uint64_t seed, std::uint64_t n, const PointsCallback& points,
                       const std::function<void(const DrawStats& stats)>& on_progress) {
  constexpr std::size_t together = 4096;
  DrawStats stats;
  stats.atoms.assign(s.atoms.size(), 0);
  std::vector<Subject::Draw> draws;
  std::vector<Subject::Coordinates> v;
  std::vector<double> densities;
  const auto hand_over = [&] {
    if (!v.empty()) points(v, densities);
    v.clear();
    densities.clear();
  };
  std::uint64_t milestone = 1024;
  for (std::uint64_t first = 0; first < n; first += chunk) {
    const std::uint64_t stream = hash(seed, first / chunk);
    draws.clear();
    s.draw(stream, static_cast<std::size_t>(std::min<std::uint64_t>(chunk, n - first)), draws);
    require(!draws.empty(), "{}: it draws no samples", s.name);
    for (std::size_t i = 0; i < draws.size(); ++i) {
      if (stats.draws == milestone) {
        milestone *= 2;
        if (on_progress) {
          hand_over();
          on_progress(stats);
        }
      }
      const Subject::Draw& d = draws[i];
      double density = d.density;
      if (is_plain(d)) {
        ++stats.draws;
      } else {
        const std::optional<double> counted = count_draw(s, d, stream, i, stats);
        if (!counted) continue;
        density = *counted;
      }
      v.push_back(d.v);
      densities.push_back(density);
      if (v.size() == together) hand_over();
    }
  }
  hand_over();
  return stats;
}

DrawStats merge(DrawStats a, const DrawStats& b) {
  merge(a.failed, b.failed);
  merge(a.outside, b.outside);
  merge(a.not_finite, b.not_finite);
  merge(a.zero_pdf, b.zero_pdf);
  merge(a.non_finite_pdf, b.non_finite_pdf);
  merge(a.negative_pdf, b.negative_pdf);
  merge(a.boundary_zero_pdf, b.boundary_zero_pdf);
  merge(a.boundary_non_finite_pdf, b.boundary_non_finite_pdf);
  merge(a.weight, b.weight);
  a.max_weight_error = std::max(a.max_weight_error, b.max_weight_error);
  a.draws += b.draws;
  return a;
}

std::vector<Check> check_draws(const Subject& s, const DrawStats& stats, bool open_interval) {
  std::vector<Check> checks;
  // `finding` describes the violation of the first such draw; remarks follow after "; ".
  const auto add = [&](const char* name, const DrawStats::Violation& b, Fault fault, double statistic, double limit,
                       const std::string& finding) {
    Check c{name, b.count == 0 ? Verdict::pass : Verdict::fail, {}, 0, statistic, limit, fault, {}};
    if (b.count > 0) {
      const std::size_t clause = std::min(finding.find("; "), finding.size());
      c.detail = finding.substr(0, clause);
      if (s.describe_draw) c.detail += ", at " + s.describe_draw(b.seed, b.index);
      c.detail += fmt::format("; {} of {} samples{}", b.count, stats.draws, finding.substr(clause));
    }
    checks.push_back(std::move(c));
  };
  const auto count = [](const DrawStats::Violation& b) { return static_cast<double>(b.count); };
  add("finite", stats.not_finite, Fault::not_finite, count(stats.not_finite), 0, "sample is not finite");
  add("in the domain", stats.outside, Fault::outside, count(stats.outside), 0, "sample is outside the domain");
  if (stats.non_finite_pdf.count > 0)
    add("pdf finite at samples", stats.non_finite_pdf, Fault::not_finite, count(stats.non_finite_pdf), 0,
        "pdf is not finite");
  if (stats.negative_pdf.count > 0)
    add("pdf >= 0 at samples", stats.negative_pdf, Fault::negative, count(stats.negative_pdf), 0, "pdf is negative");
  DrawStats::Violation leak = stats.zero_pdf, edge = stats.boundary_non_finite_pdf;
  merge(stats.zero_pdf.count + stats.boundary_zero_pdf.count > most_rounded ? leak : edge, stats.boundary_zero_pdf);
  add("pdf > 0 at samples", leak, Fault::zero_pdf, count(leak), 0, "pdf is 0, should be > 0 at every sample");
  if (edge.count > 0 && !open_interval) {
    add("pdf at boundaries and jumps", edge, Fault::measure_zero, count(edge), 0,
        "pdf is 0 or infinite, on a boundary or a jump of the density; option open_interval (carlo validate "
        "--open-interval) accepts such samples as measure zero");
    checks.back().verdict = Verdict::warning;
  }
  const bool describes = s.describe_weight && stats.weight.count > 0;
  add("weight = f / pdf", stats.weight, Fault::weight, stats.max_weight_error, s.weight_tolerance,
      describes ? s.describe_weight(stats.weight.seed, stats.weight.index)
                : fmt::format("weight differs from f / pdf by {:.3g}, relative", stats.max_weight_error));
  if (stats.draws > 0 && stats.failed.count == stats.draws) {
    add("draws samples", {}, Fault::none, 0, 1, "");
    checks.back().verdict = Verdict::inconclusive;
    checks.back().detail = fmt::format("none of {} draws gives a sample, so no test is possible", stats.draws);
  }
  if (!s.may_fail) {
    add("never fails", stats.failed, Fault::failure, count(stats.failed), 0,
        "sample fails; set may_fail if a sample may fail, with a density of less mass");
  }
  for (std::size_t i = 0; i < s.atoms.size(); ++i) {
    if (s.atoms[i] > 0 || stats.atoms[i] == 0) continue;
    checks.push_back(
        {"outcomes of probability 0",
         Verdict::fail,
         {},
         0,
         static_cast<double>(stats.atoms[i]),
         0,
         Fault::zero_pdf,
         fmt::format("outcome {} was drawn {} times, should never be: its probability is 0", i, stats.atoms[i])});
  }
  return checks;
}

} // namespace mc
