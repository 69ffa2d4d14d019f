#pragma once
// A light of your own: the sun behind haze, an infinite light whose radiance falls off about the direction of the sun.
#include <render/light/concept.h>

#include <mc/warp/rotated.h>
#include <mc/warp/von_mises_fisher.h>

class HazySun {
 public:
  using Float = render::Float;
  using Vec3 = render::Vec3;
  using Spectrum = render::Spectrum;

  // toward : unit vector to the sun.  kappa : concentration; 1 / sqrt(kappa) is about the radius of the spot [rad].
  // total  : integral of the radiance over all directions [W/m^2].
  HazySun(const Vec3& toward, Float kappa, const Spectrum& total)
      : lobe_(mc::VonMisesFisher<Float>(kappa), toward), total_(render::checked_radiance("hazy sun: total", total)) {}

  // `wi` leaves the reference point. Infinite lights have no light point.
  Spectrum Le(const Vec3& wi, const render::SurfacePoint*) const { return total_ * lobe_.pdf(wi); }
  std::optional<render::LightSample> sample(const Vec3&, const render::Vec2& u) const {
    const Vec3 wi = lobe_.sample(u);
    return render::LightSample{wi, Le(wi, nullptr), lobe_.pdf(wi), {}};
  }
  Float pdf(const Vec3&, const Vec3& wi, const render::SurfacePoint*) const { return lobe_.pdf(wi); }

  // First rays of light paths, and their density.
  std::optional<render::EmissionSample> sample_emission(const render::EmissionTargets& targets, const render::Vec2& u,
                                                        const render::Vec2& v) const {
    return render::sample_infinite_emission(*this, targets, u, v);
  }
  double emission_pdf(const render::EmissionTargets& targets, const Vec3& ref, const Vec3& wi,
                      const render::SurfacePoint* light_point) const {
    return double(pdf(ref, wi, light_point)) * targets.parallel_pdf(ref, wi);
  }

  double power(double radius) const { return mc::pi<double> * radius * radius * double(render::luminance(total_)); }
  double irradiance(const Vec3&) const { return double(render::luminance(total_)); }
  bool is_delta() const { return false; }
  bool is_infinite() const { return true; }
  bool is_sampled() const { return true; }

 private:
  mc::Rotated<mc::VonMisesFisher<Float>> lobe_;
  Spectrum total_;
};
static_assert(render::LightLike<HazySun>);
