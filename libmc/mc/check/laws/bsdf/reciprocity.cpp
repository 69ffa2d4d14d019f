// Reciprocity law: f(wo, wi) = f(wi, wo), with the squared ratio of the indices across the surface.

#include <mc/check/laws/bsdf/bsdf_law.h>

namespace mc {

namespace {

// Whether f / |cos| is reciprocal although f is not; eval then seems to include the cosine.
bool includes_cosine(const BsdfView& view, const DirectionPair& pair, double scale) {
  const double cos_i = std::abs(pair.wi.z()), cos_o = std::abs(view.wo.z());
  return relative_difference(scaled(pair.f, scale * cos_o), scaled(pair.f_reverse, cos_i)) <= view.options.tolerance;
}

std::string describe_pair(const BsdfView& view, const DirectionPair& pair, double scale) {
  std::string text = fmt::format("f(wi, wo) is {}, should be {} as f(wo, wi){}, at {}",
                                 view.bsdf.format(pair.f_reverse), view.bsdf.format(scaled(pair.f, scale)),
                                 scale == 1 ? "" : " times the squared ratio of the indices", describe(view, pair));
  if (includes_cosine(view, pair, scale))
    text += "; f / |cos wi| is reciprocal, so eval seems to include the cosine: set .cosine = false and .reciprocal = "
            "false, or divide by |cos wi|";
  return text;
}

} // namespace

BsdfFindings bsdf_reciprocity_law(const BsdfView& view) {
  if (!view.options.reciprocal) return {};
  WorstError reciprocity("reciprocity", view.options.tolerance, Fault::physics);
  for (const DirectionPair& pair : view.pairs) {
    if (!pair.has_reverse) continue;
    const double scale =
        pair.transmitted ? squared_index(pair.wi, view.options) / squared_index(view.wo, view.options) : 1.0;
    reciprocity.note(relative_difference(scaled(pair.f, scale), pair.f_reverse),
                     [&] { return describe_pair(view, pair, scale); });
  }
  return {{reciprocity.check()}, {}};
}

} // namespace mc
