#include <mc/check/fit/draw_tally.h>

#include <mc/check/fit/density_inside.h>
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

void note(DrawTally::Broken& b, std::uint64_t seed, std::uint64_t index) {
  if (b.count++ == 0) {
    b.seed = seed;
    b.index = index;
  }
}

void merge(DrawTally::Broken& x, const DrawTally::Broken& y) {
  const std::uint64_t count = x.count + y.count;
  if (x.count == 0) x = y;
  x.count = count;
}

// Whether the draw is a point or an outcome at all.
bool is_sample(const Subject::Draw& d, std::uint64_t seed, std::uint64_t index, DrawTally& tally) {
  switch (d.kind) {
  case Kind::failed: note(tally.failed, seed, index); return false;
  case Kind::outside: note(tally.outside, seed, index); return false;
  case Kind::not_finite: note(tally.not_finite, seed, index); return false;
  case Kind::atom:
    if (d.atom >= 0 && static_cast<std::size_t>(d.atom) < tally.atoms.size()) return true;
    note(tally.outside, seed, index);
    return false;
  case Kind::point: return true;
  }
  return false;
}

// Rounding puts hardly a sample where the density vanishes, but many where it is infinite.
constexpr std::uint64_t most_rounded = 3;

// The density that a point without one has beside it. Of a sampler that is broken beyond doubt no more is asked: it may
// answer slowly.
std::optional<double> rounded_from(const Subject& s, const Subject::Draw& d, const DrawTally& tally) {
  if (d.pdf_positive || d.kind != Kind::point || tally.leak.count + tally.bad_pdf.count > most_rounded) return {};
  if (d.density == 0) // the way through the chart rounds, too
    if (const double there = s.density(d.v); there > 0 && std::isfinite(there)) return there;
  return density_beside(s, d.v);
}

DrawTally::Broken& broken_by_density(const Subject& s, const Subject::Draw& d, bool is_rounded, DrawTally& tally) {
  if (is_rounded) return std::isfinite(s.density(d.v)) ? tally.zero_edge : tally.edge;
  if (!std::isfinite(d.density)) return tally.bad_pdf;
  return d.kind == Kind::point && d.density < 0 && s.density(d.v) < 0 ? tally.negative : tally.leak;
}

// How much the claimed density changes within four steps of rounding about a point, relative. The density that a
// sampler had in mind, before it rounded its point, differs by as much: in sharp lobes of float by more than any
// tolerance.
double spread_by_rounding(const Subject& s, const Subject::Coordinates& v) {
  double spread = 0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(s.dim); ++axis) {
    const double step = 4 * rounding(s, v, axis);
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

// |weight - 1| beyond what rounding of the point explains.
double weight_error(const Subject& s, const Subject::Draw& d) {
  const double off = std::abs(d.weight - 1);
  if (off <= s.weight_tolerance || d.kind != Kind::point) return off;
  return std::max(off - spread_by_rounding(s, d.v), s.weight_tolerance);
}

// Counts what is broken about a draw; the density of a point, none where it is no point of the domain.
std::optional<double> count_draw(const Subject& s, const Subject::Draw& d, std::uint64_t stream, std::uint64_t index,
                                 DrawTally& tally) {
  ++tally.draws;
  if (!is_sample(d, stream, index, tally)) return {};
  const std::optional<double> rounded = rounded_from(s, d, tally);
  if (!d.pdf_positive) note(broken_by_density(s, d, rounded.has_value(), tally), stream, index);
  const double off = weight_error(s, d);
  if (!(off <= s.weight_tolerance)) note(tally.weight, stream, index);
  // Not a number is worse than any.
  tally.worst_weight = std::max(tally.worst_weight, std::isnan(off) ? std::numeric_limits<double>::infinity() : off);
  if (d.kind == Kind::atom) {
    ++tally.atoms[static_cast<std::size_t>(d.atom)];
    return {};
  }
  if (rounded) return rounded;
  return d.density >= 0 ? d.density : s.density(d.v);
}

// Whether nothing is to be said of a draw but where it lies: true of nearly all.
bool is_plain(const Subject::Draw& d) {
  return d.kind == Kind::point && d.pdf_positive && d.weight == 1 && d.density >= 0;
}

} // namespace

