// Determinism law: repeated calls give equal results, independent of the calls in between, and different u give
// different points.

#include <mc/check/laws/law.h>

#include <bit>

namespace mc {
namespace {

using OptionalSample = std::optional<AnyDistribution::Sample>;
using OptionalUniforms = std::optional<AnyDistribution::Uniforms>;

constexpr int tried_points = 256;

// Bitwise equality; NaN equals itself.
bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
template <std::size_t n> bool same(const std::array<double, n>& a, const std::array<double, n>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return same(x, y); });
}
bool same(const OptionalUniforms& a, const OptionalUniforms& b) {
  return a && b ? same(*a, *b) : a.has_value() == b.has_value();
}
bool same(const OptionalSample& a, const OptionalSample& b) {
  return a && b ? a->atom == b->atom && same(a->x, b->x) : a.has_value() == b.has_value();
}

std::string describe(const AnyDistribution& s, const OptionalSample& drawn) {
  if (!drawn) return "a failure";
  return drawn->atom >= 0 ? fmt::format("outcome {}", drawn->atom) : format_x(s, drawn->x);
}
std::string describe(const AnyDistribution& s, const OptionalUniforms& u) { return u ? format_u(s, *u) : "a failure"; }

// A u with its sample, and the pdf and inverse of a point.
struct Evaluation {
  AnyDistribution::Uniforms u{};
  OptionalSample drawn;
  std::optional<double> pdf;
  OptionalUniforms inverted;
};

Evaluation evaluate(const AnyDistribution& s, Pcg& random) {
  Evaluation a;
  if (s.sample) a.drawn = s.sample(a.u = rounded_uniforms(s, random));
  else a.drawn = s.sample_stream(random);
  if (!a.drawn || to_chart(s, a.drawn).draw.kind != Subject::Draw::Kind::point) return a;
  a.pdf = s.pdf(a.drawn->x);
  if (s.invert) a.inverted = s.invert(a.drawn->x);
  return a;
}

// Compares repeated calls with the first calls, after `others` samples at other u.
class RepeatedEvaluations {
 public:
  // Repeats pdf and invert before sample: a sample at the same u might restore the state of the first calls.
  void evaluate_again(const AnyDistribution& s, const Evaluation& a, int others) {
    const auto differ = [&](const std::string& question, const std::string& before, const std::string& now) {
      return fmt::format("{} is {} after {} other samples, was {} before", question, now, others, before);
    };
    if (a.pdf) {
      const double now = s.pdf(a.drawn->x);
      pdf_.note(same(*a.pdf, now) ? 0 : 1, [&] {
        return differ(fmt::format("pdf({})", format_x(s, a.drawn->x)), fmt::format("{:.17g}", *a.pdf),
                      fmt::format("{:.17g}", now));
      });
    }
    if (a.pdf && s.invert) {
      const OptionalUniforms now = s.invert(a.drawn->x);
      invert_.note(same(a.inverted, now) ? 0 : 1, [&] {
        return differ(fmt::format("invert({})", format_x(s, a.drawn->x)), describe(s, a.inverted), describe(s, now));
      });
    }
    if (!s.sample) return;
    const OptionalSample now = s.sample(a.u);
    sample_.note(same(a.drawn, now) ? 0 : 1, [&] {
      return differ(fmt::format("sample({})", format_u(s, a.u)), describe(s, a.drawn), describe(s, now));
    });
  }

  std::vector<Check> checks(const AnyDistribution& s) const {
    std::vector<Check> all;
    if (s.sample) all.push_back(sample_.check());
    if (s.domain.dim > 0) all.push_back(pdf_.check());
    if (s.domain.dim > 0 && s.invert) all.push_back(invert_.check());
    return all;
  }

 private:
  WorstError sample_{"determinism of sample", 0, Fault::nondeterministic},
      pdf_{"determinism of pdf", 0, Fault::nondeterministic},
      invert_{"determinism of invert", 0, Fault::nondeterministic};
};

// Counts different u with equal points.
class ConstantOutput {
 public:
  void note(const AnyDistribution& s, const Evaluation& a, const Evaluation& b) {
    if (!a.drawn || a.drawn->atom >= 0 || !same(a.drawn, b.drawn)) return;
    alike_ += same(before_, a.drawn);
    before_ = a.drawn;
    if (pairs_++ == 0)
      witness_ = fmt::format("sample is {} for both u = {} and u = {}, should differ", describe(s, a.drawn),
                             format_u(s, a.u), format_u(s, b.u));
  }

  Check check() const {
    // A constant point is a function of u; a point that repeats for a while is not.
    const Fault fault = 2 * alike_ > pairs_ ? Fault::atom : Fault::nondeterministic;
    Check moves{"sample depends on u", Verdict::pass, {}, 0, double(pairs_), tried_points / 2.0, fault, {}};
    if (pairs_ <= tried_points / 2) return moves;
    moves.verdict = Verdict::fail;
    moves.detail = fmt::format("{}; {} of {} pairs of u give one point", witness_, pairs_, tried_points);
    return moves;
  }

 private:
  int pairs_ = 0, alike_ = 0; // pairs of u with equal points; pairs with the point of the previous such pair
  OptionalSample before_;
  std::string witness_;
};

} // namespace

Findings determinism_law(const AnyDistribution& s, const LawOptions& options) {
  RepeatedEvaluations repeated;
  ConstantOutput constant;
  Pcg random(options.statistics.seed, 15);
  for (int k = 0; k < tried_points; ++k) {
    const Evaluation first = evaluate(s, random);
    Evaluation last = first;
    // Zero to three other samples detect results that alternate, or that change after a few calls.
    for (int others = k % 4; others > 0; --others) last = evaluate(s, random);
    repeated.evaluate_again(s, first, k % 4);
    constant.note(s, first, k % 4 > 0 ? last : evaluate(s, random));
  }
  std::vector<Check> checks = repeated.checks(s);
  if (s.sample && s.domain.dim > 0) checks.push_back(constant.check());
  return {checks};
}

} // namespace mc
