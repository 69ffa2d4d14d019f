// Sign law: f is finite and >= 0.

#include <mc/check/laws/bsdf/bsdf_law.h>

namespace mc {

Findings bsdf_sign_law(const BsdfView& view) {
  WorstError sign("f finite and >= 0", 0, Fault::physics);
  for (const DirectionPair& pair : view.pairs) {
    const Channels& f = pair.f;
    const bool sound =
        std::all_of(f.value.begin(), f.value.begin() + f.count, [](double x) { return x >= 0 && std::isfinite(x); });
    sign.note(sound ? 0 : 1, [&] {
      return fmt::format("f(wo, wi) is {}, should be finite and >= 0, at {}", view.bsdf.format(f),
                         describe(view, pair));
    });
  }
  return {{sign.check()}};
}

} // namespace mc
