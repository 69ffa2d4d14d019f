#pragma once
/// GoogleTest assertions for distributions, BSDFs and means.
///   EXPECT_WARP_LAWS(warp[, mc::LawOptions])      : every law and test of laws.h.
///   EXPECT_BSDF_LAWS(bsdf, wo[, mc::BsdfOptions]) : every law and test of bsdf_laws.h for the fixed direction wo, an
///     mc::Vec3. Conventions: eval without the cosine, unit vectors, +z is the normal
///     (docs/methods/bsdf-conventions.md).
///   EXPECT_SAMPLES_MATCH_PDF(sample, pdf, domain[, mc::SubjectOptions]) : the statistical tests; sample(u) or
///     sample(mc::Pcg&) returns a point or an optional point.
///   EXPECT_DISTRIBUTION(d, law[, mc::SubjectOptions]) : the statistical tests of a generator like those of the
///     standard library, d(engine). `law` is its density, the probability of an integer, or mc::ClaimedCdf(cdf).
///   EXPECT_MEAN(values, value[, alpha = 0.001])   : Student's t test of a range of numbers.
/// A failure begins with the finding: observed value, expected value and place (u, direction with its angles, or cell).
/// The likely cause and the check follow. The last line gives the number of other failed checks and the call that
/// prints them. Seeds are fixed: a test that passes keeps passing. docs/methods/checks.md describes every check.

#include <mc/check/bsdf_laws.h>
#include <mc/check/laws.h>
#include <mc/check/subject/generator.h>
#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/stats/t_test.h>

#include <gtest/gtest.h>

#include <type_traits>

