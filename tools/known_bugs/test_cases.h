#pragma once
/// Kinds of bugs: a sampler with its density, a warp with its inverse, a BSDF, an estimator of a known mean, or a law.
/// They are function objects, not templates, so that a list of sixty samplers compiles in seconds.

#include <known_bugs/known_bugs.h>

#include <mc/check/subject/make_subject.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/domain/sphere.h>

#include <optional>

namespace carlo {

using Direction = mc::Vec3<double>;
using SampleDirection = std::function<std::optional<Direction>(mc::Pcg&)>;
using Density = std::function<double(const Direction&)>;
using SampleNumber = std::function<double(mc::Pcg&)>;

/// If allowed, the sampler may return nothing; its density then integrates to 1 minus the failure rate.
enum class Failures { never, allowed };

mc::Subject on_hemisphere(SampleDirection sample, Density pdf, Failures failures = Failures::never);
mc::Subject on_sphere(SampleDirection sample, Density pdf);
mc::Subject on_interval(double lo, double hi, SampleNumber sample, std::function<double(double)> pdf);

TestCase test_case(mc::Subject subject);

/// A warp of the hemisphere with its inverse. It is checked by the laws of a sampler and by invert(sample(u)) = u
/// within `tolerance`.
struct InvertibleWarp {
  std::function<Direction(const mc::Vec2<double>&)> sample;
  Density pdf;
  std::function<mc::Vec2<double>(const Direction&)> invert;
};
TestCase test_case(const InvertibleWarp& warp, double tolerance = 1e-9);

/// A warp of [0,1], checked in the same way.
struct InvertibleWarp1D {
  std::function<double(double)> sample, pdf, invert;
};
TestCase test_case(const InvertibleWarp1D& warp, double tolerance = 1e-12);

/// A BSDF for the outgoing polar angle theta_o [degrees], checked by the laws of check_bsdf.
struct BsdfFunctions {
  struct Sample {
    Direction wi;
    Eigen::Array3d f;
    double pdf = 0;
    bool delta = false, transmission = false;
  };
  std::function<std::optional<Sample>(const Direction& wo, double uc, const mc::Vec2<double>& u)> sample;
  std::function<Eigen::Array3d(const Direction& wo, const Direction& wi)> eval;
  std::function<double(const Direction& wo, const Direction& wi)> pdf;
};
TestCase test_case(const BsdfFunctions& bsdf, double theta_o);

/// An estimator with the expected value `value`, checked by a t-test; every estimate must be finite.
TestCase mean_test_case(double value, const SampleNumber& estimator);

/// A law without counts: error(random) <= limit at every point. NaN violates it.
TestCase law_test_case(const std::string& law, double limit, mc::Fault fault, const SampleNumber& error);

constexpr double pi = std::numbers::pi;
inline double uniform(mc::Pcg& r) { return r.uniform<double>(); }

/// Directions, their cosine density, and a point in the unit ball.
inline Direction direction(double z, double phi) {
  return mc::spherical_direction<double>(mc::safe_sqrt<double>((1 - z) * (1 + z)), z, phi);
}
inline Direction incident(double degrees) { return direction(std::cos(degrees * pi / 180), 0); }
inline double cosine_pdf(const Direction& w) { return w.z() > 0 ? w.z() / pi : 0.0; }
Direction cosine(mc::Pcg& r);
Direction in_ball(mc::Pcg& r);

} // namespace carlo
