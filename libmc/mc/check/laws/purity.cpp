// The same question gets the same answer, whatever was asked between; other u give other points.

#include <mc/check/laws/law.h>

#include <bit>

namespace mc {
namespace {

using Drawn = std::optional<AnySampler::Drawn>;
using Inverted = std::optional<AnySampler::Uniforms>;

constexpr int points = 256;

// The same bits; NaN equals itself.
bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
template <std::size_t n> bool same(const std::array<double, n>& a, const std::array<double, n>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return same(x, y); });
}
bool same(const Inverted& a, const Inverted& b) { return a && b ? same(*a, *b) : a.has_value() == b.has_value(); }
bool same(const Drawn& a, const Drawn& b) {
  return a && b ? a->atom == b->atom && same(a->x, b->x) : a.has_value() == b.has_value();
}

std::string describe(const AnySampler& s, const Drawn& drawn) {
  if (!drawn) return "a failure";
  return drawn->atom >= 0 ? fmt::format("outcome {}", drawn->atom) : format_x(s, drawn->x);
}
std::string describe(const AnySampler& s, const Inverted& u) { return u ? format_u(s, *u) : "a failure"; }

// A u with what is said of it: its sample, and of a point what pdf and invert say.
struct Asked {
  AnySampler::Uniforms u{};
  Drawn drawn;
  std::optional<double> pdf;
  Inverted inverted;
};

Asked ask(const AnySampler& s, Pcg& random) {
  Asked a;
  if (s.sample) a.drawn = s.sample(a.u = law_point(s, random));
  else a.drawn = s.sample_stream(random);
  if (!a.drawn || place(s, a.drawn).draw.kind != Subject::Draw::Kind::point) return a;
  a.pdf = s.pdf(a.drawn->x);
  if (s.invert) a.inverted = s.invert(a.drawn->x);
  return a;
}

// What the same questions say once more, after `others` samples at other u.
class Repeated {
 public:
  // First what depends on no sample: a sample at the same u might bring back what it was asked with.
  void ask_again(const AnySampler& s, const Asked& a, int others) {
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
      const Inverted now = s.invert(a.drawn->x);
      invert_.note(same(a.inverted, now) ? 0 : 1, [&] {
        return differ(fmt::format("invert({})", format_x(s, a.drawn->x)), describe(s, a.inverted), describe(s, now));
      });
    }
    if (!s.sample) return;
    const Drawn now = s.sample(a.u);
    sample_.note(same(a.drawn, now) ? 0 : 1, [&] {
      return differ(fmt::format("sample({})", format_u(s, a.u)), describe(s, a.drawn), describe(s, now));
    });
  }

  std::vector<Check> checks(const AnySampler& s) const {
    std::vector<Check> all;
    if (s.sample) all.push_back(sample_.check());
    if (s.domain.dim > 0) all.push_back(pdf_.check());
    if (s.domain.dim > 0 && s.invert) all.push_back(invert_.check());
    return all;
  }

 private:
  WorstError sample_{"determinism of sample", 0, Fault::impure}, pdf_{"determinism of pdf", 0, Fault::impure},
      invert_{"determinism of invert", 0, Fault::impure};
};

// Points that stay where they are though u moves.
class Stuck {
 public:
  void note(const AnySampler& s, const Asked& a, const Asked& b) {
    if (!a.drawn || a.drawn->atom >= 0 || !same(a.drawn, b.drawn)) return;
    alike_ += same(before_, a.drawn);
    before_ = a.drawn;
    if (pairs_++ == 0)
      witness_ = fmt::format("sample is {} for both u = {} and u = {}, should differ", describe(s, a.drawn),
                             format_u(s, a.u), format_u(s, b.u));
  }

  Check check() const {
    // A point that is always the same is a function of u; one that is stuck for a while is not.
    const Fault fault = 2 * alike_ > pairs_ ? Fault::atom : Fault::impure;
    Check moves{"sample depends on u", Verdict::pass, {}, 0, double(pairs_), points / 2.0, fault, {}};
    if (pairs_ <= points / 2) return moves;
    moves.verdict = Verdict::fail;
    moves.detail = fmt::format("{}; {} of {} pairs of u give one point", witness_, pairs_, points);
    return moves;
  }

 private:
  int pairs_ = 0, alike_ = 0; // pairs of one point; those whose point is that of such a pair before
  Drawn before_;
  std::string witness_;
};

} // namespace

std::vector<Check> purity_law(const AnySampler& s, const LawOptions& options) {
  Repeated repeated;
  Stuck stuck;
  Pcg random(options.seed, 15);
  for (int k = 0; k < points; ++k) {
    const Asked first = ask(s, random);
    Asked last = first;
    // None to three: what alternates, or changes after so many calls, is met at another turn.
    for (int others = k % 4; others > 0; --others) last = ask(s, random);
    repeated.ask_again(s, first, k % 4);
    stuck.note(s, first, k % 4 > 0 ? last : ask(s, random));
  }
  std::vector<Check> checks = repeated.checks(s);
  if (s.sample && s.domain.dim > 0) checks.push_back(stuck.check());
  return checks;
}

} // namespace mc