DrawTally draw_samples(const Subject& s, std::uint64_t seed, std::uint64_t n, const DrawnPoints& points,
                       const std::function<void(const DrawTally& tally)>& so_far) {
  constexpr std::size_t together = 4096;
  DrawTally tally;
  tally.atoms.assign(s.atoms.size(), 0);
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
      if (tally.draws == milestone) {
        milestone *= 2;
        if (so_far) {
          hand_over();
          so_far(tally);
        }
      }
      const Subject::Draw& d = draws[i];
      double density = d.density;
      if (is_plain(d)) {
        ++tally.draws;
      } else {
        const std::optional<double> counted = count_draw(s, d, stream, i, tally);
        if (!counted) continue;
        density = *counted;
      }
      v.push_back(d.v);
      densities.push_back(density);
      if (v.size() == together) hand_over();
    }
  }
  hand_over();
  return tally;
}

DrawTally merged(DrawTally a, const DrawTally& b) {
  merge(a.failed, b.failed);
  merge(a.outside, b.outside);
  merge(a.not_finite, b.not_finite);
  merge(a.leak, b.leak);
  merge(a.bad_pdf, b.bad_pdf);
  merge(a.negative, b.negative);
  merge(a.zero_edge, b.zero_edge);
  merge(a.edge, b.edge);
  merge(a.weight, b.weight);
  a.worst_weight = std::max(a.worst_weight, b.worst_weight);
  a.draws += b.draws;
  return a;
}

std::vector<Check> check_draws(const Subject& s, const DrawTally& tally, bool open_interval) {
  std::vector<Check> checks;
  // `finding` says of the first such sample what is wrong, and perhaps more after "; ".
  const auto add = [&](const char* name, const DrawTally::Broken& b, Fault fault, double statistic, double limit,
                       const std::string& finding) {
    Check c{name, b.count == 0 ? Verdict::pass : Verdict::fail, {}, 0, statistic, limit, fault, {}};
    if (b.count > 0) {
      const std::size_t clause = std::min(finding.find("; "), finding.size());
      c.detail = finding.substr(0, clause);
      if (s.describe_draw) c.detail += ", at " + s.describe_draw(b.seed, b.index);
      c.detail += fmt::format("; {} of {} samples{}", b.count, tally.draws, finding.substr(clause));
    }
    checks.push_back(std::move(c));
  };
  const auto count = [](const DrawTally::Broken& b) { return static_cast<double>(b.count); };
  add("finite", tally.not_finite, Fault::not_finite, count(tally.not_finite), 0, "sample is not finite");
  add("in the domain", tally.outside, Fault::outside, count(tally.outside), 0, "sample is outside the domain");
  if (tally.bad_pdf.count > 0)
    add("pdf finite at samples", tally.bad_pdf, Fault::not_finite, count(tally.bad_pdf), 0, "pdf is not finite");
  if (tally.negative.count > 0)
    add("pdf >= 0 at samples", tally.negative, Fault::negative, count(tally.negative), 0, "pdf is negative");
  DrawTally::Broken leak = tally.leak, edge = tally.edge;
  merge(tally.leak.count + tally.zero_edge.count > most_rounded ? leak : edge, tally.zero_edge);
  add("pdf > 0 at samples", leak, Fault::leak, count(leak), 0, "pdf is 0, should be > 0 at every sample");
  if (edge.count > 0 && !open_interval)
    add("pdf at boundaries and jumps", edge, Fault::zero_edge, count(edge), 0,
        "pdf is 0 or infinite, on a boundary or a jump of the density; option open_interval (carlo validate "
        "--open-interval) accepts such samples as measure zero");
  const bool describes = s.describe_weight && tally.weight.count > 0;
  add("weight = f / pdf", tally.weight, Fault::weight, tally.worst_weight, s.weight_tolerance,
      describes ? s.describe_weight(tally.weight.seed, tally.weight.index)
                : fmt::format("weight differs from f / pdf by {:.3g}, relative", tally.worst_weight));
  if (tally.draws > 0 && tally.failed.count == tally.draws) {
    add("draws samples", {}, Fault::none, 0, 1, "");
    checks.back().verdict = Verdict::inconclusive;
    checks.back().detail = fmt::format("none of {} draws gives a sample, so no test is possible", tally.draws);
  }
  if (!s.may_fail) {
    add("never fails", tally.failed, Fault::failure, count(tally.failed), 0,
        "sample fails; set may_fail if a sample may fail, with a density of less mass");
  }
  for (std::size_t i = 0; i < s.atoms.size(); ++i) {
    if (s.atoms[i] > 0 || tally.atoms[i] == 0) continue;
    checks.push_back(
        {"outcomes of probability 0",
         Verdict::fail,
         {},
         0,
         static_cast<double>(tally.atoms[i]),
         0,
         Fault::leak,
         fmt::format("outcome {} was drawn {} times, should never be: its probability is 0", i, tally.atoms[i])});
  }
  return checks;
}

} // namespace mc
