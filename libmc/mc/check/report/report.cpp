#include <mc/check/report/report.h>

#include <mc/stats/multiple_testing.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

namespace mc {

std::string_view name(Verdict v) {
  switch (v) {
  case Verdict::pass: return "pass";
  case Verdict::fail: return "fail";
  case Verdict::inconclusive: return "inconclusive";
  case Verdict::warning: return "warning";
  }
  return "";
}

std::string_view name(Fault f) {
  switch (f) {
  case Fault::none: return "none";
  case Fault::boundary: return "boundary: sample or pdf is wrong at the ends of [0,1) or beside a branch";
  case Fault::measure_zero: return "measure zero: only single values of u or single points are wrong, not the density";
  case Fault::nondeterministic: return "not deterministic: equal arguments give different results";
  case Fault::not_finite: return "not finite: a sample, pdf or f is infinite or not a number";
  case Fault::negative: return "negative: the density is below zero";
  case Fault::outside: return "outside: samples lie outside the domain";
  case Fault::failure: return "failure: sample fails at another rate than the mass of the density requires";
  case Fault::zero_pdf: return "leak: samples lie where the density is zero";
  case Fault::mass: return "mass: the density does not integrate to one";
  case Fault::weight: return "weight: a stated weight, pdf or f differs from eval and pdf";
  case Fault::support: return "support: the integrand is positive where the density is zero";
  case Fault::inverse: return "inverse: invert does not undo sample";
  case Fault::jacobian: return "jacobian: pdf is not the density of sample";
  case Fault::precision: return "precision: the rounding error exceeds the stated bound";
  case Fault::atom: return "atom: many samples share one value of a coordinate";
  case Fault::rotation: return "rotation: the samples follow the density rotated about its pole";
  case Fault::shape: return "shape: the samples follow a different density";
  case Fault::local: return "local: single cells contain too many or too few samples";
  case Fault::physics: return "physics: f violates reciprocity, energy conservation or its sign";
  case Fault::rounding: return "rounding: too few distinct values for this density";
  case Fault::dependent: return "dependent: the samples depend on each other, or their counts are too even";
  case Fault::bias: return "bias: the mean of the estimates differs from the true value";
  }
  return "";
}

Verdict Report::verdict() const {
  Verdict v = Verdict::pass;
  for (const Check& c : checks) {
    if (c.verdict == Verdict::fail) return Verdict::fail;
    if (c.verdict == Verdict::inconclusive) v = Verdict::inconclusive;
  }
  return v;
}

double Report::p() const {
  double least = 1;
  for (const Check& c : checks)
    if (c.p) least = std::min(least, sidak_share(*c.p, c.share));
  return least;
}

namespace {

template <class Accepts> const Check* first_failed(const std::vector<Check>& checks, Accepts accepts) {
  for (const Check& c : checks)
    if (c.verdict == Verdict::fail && accepts(c)) return &c;
  return nullptr;
}

const Check* leading_failure(const std::vector<Check>& checks) {
  const auto measure_zero = [](const Check& c) { return c.fault == Fault::measure_zero; };
  const Check* certain = first_failed(checks, [&](const Check& c) { return !c.p && !measure_zero(c); });
  const Check* beyond_doubt = first_failed(checks, [](const Check& c) { return c.p && *c.p < 1e-9; });
  // A wrong density also makes the white furnace fail, because the furnace divides by the density.
  if (beyond_doubt && certain && (certain->fault == Fault::boundary || certain->fault == Fault::physics))
    return beyond_doubt;
  if (certain) return certain;
  const Check* likely = first_failed(checks, [](const Check& c) { return c.p.has_value(); });
  return likely ? likely : first_failed(checks, measure_zero);
}

std::string p_text(double p) { return p < 1e-300 ? std::string("p < 1e-300") : fmt::format("p = {:.3g}", p); }

std::string percent(double error) { return error > 1 ? "more than 100 %" : fmt::format("{:.2g} %", 100 * error); }

// Chance rarely exceeds this |z| in the worst of a few thousand cells.
constexpr double least_telling = 4;

// Returns "cell theta 1.5 to 3 deg, phi 0 to 90 deg, about (0.04, 0, 0.999), contains 120 samples, 64.0 expected (z =
// 7.0)".
std::string describe_worst(const std::vector<Axis>& axes, const WorstCell& w) {
  const std::string count = fmt::format("{:.0f} samples, {:.1f} expected (z = {:.1f})", w.observed, w.expected, w.z);
  if (w.lo == w.hi) return fmt::format("{} has {}", w.where, count);
  const std::string range = describe_cell(axes, w.lo, w.hi);
  return fmt::format("cell{}{}{} contains {}", range.empty() ? "" : " " + range,
                     w.where.empty() ? "" : ", about " + w.where, w.where.empty() ? "" : ",", count);
}

// Whether the worst cells help to explain the failure.
bool concerns_cells(const Check& c) {
  return c.p && (c.fault == Fault::shape || c.fault == Fault::local || c.fault == Fault::rotation);
}

std::string_view first_clause(std::string_view detail) { return detail.substr(0, detail.find("; ")); }
std::string_view remarks(std::string_view detail) { return detail.substr(first_clause(detail).size()); }

// Returns "(p = 1e-9)" or "(largest error 0.2, limit 0.001)"; empty for a law without tolerance, which only counts
// violations.
std::string measure(const Check& c) {
  if (c.verdict != Verdict::fail) return {};
  if (c.p) return fmt::format(" ({})", p_text(*c.p));
  return c.limit > 0 ? fmt::format(" (largest error {:.6g}, limit {:.6g})", c.statistic, c.limit) : std::string();
}

// Returns the line below the finding: "law: weight = f / pdf (largest error 0.2, limit 0.001); 5 of 100 samples".
std::string describe_leading(const Check& c) {
  return fmt::format("\n  {}: {}{}{}", c.p ? "test" : "law", c.name, measure(c), remarks(c.detail));
}

// Describes the checks that do not pass, except the leading one, which may be null.
std::string describe_others(const Report& r, const Check* leading) {
  std::string text;
  for (const Check& c : r.checks) {
    if (c.verdict == Verdict::pass || &c == leading) continue;
    text +=
        fmt::format("\n  {}: {}{}{}{}", c.verdict == Verdict::fail ? std::string_view("also fails") : name(c.verdict),
                    c.name, measure(c), c.detail.empty() ? "" : ": ", c.detail);
  }
  return text;
}

std::string fold_others(const Report& r, const Check& leading, std::string_view hint) {
  int failed = 0, inconclusive = 0;
  for (const Check& c : r.checks) {
    failed += &c != &leading && c.verdict == Verdict::fail;
    inconclusive += &c != &leading && c.verdict == Verdict::inconclusive;
  }
  std::string text;
  if (failed > 0) text = fmt::format("{} more check{}", failed, failed == 1 ? " fails" : "s fail");
  if (inconclusive > 0)
    text += fmt::format("{}{} {} inconclusive", failed > 0 ? ", " : "", inconclusive, inconclusive == 1 ? "is" : "are");
  return text.empty() ? text : fmt::format("\n  {}{}", text, hint);
}

std::string describe_cells(const Report& r, const Check& leading) {
  std::string text;
  if (!concerns_cells(leading)) return text;
  for (const WorstCell& w : r.worst)
    if (std::abs(w.z) >= least_telling) text += "\n  " + describe_worst(r.axes, w);
  return text;
}

} // namespace

const Check* Report::warning() const {
  for (const Check& c : checks)
    if (c.verdict == Verdict::warning) return &c;
  return nullptr;
}

const Check* Report::leading() const {
  if (const Check* failed = leading_failure(checks)) return failed;
  for (const Check& c : checks)
    if (c.verdict == Verdict::inconclusive) return &c;
  return nullptr;
}

Fault Report::fault() const {
  const Check* c = leading();
  return c && c->verdict == Verdict::fail ? c->fault : Fault::none;
}

bool Report::is_statistical() const {
  const Check* c = leading();
  if (c) return c->p.has_value();
  return std::any_of(checks.begin(), checks.end(), [](const Check& check) { return check.p.has_value(); });
}

std::string Report::finding() const {
  const Check* c = leading();
  if (!c) return "";
  return c->detail.empty() ? c->name : std::string(first_clause(c->detail));
}

std::string Report::untried_text() const {
  std::string text;
  for (const UntriedLaw& law : untried)
    text += fmt::format("{}{} ({})", text.empty() ? "not tried: " : ", ", law.name, law.reason);
  return text;
}

std::string Report::verdict_text() const {
  std::string text(name(verdict()));
  if (const Check* w = warning(); w && passed()) {
    if (w->fault == Fault::rounding) text += " (coarse rounding)";
    if (w->fault == Fault::measure_zero) text += " (boundary of measure zero)";
  }
  if (is_statistical()) text += fmt::format(", {} ({} samples, alpha {:.3g})", p_text(p()), samples, alpha);
  if (!passed()) return text + ": " + finding();
  if (!(detectable > 0)) return text;
  text += fmt::format("; an error of the density of {} is detected", percent(detectable));
  return detectable_cell > 0 ? text + fmt::format(" ({} in a single patch)", percent(detectable_cell)) : text;
}

std::string Report::to_string(ReportText detail, std::string_view hint) const {
  std::string text = fmt::format("{}{}{}", subject, subject.empty() ? "" : ": ", verdict_text());
  const Check* c = leading();
  if (c) {
    if (fault() != Fault::none) text += fmt::format("\n  likely cause: {}", name(fault()));
    text += describe_leading(*c);
    text += detail == ReportText::brief ? fold_others(*this, *c, hint) : describe_others(*this, c);
  } else if (warning()) {
    text += describe_others(*this, nullptr);
  }
  if (detail == ReportText::brief) return text;
  if (c) text += describe_cells(*this, *c);
  for (const ReportedValue& f : figures)
    text += fmt::format("\n  {}: {:.6g} +- {:.2g}{}", f.name, f.value, f.std_error,
                        f.where.empty() ? "" : " at " + f.where);
  if (!untried.empty()) text += "\n  " + untried_text();
  return text;
}

std::string describe_range(const std::vector<Axis>& axes, std::size_t axis, double lo, double hi) {
  const Axis own = axis < axes.size() ? axes[axis] : Axis{axis_name(axes, axis)};
  const auto [least, largest] = std::minmax({own.value(lo), own.value(hi)}); // some axes decrease
  return fmt::format("{} in [{:.12g}, {:.12g}]{}{}", own.name, least, largest, own.unit().empty() ? "" : " ",
                     own.unit());
}

std::string describe_cell(const std::vector<Axis>& axes, const PerAxis<double>& lo, const PerAxis<double>& hi) {
  std::string text;
  for (std::size_t d = 0; d < std::min(axes.size(), max_chart_dim); ++d) {
    const Axis& axis = axes[d];
    const auto [least, largest] = std::minmax({axis.value(lo[d]), axis.value(hi[d])});
    text += fmt::format("{}{} {:.5g} to {:.5g}{}{}", d > 0 ? ", " : "", axis.name, least, largest,
                        axis.unit().empty() ? "" : " ", axis.unit());
  }
  return text;
}

std::ostream& operator<<(std::ostream& out, const Report& r) { return out << r.to_string(); }

} // namespace mc
