// Many questions at once get the answers of each alone.

#include <mc/check/laws/law.h>

#include <limits>

namespace mc {
namespace {

using Drawn = std::optional<AnySampler::Drawn>;

constexpr std::size_t points = 257; // no whole number of the vectors that a program may compute in

// A program may compute in float, and vectors round otherwise than single numbers: but not by as much as this.
constexpr double rounding = 1024 * static_cast<double>(std::numeric_limits<float>::epsilon());

// How far b is off a, relative to the larger, or to `least` where both are smaller. NaN is as good as NaN.
double off(double a, double b, double least) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double relative = std::abs(a - b) / std::max({std::abs(a), std::abs(b), least});
  return std::isnan(relative) ? HUGE_VAL : relative;
}

double off(const Drawn& a, const Drawn& b) {
  if (!a || !b) return a.has_value() == b.has_value() ? 0 : HUGE_VAL;
  double worst = 0;
  for (std::size_t i = 0; i < a->x.size(); ++i) worst = std::max(worst, off(a->x[i], b->x[i], 1));
  return worst;
}

std::string describe(const AnySampler& s, const Drawn& drawn) { return drawn ? format_x(s, drawn->x) : "a failure"; }

} // namespace

std::vector<Check> batches_law(const AnySampler& s, const LawOptions& options) {
  if (!s.sample || !s.sample_many) return {};
  WorstError samples("batch consistency of sample", rounding, Fault::impure);
  WorstError densities("batch consistency of pdf", rounding, Fault::impure);
  Pcg random(options.seed, 16);
  std::vector<AnySampler::Uniforms> u(points);
  for (AnySampler::Uniforms& one : u) one = law_point(s, random);
  const std::vector<Drawn> drawn = s.sample_many(u);
  std::vector<Numbers> x;
  for (std::size_t i = 0; i < points; ++i) {
    const Drawn alone = s.sample(u[i]);
    samples.note(off(drawn[i], alone), [&] {
      return fmt::format("sample is {} at position {} of a batch of {}, should be {} as for a single call, at u = {}",
                         describe(s, drawn[i]), i + 1, points, describe(s, alone), format_u(s, u[i]));
    });
    if (place(s, alone).draw.kind == Subject::Draw::Kind::point) x.push_back(alone->x);
  }
  if (!s.pdf_many || x.empty()) return {samples.check()};
  const std::vector<double> pdf = s.pdf_many(x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double alone = s.pdf(x[i]);
    densities.note(off(pdf[i], alone, 0), [&] {
      return fmt::format(
          "pdf is {:.17g} at position {} of a batch of {}, should be {:.17g} as for a single call, at x = {}", pdf[i],
          i + 1, x.size(), alone, format_x(s, x[i]));
    });
  }
  return {samples.check(), densities.check()};
}

} // namespace mc
