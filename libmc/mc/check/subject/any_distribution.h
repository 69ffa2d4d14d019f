#pragma once
/// Any sampler with its claimed density, its types erased: what the laws run over.

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

/// A function of something that several functions share. They differ in `call` alone: what makes, copies and destroys
/// them is compiled once per signature, not once per sampler.
template <class Signature> struct SharedCall;
template <class R, class... Args> struct SharedCall<R(Args...)> {
  std::shared_ptr<const void> held;
  R (*call)(const void* held, Args... args);
  R operator()(Args... args) const { return call(held.get(), std::forward<Args>(args)...); }
};

} // namespace detail

/// A domain as functions of plain numbers. Its chart runs in double whatever the sampler computes in, so that bins lose
/// no precision; membership is tested in the sampler's own scalar.
struct AnyDomain {
  using Coordinates = Subject::Coordinates;
  struct DomainPoint {
    PointArray x{};
    double jacobian = 0;
  };
  int dim = 0;            ///< of its chart; 0: no domain, discrete outcomes only
  int point_size = 0;     ///< of a point
  std::vector<Axis> axes; ///< what the chart's coordinates stand for
  std::function<bool(const PointArray& x)> contains;
  std::function<Coordinates(const PointArray& x)> to_unit;
  std::function<DomainPoint(const Coordinates& v)> from_unit;
  std::function<double(const Coordinates& v)> jacobian; ///< that of from_unit alone
};

/// The same sampler over 50 digits.
struct OracleDistribution {
  using Point = std::array<Oracle, 3>;
  struct ChartPoint {
    Point v;         ///< in the chart
    Oracle jacobian; ///< of the chart there
  };
  std::function<std::optional<Point>(const Point& u)> sample;
  std::function<Oracle(const Point& x)> pdf;
  std::function<ChartPoint(const Point& x)> to_chart;
};

/// One sampler with its claimed density, whatever it is made of. Adapters to it: make_distribution.h for warps, tables,
/// discrete distributions and pairs of functions, bsdf.h for BSDFs. make_subject turns it into what the statistical
/// tests see. Every function but name, domain and pdf may be missing.
struct AnyDistribution {
  static constexpr int max_uniforms = 6;
  using Uniforms = std::array<double, max_uniforms>; ///< unused entries are 0

  /// The stated number of a sample that differs most from the number that f and pdf give: the weight, pdf or f.
  struct Stated {
    const char* name = "weight";
    double value = std::numeric_limits<double>::quiet_NaN(), expected = std::numeric_limits<double>::quiet_NaN();
    const char* hint = ""; ///< the likely reason for the difference; may be empty
  };

  /// What one sample says.
  struct Sample {
    PointArray x{};
    int atom = -1; ///< index of a discrete outcome, which has no place in the domain; NaN in x still shows
    double pdf = std::numeric_limits<double>::quiet_NaN(); ///< claimed, where the adapter knows it already
    double weight = 1; ///< stated weight * pdf / f where a weight is stated; 1 when they agree
    Stated stated;     ///< described when `weight` differs from 1
  };

  std::string name;
  AnyDomain domain;
  bool is_float = false; ///< computes in float: u and x are floats
  bool may_fail = false;
  bool open_interval = false;                ///< sample wants u in (0,1): no u is 0
  std::vector<double> atoms;                 ///< claimed probabilities of the discrete outcomes
  std::array<std::vector<double>, 3> breaks; ///< see Subject

  int uniforms = 0; ///< numbers that sample takes
  /// The sample of u in [0,1)^uniforms; nothing where it fails.
  std::function<std::optional<Sample>(const Uniforms& u)> sample;
  /// Those of several u, each with its pdf, for a sampler that answers many at once far faster than one by one; beside
  /// `sample`, and with its results.
  std::function<std::vector<std::optional<Sample>>(std::span<const Uniforms> u)> sample_many;
  /// The next sample of a stream, for samplers that take as many random numbers as they like. One of the two is there.
  std::function<std::optional<Sample>(Pcg& random)> sample_stream;
  /// The draws of several u as the tests see them, with their places in the chart: what `place` makes of each `sample`,
  /// without a call through a function for every step. It counts only as long as `sample` and `pdf` are those that it
  /// was made with.
  std::function<void(std::span<const Uniforms> u, std::span<Subject::Draw> draws)> draw_many;
  std::function<double(const PointArray& x)> pdf;
  /// The densities at several x, likewise beside `pdf`.
  std::function<std::vector<double>(std::span<const PointArray> x)> pdf_many;

  std::function<std::optional<Uniforms>(const PointArray& x)> invert; ///< states that sample is one to one
  std::function<double(const PointArray& x)> eval; ///< the integrand f >= 0 that it is meant for, its largest channel
  std::optional<OracleDistribution> oracle;
  std::function<double()> ns_per_sample;                  ///< measures it
  std::function<std::string(const Uniforms& u)> describe; ///< what the sample at u says, where x and pdf are not all

  double mass_tolerance = 0;      ///< see Subject; 0: 64 epsilons
  double weight_tolerance = 1e-4; ///< see Subject
  double invert_tolerance = 0;    ///< on |invert(sample(u)) - u| in the statistical tests

  double epsilon() const {
    return is_float ? static_cast<double>(std::numeric_limits<float>::epsilon())
                    : std::numeric_limits<double>::epsilon();
  }
  int digits() const { return is_float ? std::numeric_limits<float>::max_digits10 : 17; }
  double max_u() const { return 1 - epsilon() / 2; } ///< the largest u
};

/// The next point of the unit cube, in the sampler's scalar.
AnyDistribution::Uniforms random_uniforms(const AnyDistribution& distribution, Pcg& random);

/// One sample as the tests see it, in the chart.
struct ChartSample {
  Subject::Draw draw;
  double pdf = 0; ///< claimed density there, or probability of the outcome; 0 where it is neither
};
ChartSample to_chart(const AnyDistribution& distribution, const std::optional<AnyDistribution::Sample>& drawn);

/// "(0.25, 0.5)": the numbers of u and of x, in full.
std::string format_u(const AnyDistribution& distribution, const AnyDistribution::Uniforms& u);
std::string format_x(const AnyDistribution& distribution, const PointArray& x);
/// "u = 0.5, x = 2, pdf = 1", or "u = 0.5, sample fails".
std::string describe_sample(const AnyDistribution& distribution, const AnyDistribution::Uniforms& u);

/// The sampler as the statistical tests see it: a stream of draws in the chart.
Subject make_subject(const AnyDistribution& distribution);

} // namespace mc
