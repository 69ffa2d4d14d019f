// Batch consistency law: a batch gives the results of single calls.

#include <mc/check/laws/law.h>

#include <limits>

namespace mc {
namespace {

using OptionalSample = std::optional<AnyDistribution::Sample>;

constexpr std::size_t batch = 257; // not a multiple of any vector width

// Bound on differences by rounding: a plugin may compute in float, and vector code rounds differently from scalar code.
constexpr double rounding = 1024 * static_cast<double>(std::numeric_limits<float>::epsilon());

// Returns the difference of b from a, relative to the larger of the two or to `least`. NaN equals NaN.
double off(double a, double b, double least) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double relative = std::abs(a - b) / std::max({std::abs(a), std::abs(b), least});
  return std::isnan(relative) ? HUGE_VAL : relative;
}

double off(const OptionalSample& a, const OptionalSample& b) {
  if (!a || !b) return a.has_value() == b.has_value() ? 0 : HUGE_VAL;
  double worst = 0;
  for (std::size_t i = 0; i < a->x.size(); ++i) worst = std::max(worst, off(a->x[i], b->x[i], 1));
  return worst;
}

std::string describe_result(const AnyDistribution& s, const OptionalSample& drawn) {
  return drawn ? format_x(s, drawn->x) : "a failure";
}

} // namespace

Findings batch_consistency_law(const AnyDistribution& s, const LawOptions& options) {
  const bool is_stream = static_cast<bool>(s.sample_stream_many);
  if (!is_stream && !(s.sample && s.sample_many)) return {};
  WorstError samples("batch consistency of sample", rounding, Fault::nondeterministic);
  WorstError densities("batch consistency of pdf", rounding, Fault::nondeterministic);
  const std::uint64_t stream = hash(options.statistics.seed, 16);
  Pcg random = is_stream ? Pcg(stream) : Pcg(options.statistics.seed, 16);
  std::vector<AnyDistribution::Uniforms> u(is_stream ? 0 : batch);
  for (AnyDistribution::Uniforms& one : u) one = rounded_uniforms(s, random);
  const std::vector<OptionalSample> drawn = is_stream ? s.sample_stream_many(stream, batch) : s.sample_many(u);
  std::vector<PointArray> x;
  for (std::size_t i = 0; i < batch; ++i) {
    const OptionalSample alone = is_stream ? s.sample_stream(random) : s.sample(u[i]);
    samples.note(off(drawn[i], alone), [&] {
      return fmt::format("sample is {} at position {} of a batch of {}, should be {} as for a single call{}",
                         describe_result(s, drawn[i]), i + 1, batch, describe_result(s, alone),
                         is_stream ? "" : ", at u = " + format_u(s, u[i]));
    });
    if (to_chart(s, alone).draw.kind == Subject::Draw::Kind::point) x.push_back(alone->x);
  }
  if (!s.pdf_many || x.empty()) return {{samples.check()}};
  const std::vector<double> pdf = s.pdf_many(x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double alone = s.pdf(x[i]);
    densities.note(off(pdf[i], alone, 0), [&] {
      return fmt::format(
          "pdf is {:.17g} at position {} of a batch of {}, should be {:.17g} as for a single call, at x = {}", pdf[i],
          i + 1, x.size(), alone, format_x(s, x[i]));
    });
  }
  return {{samples.check(), densities.check()}};
}

} // namespace mc
