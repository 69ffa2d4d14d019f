#pragma once
/// Type-erased distributions, the input of the laws.

#include <mc/check/subject/oracle.h>
#include <mc/check/subject/point_array.h>
#include <mc/check/subject/subject.h>
#include <mc/random/pcg.h>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mc {

namespace detail {

/// A function of state that several functions share. All such functions differ only in `call`. Construction, copying
/// and destruction are therefore compiled once per signature, instead of once per distribution.
template <class Signature> struct SharedCall;
template <class R, class... Args> struct SharedCall<R(Args...)> {
  std::shared_ptr<const void> held;
  R (*call)(const void* held, Args... args);
  R operator()(Args... args) const { return call(held.get(), std::forward<Args>(args)...); }
};

} // namespace detail

/// A domain as functions of plain numbers. Its chart computes in double for any scalar of the distribution, so that
/// bins lose no precision. `contains` uses the distribution's own scalar.
struct AnyDomain {
  /// A point of the unit cube.
  using Coordinates = Subject::Coordinates;
  /// A point of the domain with the Jacobian of the chart.
  struct DomainPoint {
    PointArray x{};      ///< the point
    double jacobian = 0; ///< |dx / dv| of from_unit
  };
  int dim = 0;            ///< dimension of the chart; 0: no domain, only discrete outcomes
  int point_size = 0;     ///< number of coordinates of a point
  std::vector<Axis> axes; ///< meaning of the chart coordinates
  /// Returns whether x lies in the domain.
  std::function<bool(const PointArray& x)> contains;
  /// Maps a point of the domain to the unit cube.
  std::function<Coordinates(const PointArray& x)> to_unit;
  /// Maps a point of the unit cube to the domain.
  std::function<DomainPoint(const Coordinates& v)> from_unit;
  std::function<double(const Coordinates& v)> jacobian; ///< the Jacobian of from_unit alone
};

/// The same distribution over 50 digits.
struct OracleDistribution {
  /// A point of the domain or of the unit cube.
  using Point = PerAxis<Oracle>;
  /// A point of the chart with the Jacobian there.
  struct ChartPoint {
    Point v;         ///< chart coordinates
    Oracle jacobian; ///< |dx / dv| at v
  };
  /// Returns the sample of u; no value if the sample fails.
  std::function<std::optional<Point>(const Point& u)> sample;
  /// Returns the claimed density at x.
  std::function<Oracle(const Point& x)> pdf;
  /// Maps a point of the domain to the chart.
  std::function<ChartPoint(const Point& x)> to_chart;
};

/// A distribution with its claimed density, independent of its type. Adapters: make_distribution.h for warps, tables,
/// discrete distributions and pairs of functions; bsdf_law.h for BSDFs. make_subject prepares it for the statistical
/// tests. Only name, domain and pdf are required of the functions.
struct AnyDistribution {
  /// Largest dimension of u.
  static constexpr int max_uniforms = 6;
  using Uniforms = std::array<double, max_uniforms>; ///< a point of the unit cube; unused entries are 0

  /// The stated quantity of a sample (weight, pdf or f) that differs most from its recomputed value.
  struct Stated {
    const char* name = "weight";                             ///< name of the quantity
    double value = std::numeric_limits<double>::quiet_NaN(), ///< stated value
        expected = std::numeric_limits<double>::quiet_NaN(); ///< recomputed value
    const char* hint = "";                                   ///< the likely reason for the difference; may be empty
  };

  /// One sample with the values that it states.
  struct Sample {
    PointArray x{}; ///< the point
    /// Index of a discrete outcome, which has no point in the domain; -1 for a point. A NaN in x counts for outcomes
    /// too.
    int atom = -1;
    double pdf = std::numeric_limits<double>::quiet_NaN(); ///< claimed density, if the adapter has already computed it
    double weight = 1; ///< stated weight * pdf / f if a weight is stated; 1 when they agree
    Stated stated;     ///< reported when `weight` differs from 1
  };

  std::string name;                    ///< name in the report
  AnyDomain domain;                    ///< the domain of the points
  bool is_float = false;               ///< u and x are floats
  bool may_fail = false;               ///< sample may fail, with probability 1 - mass
  bool open_interval = false;          ///< sample requires u in (0,1), without 0
  bool states_weight = false;          ///< a sample states weight, pdf or f, which Sample::weight compares
  std::vector<double> atoms;           ///< claimed probabilities of the discrete outcomes
  PerAxis<std::vector<double>> breaks; ///< positions of jumps, see Subject

