// f(wo, wi) = f(wi, wo), with the squared index across the surface.

#include <mc/check/laws/bsdf/bsdf_law.h>

namespace mc {

BsdfFindings bsdf_reciprocity_law(const BsdfView& view) {
  if (!view.options.reciprocal) return {};
  WorstError reciprocity("reciprocity", view.options.tolerance, Fault::physics);
  for (const DirectionPair& pair : view.pairs) {
    if (!pair.both_ways) continue;
    const double scale =
        pair.across ? squared_index(pair.wi, view.options) / squared_index(view.wo, view.options) : 1.0;
    reciprocity.note(disagreement(scaled(pair.there, scale), pair.back), [&] { return describe(view, pair); });
  }
  return {{reciprocity.check()}, {}};
}

} // namespace mc
