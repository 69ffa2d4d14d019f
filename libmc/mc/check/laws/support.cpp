// Support law: eval >= 0, and pdf > 0 wherever eval > 0.

#include <mc/check/laws/law.h>

namespace mc {

Findings support_law(const AnyDistribution& s, const LawOptions& options) {
  if (!s.eval || s.domain.dim == 0) return {};
  WorstError sign("eval finite and >= 0", 0, Fault::physics), support("pdf > 0 where eval > 0", 0, Fault::support);
  Pcg random(options.statistics.seed, 31);
  for (int k = 0; k < 20000; ++k) {
    AnyDomain::Coordinates v{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.domain.dim); ++i)
      v[i] = s.is_float ? static_cast<double>(random.uniform<float>()) : random.uniform<double>();
    const PointArray x = s.domain.from_unit(v).x;
    if (!std::all_of(x.begin(), x.end(), [](double one) { return std::isfinite(one); })) continue;
    const double f = s.eval(x), density = s.pdf(x);
    sign.note(f >= 0 && std::isfinite(f) ? 0 : 1,
              [&] { return fmt::format("eval is {:.9g}, should be finite and >= 0, at x = {}", f, describe_x(s, x)); });
    support.note(f > 0 && !(density > 0) ? 1 : 0, [&] {
      return fmt::format("pdf is {:.9g}, should be > 0 since eval is {:.9g}, at x = {}", density, f, describe_x(s, x));
    });
  }
  return {{sign.check(), support.check()}};
}

} // namespace mc
