// Reciprocity law of delta lobes: a lobe carries the same share of the energy both ways. With shares, refraction needs
// no further factor.

#include <mc/check/laws/bsdf/bsdf_law.h>

#include <utility>

namespace mc {
namespace {

// Returns the share of the light leaving along `from` that the delta lobe carries.
Channels share(const AnyBsdf::Sample& d, const AnyBsdf::Direction& from, const BsdfOptions& options) {
  const double scale = d.transmission ? squared_index(d.wi, options) / squared_index(from, options) : 1;
  return scaled(throughput(d, options), scale * d.pdf);
}

// Returns the share on the way back from `there` to wo; no value if 1024 samples do not draw this lobe.
std::optional<Channels> share_back(const BsdfView& view, const AnyBsdf::Sample& there, Pcg& random) {
  for (int k = 0; k < 1024; ++k) {
    const auto d = view.bsdf.sample_next(there.wi, random);
    if (d && d->delta && d->transmission == there.transmission && d->wi.dot(view.wo) > 0.999)
      return share(*d, there.wi, view.options);
  }
  return {};
}

} // namespace

Findings bsdf_delta_reciprocity_law(const BsdfView& view) {
  if (!view.options.reciprocal) return {};
  WorstError error("reciprocity of delta lobes", view.options.tolerance, Fault::physics);
  Pcg random(view.options.statistics.seed, 23);
  std::array<bool, 2> done{};
  for (int i = 0; i < 256; ++i) {
    const auto there = view.bsdf.sample_next(view.wo, random);
    if (!there || !there->delta || std::exchange(done[there->transmission ? 1 : 0], true)) continue;
    const Channels forth = share(*there, view.wo, view.options);
    const std::optional<Channels> back = share_back(view, *there, random);
    for (int c = 0; c < std::max(forth.count, back ? back->count : 0); ++c) {
      if (!back && forth[c] < 0.05) continue; // too rare for 1024 samples
      error.note(std::abs(forth[c] - (back ? (*back)[c] : HUGE_VAL)), [&] {
        return fmt::format("delta lobe carries {} of the energy from wi to wo, should be {:.6g} as from wo to wi, at "
                           "wo = {}, wi = {}",
                           back ? fmt::format("{:.6g}", (*back)[c]) : "none", forth[c],
                           describe_direction(view.bsdf, view.wo), describe_direction(view.bsdf, there->wi));
      });
    }
  }
  return {{error.check()}};
}

} // namespace mc
