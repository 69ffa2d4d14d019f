// Inverse law: invert(sample(u)) = u.

#include <mc/check/laws/law.h>

#include <numeric>

namespace mc {
namespace {

double size_of(const PointArray& x) { return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0)); }

// Whether sample(back) equals x up to rounding, as on the two sides of the seam of an azimuth.
bool same_point(const AnyDistribution& s, const AnyDistribution::Uniforms& back, const PointArray& x) {
  const auto again = s.sample(back);
  if (!again) return false;
  PointArray apart;
  for (std::size_t i = 0; i < apart.size(); ++i) apart[i] = again->x[i] - x[i];
  return size_of(apart) <= 64 * s.epsilon() * std::max(1.0, size_of(x));
}

} // namespace

Findings inverse_law(const AnyDistribution& s, const LawOptions& options) {
  if (!s.sample || !s.invert) return {};
  WorstError error("invert(sample(u)) = u [eps]", options.invert_eps, Fault::inverse);
  Pcg random(options.statistics.seed, 11);
  for (int k = 0; k < 20000; ++k) {
    const AnyDistribution::Uniforms u = rounded_uniforms(s, random);
    const auto drawn = s.sample(u);
    if (!drawn || drawn->atom >= 0) continue;
    const auto back = s.invert(drawn->x);
    double worst = back ? 0 : HUGE_VAL;
    for (std::size_t i = 0; back && i < static_cast<std::size_t>(s.uniforms); ++i) {
      double off = std::abs((*back)[i] - u[i]);
      if (off > 0.5 && off <= 1 && same_point(s, *back, drawn->x)) off = 1 - off;
      worst = off <= worst ? worst : off;
    }
    error.note(worst / s.epsilon(), [&] {
      return fmt::format("invert(sample(u)) {}, should be u = {}", back ? "is " + format_u(s, *back) : "fails",
                         format_u(s, u));
    });
  }
  return {{error.check()}};
}

} // namespace mc
