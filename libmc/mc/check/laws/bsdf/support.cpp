// Support law: pdf > 0 wherever f > 0; otherwise an estimator loses light.

#include <mc/check/laws/bsdf/bsdf_law.h>

namespace mc {

Findings bsdf_support_law(const BsdfView& view) {
  WorstError support("pdf > 0 where f > 0", 0, Fault::support);
  for (const DirectionPair& pair : view.pairs) {
    const Channels& f = pair.f;
    const bool bright = std::any_of(f.value.begin(), f.value.begin() + f.count, [](double x) { return x > 0; });
    support.note(bright && !(pair.pdf > 0) ? 1 : 0, [&] {
      return fmt::format("pdf is {:.9g}, should be > 0 since f(wo, wi) is {}, at {}", pair.pdf, view.bsdf.format(f),
                         describe(view, pair));
    });
  }
  return {{support.check()}};
}

} // namespace mc
