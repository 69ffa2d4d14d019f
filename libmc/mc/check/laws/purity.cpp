// The same u gives the same point, other u other points.

#include <mc/check/laws/law.h>

#include <bit>

namespace mc {
namespace {

using Bits = std::array<std::uint64_t, std::tuple_size_v<Numbers>>;

// The same bits; NaN equals itself.
bool same(const std::optional<AnySampler::Drawn>& a, const std::optional<AnySampler::Drawn>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->atom == b->atom && std::bit_cast<Bits>(a->x) == std::bit_cast<Bits>(b->x);
}

std::string describe(const AnySampler& s, const std::optional<AnySampler::Drawn>& drawn) {
  if (!drawn) return "a failure";
  return drawn->atom >= 0 ? fmt::format("outcome {}", drawn->atom) : format_x(s, drawn->x);
}

} // namespace

std::vector<Check> purity_law(const AnySampler& s, const LawOptions& options) {
  if (!s.sample) return {};
  WorstError repeated("same u, same point", 0, Fault::impure);
  Pcg random(options.seed, 15);
  constexpr int points = 256;
  int stuck = 0, alike = 0; // u whose point is that of the u before; that of the pair before
  std::optional<AnySampler::Drawn> before;
  std::string witness;
  for (int k = 0; k < points; ++k) {
    const AnySampler::Uniforms u = law_point(s, random), other = law_point(s, random);
    const auto first = s.sample(u), between = s.sample(other), again = s.sample(u);
    repeated.note(same(first, again) ? 0 : 1, [&] {
      return fmt::format("sample({}) = {}, and {} after a sample at {}", format_u(s, u), describe(s, first),
                         describe(s, again), format_u(s, other));
    });
    if (!first || first->atom >= 0 || !same(first, between)) continue;
    alike += same(before, first);
    before = first;
    if (stuck++ == 0)
      witness = fmt::format("sample({}) = sample({}) = {}", format_u(s, u), format_u(s, other), describe(s, first));
  }
  if (s.domain.dim == 0) return {repeated.check()};
  // A point that is always the same is a function of u; one that is stuck for a while is not.
  const Fault fault = 2 * alike > stuck ? Fault::atom : Fault::impure;
  Check moves{"another u, another point", Verdict::pass, {}, 0, double(stuck), points / 2.0, fault, {}};
  if (stuck > points / 2) {
    moves.verdict = Verdict::fail;
    moves.detail = fmt::format("{}; so at {} of {} pairs", witness, stuck, points);
  }
  return {repeated.check(), moves};
}

} // namespace mc
