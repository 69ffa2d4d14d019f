#include <mc/check/subject/generator.h>
#include <mc/check/subject/outcomes.h>

#include <mc/random/hash.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace mc::detail {
namespace {

using Kind = Subject::Draw::Kind;

constexpr std::uint64_t pilot_seed = 0x9e3779b97f4a7c15;

// Returns a chart of the range of the results. Quartiles of pilot samples place the charts of infinite ranges.
AnyDomain chart_of(const AnyGenerator& g) {
  const bool has_lo = std::isfinite(g.lo), has_hi = std::isfinite(g.hi);
  if (has_lo && has_hi) return domain_of(Interval<double>(g.lo, g.hi));
  std::vector<double> x = g.draw(pilot_seed, 1024);
  std::erase_if(x, [](double one) { return !std::isfinite(one); });
  if (x.size() < 16) x = {-1, 0, 0, 1};
  std::sort(x.begin(), x.end());
  const double first = x[x.size() / 4], median = x[x.size() / 2], third = x[3 * x.size() / 4];
  if (has_lo) return domain_of(HalfLine<double>(g.lo, std::max(median - g.lo, 1e-300)));
  if (has_hi) return domain_of(HalfLine<double>(g.hi, -std::max(g.hi - median, 1e-300)));
  return domain_of(RealLine<double>(median, std::max(third - first, 1e-300)));
}

// Sets draw and describe_draw: `to_draw` converts a finite number.
void set_draws(const AnyGenerator& g, std::function<Subject::Draw(double x)> to_draw, Subject& s) {
  s.draw = [draw = g.draw, to_draw = std::move(to_draw)](std::uint64_t seed, std::size_t n,
                                                         std::vector<Subject::Draw>& out) {
    for (const double x : draw(seed, n)) {
      if (std::isfinite(x)) out.push_back(to_draw(x));
      else out.emplace_back().kind = Kind::not_finite;
    }
  };
  s.describe_draw = [draw = g.draw](std::uint64_t seed, std::uint64_t index) {
    return fmt::format("x = {:.17g}, number {} of RandomEngine({})", draw(seed, index + 1).back(), index, seed);
  };
}

} // namespace

Subject subject_of_pdf(const AnyGenerator& g, const std::function<double(double)>& pdf) {
  AnyDistribution d;
  d.name = g.name;
  d.is_float = g.is_float;
  d.domain = chart_of(g);
  d.pdf = [pdf](const PointArray& x) { return pdf(x[0]); };
  Subject s = make_subject(d);
  const auto to_draw = [pdf, chart = d.domain, lo = g.lo, hi = g.hi](double x) {
    Subject::Draw drawn;
    if (!(x >= lo && x <= hi)) {
      drawn.kind = Kind::outside;
      return drawn;
    }
    drawn.v = chart.to_unit({x});
    const double density = pdf(x);
    drawn.pdf_positive = density > 0 && std::isfinite(density);
    drawn.density = density * chart.jacobian(drawn.v);
    return drawn;
  };
  set_draws(g, to_draw, s);
  return s;
}

Subject subject_of_pmf(const AnyGenerator& g, const std::function<double(double)>& pmf) {
  constexpr double most_without_pilot = 1 << 20;
  Outcomes outcomes(g.lo, g.hi);
  if (!(g.hi - g.lo < most_without_pilot)) outcomes.list(g.draw(pilot_seed, 1 << 16));
  Subject s;
  s.name = g.name;
  for (std::size_t i = 0; outcomes.first + static_cast<double>(i) <= outcomes.last; ++i)
    s.atoms.push_back(pmf(outcomes.first + static_cast<double>(i)));
  outcomes.add_rest(s.atoms);
  const auto to_draw = [outcomes](double k) {
    Subject::Draw drawn;
    drawn.kind = Kind::atom;
    drawn.atom = outcomes.index(k);
    return drawn;
  };
  set_draws(g, to_draw, s);
  return s;
}

Subject subject_of_cdf(const AnyGenerator& g, std::function<double(double)> cdf) {
  Subject s;
  s.name = g.name;
  s.dim = 1;
  s.axes = {{"cdf(x)", Axis::Scale::linear, 0, 1}};
  s.epsilon = g.is_float ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon();
  s.density = [](const Subject::Coordinates&) { return 1.0; };
  const auto to_draw = [cdf = std::move(cdf)](double x) {
    Subject::Draw drawn;
    const double u = cdf(x);
    drawn.v = {u, 0, 0};
    drawn.density = 1;
    if (!std::isfinite(u)) drawn.kind = Kind::not_finite;
    else if (!(u >= 0 && u <= 1)) drawn.kind = Kind::outside;
    return drawn;
  };
  set_draws(g, to_draw, s);
  return s;
}

} // namespace mc::detail