  int uniforms = 0; ///< dimension of u
  /// Returns the sample of u in [0,1)^uniforms; no value if the sample fails. Either `sample` or `sample_stream` is
  /// set.
  std::function<std::optional<Sample>(const Uniforms& u)> sample;
  /// Returns the samples of several u, each with its pdf. For distributions that are much faster in batches; requires
  /// `sample` and gives the same results.
  std::function<std::vector<std::optional<Sample>>(std::span<const Uniforms> u)> sample_many;
  /// Returns the next sample of a stream, for distributions that use a varying number of random numbers.
  std::function<std::optional<Sample>(Pcg& random)> sample_stream;
  /// Returns n samples of the stream Pcg(seed), each with its pdf. For distributions that are much faster in batches;
  /// requires `sample_stream` and gives the same results.
  std::function<std::vector<std::optional<Sample>>(std::uint64_t seed, std::size_t n)> sample_stream_many;
  /// Computes the draws of several u with their chart coordinates, as to_chart(sample(u)) does, but without one
  /// std::function call per step. Used only while `sample` and `pdf` are the functions that it was created with.
  std::function<void(std::span<const Uniforms> u, std::span<Subject::Draw> draws)> draw_many;
  /// Returns the claimed density at x.
  std::function<double(const PointArray& x)> pdf;
  /// Returns the densities at several x; requires `pdf` and gives the same results.
  std::function<std::vector<double>(std::span<const PointArray> x)> pdf_many;

  /// Returns u with sample(u) = x. An inverse states that sample is one-to-one.
  std::function<std::optional<Uniforms>(const PointArray& x)> invert;
  /// Returns the inverses of several x; requires `invert` and gives the same results.
  std::function<std::vector<std::optional<Uniforms>>(std::span<const PointArray> x)> invert_many;
  /// Returns the integrand f >= 0 that the distribution is made for, its largest channel.
  std::function<double(const PointArray& x)> eval;
  std::optional<OracleDistribution> oracle;               ///< the same distribution over 50 digits
  std::function<double()> ns_per_sample;                  ///< measures the time of one sample [ns]
  std::function<std::string(const Uniforms& u)> describe; ///< describes the sample at u, if x and pdf are not enough

  double mass_tolerance = 0;      ///< see Subject; 0: 64 epsilons
  double weight_tolerance = 1e-4; ///< see Subject
  double invert_tolerance = 0;    ///< bound on |invert(sample(u)) - u| in the statistical tests

  /// Returns the machine epsilon of the distribution's scalar.
  double epsilon() const {
    return is_float ? static_cast<double>(std::numeric_limits<float>::epsilon())
                    : std::numeric_limits<double>::epsilon();
  }
  /// Returns the number of decimal digits that identify a number of the distribution's scalar.
  int digits() const { return is_float ? std::numeric_limits<float>::max_digits10 : 17; }
  double max_u() const { return 1 - epsilon() / 2; } ///< the largest u
};

/// Returns the change of chart coordinate `axis` if the point at v changes by one unit in the last place of a scalar
/// with this machine epsilon.
double resolution(const AnyDomain& domain, double epsilon, const Subject::Coordinates& v, std::size_t axis);

/// Returns the next random point of the unit cube, in the precision of the distribution's scalar.
AnyDistribution::Uniforms random_uniforms(const AnyDistribution& distribution, Pcg& random);

/// A sample mapped to the chart.
struct ChartSample {
  Subject::Draw draw; ///< the draw in chart coordinates
  double pdf = 0;     ///< claimed density at the point, or probability of the outcome; else 0
};
/// Maps a sample to the chart and classifies it; no value counts as a failure.
ChartSample to_chart(const AnyDistribution& distribution, const std::optional<AnyDistribution::Sample>& drawn);

/// Returns u with all digits, for example "(0.25, 0.5)".
std::string format_u(const AnyDistribution& distribution, const AnyDistribution::Uniforms& u);
/// Returns the coordinates of x with all digits, for example "(0.25, 0.5)".
std::string format_x(const AnyDistribution& distribution, const PointArray& x);
/// Returns the coordinates of x with its radii and angles, "(0.6, 0, 0.8) [theta 36.87 deg, phi 0 deg]".
std::string describe_x(const AnyDistribution& distribution, const PointArray& x);
/// Returns "u = 0.5, x = 2, pdf = 1" or "u = 0.5, sample fails".
std::string describe_sample(const AnyDistribution& distribution, const AnyDistribution::Uniforms& u);

/// Returns the distribution as a stream of draws in the chart, the input of the statistical tests.
Subject make_subject(const AnyDistribution& distribution);

} // namespace mc
