// Precision law: sample and pdf against the 50-digit oracle.

#include <mc/check/laws/law.h>

namespace mc {
namespace {

double size_of(const OracleDistribution::Point& x) {
  return static_cast<double>(sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]));
}

// Returns the error in epsilons, relative to the larger of 1 and the exact sample.
double off_by(const AnyDistribution& s, const OracleDistribution::Point& x, const OracleDistribution::Point& exact) {
  return size_of({x[0] - exact[0], x[1] - exact[1], x[2] - exact[2]}) / std::max(1.0, size_of(exact)) / s.epsilon();
}

std::string format_exact(const AnyDistribution& s, const OracleDistribution::Point& x) {
  PointArray rounded;
  std::transform(x.begin(), x.end(), rounded.begin(), [](const Oracle& exact) { return static_cast<double>(exact); });
  return format_x(s, rounded);
}

// Returns the change of the exact sample by rounding of u, which occurs in maps that remap u: mixtures, products.
double off_by_rounding(const AnyDistribution& s, const AnyDistribution::Uniforms& u,
                       const OracleDistribution::Point& exact) {
  constexpr double steps = 4;
  double off = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.uniforms); ++i) {
    OracleDistribution::Point rounded;
    std::copy(u.begin(), u.end(), rounded.begin());
    rounded[i] *= 1 - s.epsilon();
    if (const auto x = s.oracle->sample(rounded)) off += steps * off_by(s, *x, exact);
  }
  return off;
}

} // namespace

Findings precision_law(const AnyDistribution& s, const LawOptions& options) {
  if (!s.sample || !s.oracle) return {};
  WorstError sample("sample against 50 digits [eps]", options.sample_eps, Fault::precision);
  WorstError pdf("pdf against 50 digits [eps]", options.pdf_eps, Fault::precision);
  Pcg random(options.statistics.seed, 13);
  for (std::uint64_t k = 0; k < options.points; ++k) {
    const AnyDistribution::Uniforms u = rounded_uniforms(s, random);
    const auto drawn = s.sample(u);
    const auto exact = s.oracle->sample({u[0], u[1], u[2]});
    // Rounding decides cases in which only one of the two fails; the test of the mass covers the rate of failures.
    if (!drawn || !exact) continue;
    const OracleDistribution::Point x{drawn->x[0], drawn->x[1], drawn->x[2]};
    double off = off_by(s, x, *exact);
    if (off > options.sample_eps) off = std::max(off - off_by_rounding(s, u, *exact), 0.0);
    sample.note(off, [&] {
      return fmt::format("sample is {}, should be {}, at u = {}", format_x(s, drawn->x), format_exact(s, *exact),
                         format_u(s, u));
    });
    const Oracle density = s.oracle->pdf(x);
    // Rounding may move x across the edge of the support, where the densities of both sides are correct.
    if (!(density > 0)) continue;
    const double claimed = s.pdf(drawn->x);
    const double wrong = std::abs(static_cast<double>(claimed / density) - 1) / s.epsilon();
    pdf.note(wrong, [&] {
      return fmt::format("pdf is {:.17g}, should be {:.17g}, at x = {}", claimed, static_cast<double>(density),
                         describe_x(s, drawn->x));
    });
  }
  return {{sample.check(), pdf.check()}};
}

} // namespace mc
