#pragma once
/// Participating media.

#include <render/bsdf/bsdf.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace render {

/// A homogeneous medium: it absorbs, and it scatters light by a phase function.
///   throws : Error unless sigma_a and sigma_s [1 / scene unit] are finite and >= 0.
///   Source : [PharrJakobHumphreys23] sections 11.1 and 14.1.
class HomogeneousMedium {
 public:
  /// A medium with coefficients of absorption and scattering [1 / scene unit].
  explicit HomogeneousMedium(const Spectrum& sigma_a, const Spectrum& sigma_s = Spectrum::Zero(),
                             const PhaseFunction& phase_function = PhaseFunction())
      : sigma_s_(checked_radiance("medium: sigmaS", sigma_s)),
        sigma_t_(checked_radiance("medium: sigmaA", sigma_a) + sigma_s), phase_function_(phase_function) {
    checked_radiance("medium: sigmaA + sigmaS", sigma_t_);
  }

  /// Whether it scatters.
  bool scatters() const { return !is_black(sigma_s_); }
  /// The phase function.
  const Bsdf& phase_function() const { return phase_function_; }

  /// Share exp(-sigma_t distance) of light that is neither absorbed nor scattered over a distance [scene units], which
  /// may be infinite. Not inlined, since few scenes have media.
  [[gnu::noinline]] Spectrum transmittance(Float distance) const {
    // the bound avoids 0 times infinity
    return (-sigma_t_ * std::min(distance, std::numeric_limits<Float>::max())).exp();
  }

  /// A sampled edge of a path through the medium.
  struct Edge {
    std::optional<Float> distance; ///< Distance to the point of scattering; none: the edge reaches its end.
    Spectrum weight;               ///< Factor of the throughput: sigma_s transmittance / density, or of the end.
  };
  /// Samples an edge of at most `length` [scene units], which may be infinite. The sum of the throughput does not grow.
  ///   beta : throughput before the edge, not black; a channel is sampled in proportion to it.
  ///   u    : in [0,1)^2; u[1] refines u[0], so that floats resolve depths of more than 16 mean free paths.
  Edge sample_edge(const Spectrum& beta, const Vec2& u, Float length) const;

 private:
  Spectrum sigma_s_, sigma_t_;
  Bsdf phase_function_;
};

} // namespace render
