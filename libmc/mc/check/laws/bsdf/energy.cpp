// Energy law: the white furnace albedo is at most 1; exactly 1 for a lossless BSDF.

#include <mc/check/laws/bsdf/bsdf_law.h>

#include <mc/core/types.h>
#include <mc/estimate/moments.h>

namespace mc {
namespace {

// White furnace: estimates the albedo for wo, the mean of f |cos| / pdf, per channel. Missing channels repeat the last
// one.
std::array<Moments, Channels::max_count> white_furnace(const BsdfView& view, const AnyBsdf::Direction& wo, int n,
                                                       std::uint64_t seed) {
  std::array<Moments, Channels::max_count> albedo;
  Pcg random(seed, 22);
  for (int i = 0; i < n; ++i) {
    const auto drawn = view.bsdf.sample_next(wo, random);
    Channels share{1, {}};
    if (drawn) {
      share = throughput(*drawn, view.options);
      if (drawn->transmission)
        share = scaled(share, squared_index(drawn->wi, view.options) / squared_index(wo, view.options));
    }
    for (int c = 0; c < Channels::max_count; ++c) albedo[static_cast<std::size_t>(c)].add(share[c]);
  }
  return albedo;
}

// Tests the albedo for one wo. The returned value is the largest over the channels.
ReportedValue judge(const BsdfView& view, const AnyBsdf::Direction& wo, int n, std::uint64_t seed, WorstError& energy) {
  const BsdfOptions& options = view.options;
  const std::string where = view.bsdf.format(wo);
  ReportedValue greatest{"white furnace", -1, 0, where};
  for (const Moments& m : white_furnace(view, wo, n, seed)) {
    const double slack = 5 * m.std_error() + options.tolerance, mean = m.non_finite_count() ? HUGE_VAL : m.mean();
    if (mean > greatest.value) {
      greatest.value = mean;
      greatest.std_error = m.std_error();
    }
    const double off = options.lossless ? std::abs(mean - 1) - slack : mean - 1 - slack;
    energy.note(std::max(off, 0.0), [&] {
      return fmt::format("white furnace albedo is {:.6g} +- {:.2g}, should be {}1, at wo = {}", mean, m.std_error(),
                         options.lossless ? "" : "at most ", describe_direction(view.bsdf, wo));
    });
  }
  return greatest;
}

} // namespace

Findings bsdf_energy_law(const BsdfView& view) {
  WorstError energy("energy <= 1", 0, Fault::physics);
  const int n = static_cast<int>(std::min<std::uint64_t>(view.options.statistics.samples, 100'000));
  const ReportedValue here = judge(view, view.wo, n, view.options.statistics.seed, energy);
  double most = -1;
  AnyBsdf::Direction brightest = view.wo;
  for (int k = 0; k < 32; ++k) {
    constexpr std::array<double, 8> cosines{1, 0.9, 0.7, 0.5, 0.3, 0.1, 0.03, 0.003};
    const bool other_side = k % 2 == 1;
    if (other_side && !view.transmissive) continue;
    const double side = (view.wo.z() < 0) == other_side ? 1 : -1;
    const double z = side * cosines[static_cast<std::size_t>(k / 2 % 8)], phi = k < 16 ? 0.4 : 2.3;
    const AnyBsdf::Direction w = spherical_direction<double>(std::sqrt(1 - z * z), z, phi);
    const ReportedValue f =
        judge(view, w, 1000, view.options.statistics.seed + static_cast<std::uint64_t>(k) + 1, energy);
    if (!(f.value > most)) continue;
    most = f.value;
    brightest = w;
  }
  // A thousand samples underestimate the albedo if they rarely draw the lobe that gains energy.
  ReportedValue again = judge(view, brightest, n, view.options.statistics.seed + 33, energy);
  again.name = "white furnace, greatest over wo";
  return {{energy.check()}, {here, again}};
}

} // namespace mc
