// Reciprocity law: f(wo, wi) = f(wi, wo), with the squared ratio of the indices across the surface.

#include <mc/check/laws/bsdf/bsdf_law.h>
#include <mc/core/types.h>

#include <algorithm>
#include <limits>

namespace mc {

namespace {

// Reciprocity of one quantity: of eval itself, or of eval / |cos|.
struct Quantity {
  bool divided = false; ///< divides by the cosine of the second direction
  double factor(double cosine) const { return divided ? std::abs(cosine) : 1.0; }
  std::string name(const char* arguments, const char* direction) const {
    return divided ? fmt::format("f({}) / |cos {}|", arguments, direction) : fmt::format("f({})", arguments);
  }
};

double squared_ratio(const BsdfView& view, const DirectionPair& pair) {
  return pair.transmitted ? squared_index(pair.wi, view.options) / squared_index(view.wo, view.options) : 1.0;
}

// Whether no channel reaches the smallest normal number of the BSDF's scalar. Such values have no relative precision.
bool underflows(const BsdfView& view, const Channels& f) {
  const double least = view.bsdf.is_float ? std::numeric_limits<float>::min() : std::numeric_limits<double>::min();
  return std::all_of(f.value.begin(), f.value.begin() + f.count, [&](double x) { return std::abs(x) < least; });
}

// Multiplies each side by the cosine of the other: wo may lie in the horizon.
double error(const BsdfView& view, const DirectionPair& pair, const Quantity& q) {
  if (underflows(view, pair.f) && underflows(view, pair.f_reverse)) return 0;
  return relative_difference(scaled(pair.f, squared_ratio(view, pair) * q.factor(view.wo.z())),
                             scaled(pair.f_reverse, q.factor(pair.wi.z())));
}

// Whether eval tends to 0 with the cosine of wi, on all meridians where it is positive at all. The value of a phase
// function does not.
bool vanishes_at_horizon(const BsdfView& view) {
  bool positive = false;
  for (int k = 0; k < 32; ++k) {
    const double phi = 2 * pi<double> * (k + 0.37) / 32;
    const auto at = [&](double z) {
      const Channels f = view.bsdf.eval(view.wo, spherical_direction<double>(std::sqrt(1 - z * z), z, phi));
      return *std::max_element(f.value.begin(), f.value.begin() + f.count);
    };
    const double side = view.wo.z() < 0 ? -1 : 1, above = at(1e-3 * side);
    if (!(above > 0)) continue;
    positive = true;
    if (at(1e-5 * side) > 0.02 * above) return false; // .01 for a cosine
  }
  return positive;
}

// An eval that leaves the cosine out is compared as it is. An eval without this promise is a phase function or includes
// the cosine: the value at the horizon, or else the smaller number of violations decides.
Quantity compared_quantity(const BsdfView& view) {
  if (view.options.cosine) return {false};
  if (vanishes_at_horizon(view)) return {true};
  std::array<std::size_t, 2> broken{};
  for (const DirectionPair& pair : view.pairs)
    for (const bool divided : {false, true})
      if (pair.has_reverse && !(error(view, pair, {divided}) <= view.options.tolerance)) ++broken[divided];
  return {broken[1] < broken[0]};
}

std::string describe_pair(const BsdfView& view, const DirectionPair& pair, const Quantity& q) {
  const Channels back = scaled(pair.f_reverse, 1 / q.factor(view.wo.z()));
  const Channels forth = scaled(pair.f, squared_ratio(view, pair) / q.factor(pair.wi.z()));
  std::string text = fmt::format("{} is {}, should be {} as {}{}, at {}", q.name("wi, wo", "wo"),
                                 view.bsdf.format(back), view.bsdf.format(forth), q.name("wo, wi", "wi"),
                                 squared_ratio(view, pair) == 1 ? "" : " times the squared ratio of the indices",
                                 describe(view, pair));
  if (!q.divided && error(view, pair, {true}) <= view.options.tolerance)
    text += "; f / |cos wi| is reciprocal: does eval include the cosine? Then set .cosine = false, or divide by |cos "
            "wi|";
  return text;
}

} // namespace

Findings bsdf_reciprocity_law(const BsdfView& view) {
  if (!view.options.reciprocal) return {};
  const Quantity quantity = compared_quantity(view);
  WorstError reciprocity("reciprocity", view.options.tolerance, Fault::physics);
  for (const DirectionPair& pair : view.pairs)
    if (pair.has_reverse)
      reciprocity.note(error(view, pair, quantity), [&] { return describe_pair(view, pair, quantity); });
  return {{reciprocity.check()}};
}

} // namespace mc