namespace mc {

namespace detail {

// Whether the arguments of the macros have the required members. Constants instead of concepts, because compilers
// explain failed concepts at length.
template <class W> constexpr bool is_distribution = ContinuousDistribution<std::remove_cvref_t<W>>;
template <class Bsdf, class V>
constexpr bool is_bsdf = BsdfOver<std::remove_cvref_t<Bsdf>, typename std::remove_cvref_t<V>::Scalar>;
template <class Bsdf, class V>
constexpr bool
    checks_bsdf_members = checks_members<std::remove_cvref_t<Bsdf>, typename std::remove_cvref_t<V>::Scalar>();
template <class D> constexpr bool is_generator = Generator<std::remove_cvref_t<D>>;
template <class Draw, class D>
constexpr bool draws_points =
    std::invocable<Draw, Pcg&> || std::invocable<Draw, typename std::remove_cvref_t<D>::UnitPoint>;

inline constexpr std::string_view full_laws =
    "; mc::check_laws(warp, options).to_string(mc::ReportText::full) shows them";
inline constexpr std::string_view full_bsdf_laws =
    "; mc::check_bsdf(bsdf, wo, options).to_string(mc::ReportText::full) shows them";

} // namespace detail

/// Converts a report to a result of GoogleTest.
///   hint : how to get the full report, "; mc::check_laws(...)...".
inline testing::AssertionResult assert_passed(const Report& report, std::string_view hint) {
  if (report.passed()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << report.to_string(ReportText::brief, hint);
}

/// Result of EXPECT_WARP_LAWS; the expression names the subject unless the options do.
template <class W> testing::AssertionResult obeys_laws(const char* expression, const W& warp, LawOptions options = {}) {
  if (options.name == LawOptions{}.name) options.name = expression;
  if constexpr (detail::is_distribution<W>) return assert_passed(check_laws(warp, options), detail::full_laws);
  else return testing::AssertionFailure();
}

/// Result of EXPECT_BSDF_LAWS; the expression and wo name the subject unless the options do.
template <class Bsdf, class S>
testing::AssertionResult obeys_bsdf_laws(const char* expression, const Bsdf& bsdf, const Vec3<S>& wo,
                                         BsdfOptions options = {}) {
  if (options.name == BsdfOptions{}.name)
    options.name = fmt::format("{}, wo = ({:.6g}, {:.6g}, {:.6g})", expression, wo.x(), wo.y(), wo.z());
  if constexpr (detail::is_bsdf<Bsdf, Vec3<S>> && detail::checks_bsdf_members<Bsdf, Vec3<S>>) {
    try {
      return assert_passed(check_bsdf<S>(bsdf, wo, options), detail::full_bsdf_laws);
    } catch (const Error& e) {
      return testing::AssertionFailure() << options.name << ": " << e.what();
    }
  }
  return testing::AssertionFailure();
}

/// Result of EXPECT_SAMPLES_MATCH_PDF.
template <class Sample, class Pdf, Domain D>
testing::AssertionResult samples_match_pdf(const char* expression, Sample sample, Pdf pdf, const D& domain,
                                           const SubjectOptions& options = {}) {
  if constexpr (detail::draws_points<Sample, D>)
    return assert_passed(check_subject(make_subject(make_distribution(expression, domain, sample, pdf)), options), {});
  else return testing::AssertionFailure();
}

/// Result of EXPECT_DISTRIBUTION.
template <class D, class Law>
testing::AssertionResult has_law(const char* expression, const D& d, const Law& law,
                                 const SubjectOptions& options = {}) {
  if constexpr (detail::is_generator<D>) {
    try {
      return assert_passed(check_subject(make_generator_subject(expression, d, law), options), {});
    } catch (const Error& e) {
      return testing::AssertionFailure() << expression << ": " << e.what();
    }
  }
  return testing::AssertionFailure();
}

/// Result of EXPECT_MEAN.
template <class Values>
testing::AssertionResult has_mean(const char* expression, const Values& values, double value, double alpha = 0.001) {
  Moments moments;
  std::uint64_t index = 0;
  for (const auto& x : values) moments.add(static_cast<double>(x), index++);
  try {
    const TTest t = t_test(moments, value, alpha);
    if (t.p > alpha) return testing::AssertionSuccess();
    return testing::AssertionFailure() << fmt::format(
               "mean of {} is {:.9g} +- {:.2g}, should be {:.9g}: {:.1f} standard errors off (p = {:.3g}, {} values)",
               expression, moments.mean(), moments.std_error(), value, t.t, t.p, moments.count());
  } catch (const Error& e) {
    return testing::AssertionFailure() << expression << ": " << e.what();
  }
}

} // namespace mc

// Each macro checks the types of its arguments before any call, so that compilers name the missing member in a few
// lines. The check is outside the lambda, which cannot use names of structured bindings.

#define EXPECT_WARP_LAWS(warp, ...)                                                                                    \
  switch (constexpr bool mc_fits = ::mc::detail::is_distribution<decltype(warp)>; 0)                                   \
  case 0:                                                                                                              \
  default:                                                                                                             \
    switch (const char* mc_expression =                                                                                \
                [] {                                                                                                   \
                  static_assert(mc_fits, "a warp needs `using Domain = ...` and const domain(), sample(u), u of "      \
                                         "Domain::UnitPoint, and pdf(x)");                                             \
                  return #warp;                                                                                        \
                }();                                                                                                   \
            0)                                                                                                         \
    case 0:                                                                                                            \
    default:                                                                                                           \
      EXPECT_TRUE(::mc::obeys_laws(mc_expression, warp __VA_OPT__(, ) __VA_ARGS__))

#define EXPECT_BSDF_LAWS(bsdf, wo, ...)                                                                                \
  switch (constexpr bool mc_fits = ::mc::detail::is_bsdf<decltype(bsdf), decltype(wo)>,                                \
          mc_named = ::mc::detail::checks_bsdf_members<decltype(bsdf), decltype(wo)>;                                  \
          0)                                                                                                           \
  case 0:                                                                                                              \
  default:                                                                                                             \
    switch (                                                                                                           \
        const char* mc_expression =                                                                                    \
            [] {                                                                                                       \
              static_assert(                                                                                           \
                  mc_fits,                                                                                             \
                  "a BSDF needs const sample(wo, uc, u) or sample(wo, u), eval(wo, wi) and pdf(wo, wi), a number");    \
              static_assert(mc_named,                                                                                  \
                            "the sample has a member that is not checked: name it f if it is eval(wo, wi), or weight " \
                            "if it is f |cos wi| / pdf; the other members are wi, pdf, delta and transmission");       \
              return #bsdf;                                                                                            \
            }();                                                                                                       \
        0)                                                                                                             \
    case 0:                                                                                                            \
    default:                                                                                                           \
      EXPECT_TRUE(::mc::obeys_bsdf_laws(mc_expression, bsdf, wo __VA_OPT__(, ) __VA_ARGS__))

#define EXPECT_SAMPLES_MATCH_PDF(sample, pdf, domain, ...)                                                             \
  switch (constexpr bool mc_fits = ::mc::detail::draws_points<decltype(sample), decltype(domain)>; 0)                  \
  case 0:                                                                                                              \
  default:                                                                                                             \
    switch (const char* mc_expression =                                                                                \
                [] {                                                                                                   \
                  static_assert(mc_fits, "the function must take u, a point of the unit cube, or mc::Pcg&");           \
                  return #sample;                                                                                      \
                }();                                                                                                   \
            0)                                                                                                         \
    case 0:                                                                                                            \
    default:                                                                                                           \
      EXPECT_TRUE(::mc::samples_match_pdf(mc_expression, sample, pdf, domain __VA_OPT__(, ) __VA_ARGS__))

#define EXPECT_DISTRIBUTION(d, law, ...)                                                                               \
  switch (constexpr bool mc_fits = ::mc::detail::is_generator<decltype(d)>; 0)                                         \
  case 0:                                                                                                              \
  default:                                                                                                             \
    switch (const char* mc_expression =                                                                                \
                [] {                                                                                                   \
                  static_assert(mc_fits, "a generator must be copyable, with d(engine), a number");                    \
                  return #d;                                                                                           \
                }();                                                                                                   \
            0)                                                                                                         \
    case 0:                                                                                                            \
    default:                                                                                                           \
      EXPECT_TRUE(::mc::has_law(mc_expression, d, law __VA_OPT__(, ) __VA_ARGS__))

#define EXPECT_MEAN(values, value, ...) EXPECT_TRUE(::mc::has_mean(#values, values, value __VA_OPT__(, ) __VA_ARGS__))
