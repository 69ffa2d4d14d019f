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
  }
  return "";
}

std::string_view name(Fault f) {
  switch (f) {
  case Fault::none: return "none";
  case Fault::edge: return "edge: u at the ends of the unit cube or beside a branch break it";
  case Fault::zero_edge: return "measure zero: only single u or points break it, the density is not in doubt";
  case Fault::impure: return "impure: the same question gets other answers";
  case Fault::not_finite: return "not finite";
  case Fault::negative: return "negative: the density is below zero";
  case Fault::outside: return "outside: points that are not in the domain";
  case Fault::failure: return "failure: sample fails more or less often than the mass of its density allows";
  case Fault::leak: return "leak: samples where the density is zero";
  case Fault::mass: return "mass: the density does not integrate to one";
  case Fault::weight: return "weight: the stated weight disagrees with eval and pdf";
  case Fault::support: return "support: the integrand is positive where the density is zero";
  case Fault::inverse: return "inverse: invert does not undo sample";
  case Fault::jacobian: return "jacobian: pdf is not the density of sample";
  case Fault::precision: return "precision: rounding error beyond the stated bound";
  case Fault::atom: return "atom: many samples share one value of a coordinate";
  case Fault::rotation: return "rotation: the samples follow the density turned about its pole";
  case Fault::shape: return "shape: the samples follow another density";
  case Fault::local: return "local: too many or too few samples in single cells";
  case Fault::physics: return "physics: reciprocity, energy or sign";
  case Fault::bias: return "bias: the mean of the estimates is another";
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
// That of the first failed check of a kind.
template <class OfKind> Fault first_fault(const std::vector<Check>& checks, OfKind of_kind) {
  for (const Check& c : checks)
    if (c.verdict == Verdict::fail && of_kind(c)) return c.fault;
  return Fault::none;
}

// "cell theta 1.5 to 3 deg", or nothing for an outcome, which its `where` names.
std::string describe_worst(const std::vector<Axis>& axes, const WorstCell& w) {
  if (w.lo == w.hi) return "";
  const std::string place = describe_cell(axes, w.lo, w.hi);
  return place.empty() ? "cell" : "cell " + place;
}
} // namespace

Fault Report::fault() const {
  const auto measure_zero = [](const Check& c) { return c.fault == Fault::zero_edge; };
  const Fault certain = first_fault(checks, [&](const Check& c) { return !c.p && !measure_zero(c); });
  const Fault beyond_doubt = first_fault(checks, [](const Check& c) { return c.p && *c.p < 1e-9; });
  // Of energy, which is weighed by the density: where that is wrong, so is the furnace.
  if ((certain == Fault::edge || certain == Fault::physics) && beyond_doubt != Fault::none) return beyond_doubt;
  if (certain != Fault::none) return certain;
  const Fault likely = first_fault(checks, [](const Check& c) { return c.p.has_value(); });
  return likely != Fault::none ? likely : first_fault(checks, measure_zero);
}

std::string Report::to_string() const {
  std::string text =
      fmt::format("{}: {}, p = {:.3g} of {} samples at alpha = {:g}", subject, name(verdict()), p(), samples, alpha);
  if (fault() != Fault::none) text += fmt::format("\n  likely fault: {}", name(fault()));
  for (const Check& c : checks) {
    if (c.verdict == Verdict::pass) continue;
    text += fmt::format("\n  {} {}: ", c.name, name(c.verdict));
    text += c.p ? fmt::format("statistic {:.6g}, p = {:.3g}", c.statistic, *c.p)
                : fmt::format("{:.6g}, limit {:.6g}", c.statistic, c.limit);
    if (!c.detail.empty()) text += fmt::format("; {}", c.detail);
  }
  for (const Figure& f : figures)
    text += fmt::format("\n  {}: {:.6g} +- {:.2g}{}", f.name, f.value, f.std_error,
                        f.where.empty() ? "" : " at " + f.where);
  // Of other faults, and of gaps and strips thinner than a cell, the counts of cells say nothing.
  constexpr double least_telling = 4; // more than chance makes of the worst of some thousand cells
  const std::array<Fault, 3> of_shape{Fault::shape, Fault::local, Fault::rotation};
  if (std::find(of_shape.begin(), of_shape.end(), fault()) == of_shape.end()) return text;
  for (const WorstCell& w : worst) {
    if (!(std::abs(w.z) >= least_telling)) continue;
    const std::string cell = describe_worst(axes, w);
    text += fmt::format("\n  {}{}{}: observed {:.0f}, expected {:.1f}, z = {:.1f}", cell,
                        cell.empty() || w.where.empty() ? "" : " at ", w.where, w.observed, w.expected, w.z);
  }
  return text;
}

std::string describe_range(const std::vector<Axis>& axes, std::size_t axis, double lo, double hi) {
  const Axis own = axis < axes.size() ? axes[axis] : Axis{axis_name(axes, axis)};
  const auto [least, largest] = std::minmax({own.value(lo), own.value(hi)}); // some axes fall
  return fmt::format("{} in [{:.12g}, {:.12g}]{}{}", own.name, least, largest, own.unit().empty() ? "" : " ",
                     own.unit());
}

std::string describe_cell(const std::vector<Axis>& axes, const std::array<double, 3>& lo,
                          const std::array<double, 3>& hi) {
  std::string text;
  for (std::size_t d = 0; d < std::min<std::size_t>(axes.size(), 3); ++d) {
    const Axis& axis = axes[d];
    const auto [least, largest] = std::minmax({axis.value(lo[d]), axis.value(hi[d])});
    text += fmt::format("{}{} {:.5g} to {:.5g}{}{}", d > 0 ? ", " : "", axis.name, least, largest,
                        axis.unit().empty() ? "" : " ", axis.unit());
  }
  return text;
}

std::ostream& operator<<(std::ostream& out, const Report& r) { return out << r.to_string(); }

} // namespace mc
