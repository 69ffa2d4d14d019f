#pragma once
/// The checkers as GoogleTest assertions, for users' own suites.
///   EXPECT_WARP_LAWS(warp[, mc::LawOptions])        : all laws of laws.h
///   EXPECT_BSDF_LAWS(bsdf, wo[, mc::BsdfOptions])   : all laws of bsdf_laws.h seen from wo, a mc::Vec3
///   EXPECT_SAMPLES_MATCH_PDF(sampler, pdf, domain[, mc::SubjectOptions])
///                                                   : the chi-square tests; sampler(u) or sampler(mc::Pcg&) gives a
///                                                     point or an optional point
///   EXPECT_MEAN(values, value[, alpha = 0.001])     : Student's t; values are any range of numbers
/// Failures say which law broke, where and by how much. Seeds are fixed, so a test that passes keeps passing.

#include <mc/check/bsdf_laws.h>
#include <mc/check/laws.h>
#include <mc/core/error.h>
#include <mc/estimate/moments.h>
#include <mc/stats/t_test.h>

#include <gtest/gtest.h>

#include <type_traits>

namespace mc {

namespace detail {

// Of what the macros are handed. No concepts: compilers would explain these at length.
template <class W> constexpr bool is_sampler = Samplable<std::remove_cvref_t<W>>;
template <class Bsdf, class V>
constexpr bool is_bsdf = BsdfOver<std::remove_cvref_t<Bsdf>, typename std::remove_cvref_t<V>::Scalar>;
template <class Draw, class D>
constexpr bool draws_points =
    std::invocable<Draw, Pcg&> || std::invocable<Draw, typename std::remove_cvref_t<D>::UnitPoint>;

} // namespace detail

inline testing::AssertionResult assert_passed(const Report& report) {
  return report.passed() ? testing::AssertionSuccess() : testing::AssertionFailure() << report.to_string();
}

template <class W> testing::AssertionResult obeys_laws(const char* expression, const W& warp, LawOptions options = {}) {
  if (options.name == LawOptions{}.name) options.name = expression;
  if constexpr (detail::is_sampler<W>) return assert_passed(check_laws(warp, options));
  else return testing::AssertionFailure();
}

template <class Bsdf, class S>
testing::AssertionResult obeys_bsdf_laws(const char* expression, const Bsdf& bsdf, const Vec3<S>& wo,
                                         BsdfOptions options = {}) {
  if (options.name == BsdfOptions{}.name) options.name = expression;
  if constexpr (detail::is_bsdf<Bsdf, Vec3<S>>) return assert_passed(check_bsdf<S>(bsdf, wo, options));
  else return testing::AssertionFailure();
}

template <class Sampler, class Pdf, Domain D>
testing::AssertionResult samples_match_pdf(const char* expression, Sampler sampler, Pdf pdf, const D& domain,
                                           const SubjectOptions& options = {}) {
  if constexpr (detail::draws_points<Sampler, D>)
    return assert_passed(check_subject(make_subject(make_sampler(expression, domain, sampler, pdf)), options));
  else return testing::AssertionFailure();
}

template <class Values>
testing::AssertionResult has_mean(const char* expression, const Values& values, double value, double alpha = 0.001) {
  Moments moments;
  std::uint64_t index = 0;
  for (const auto& x : values) moments.add(static_cast<double>(x), index++);
  try {
    const TTest t = t_test(moments, value, alpha);
    if (t.p > alpha) return testing::AssertionSuccess();
    return testing::AssertionFailure() << fmt::format(
               "mean of {}: {:.9g} +- {:.2g} over {} values, expected {:.9g}: {:.1f} standard errors off, p = {:.3g}",
               expression, moments.mean(), moments.std_error(), moments.count(), value, t.t, t.p);
  } catch (const Error& e) {
    return testing::AssertionFailure() << expression << ": " << e.what();
  }
}

} // namespace mc

// Each looks at what it is handed before it calls anything, so that compilers say in a few lines what is missing. It
// does so outside of the lambda, where names of structured bindings may stand.

#define EXPECT_WARP_LAWS(warp, ...)                                                                                    \
  switch (constexpr bool mc_fits = ::mc::detail::is_sampler<decltype(warp)>; 0)                                        \
  case 0:                                                                                                              \
  default:                                                                                                             \
    switch (const char* mc_expression =                                                                                \
                [] {                                                                                                   \
                  static_assert(mc_fits, "a sampler needs `using Domain = ...` and const domain(), sample(u), u of "   \
                                         "Domain::UnitPoint, and pdf(x)");                                             \
                  return #warp;                                                                                        \
                }();                                                                                                   \
            0)                                                                                                         \
    case 0:                                                                                                            \
    default:                                                                                                           \
      EXPECT_TRUE(::mc::obeys_laws(mc_expression, warp __VA_OPT__(, ) __VA_ARGS__))

#define EXPECT_BSDF_LAWS(bsdf, wo, ...)                                                                                \
  switch (constexpr bool mc_fits = ::mc::detail::is_bsdf<decltype(bsdf), decltype(wo)>; 0)                             \
  case 0:                                                                                                              \
  default:                                                                                                             \
    switch (                                                                                                           \
        const char* mc_expression =                                                                                    \
            [] {                                                                                                       \
              static_assert(                                                                                           \
                  mc_fits,                                                                                             \
                  "a BSDF needs const sample(wo, uc, u) or sample(wo, u), eval(wo, wi) and pdf(wo, wi), a number");    \
              return #bsdf;                                                                                            \
            }();                                                                                                       \
        0)                                                                                                             \
    case 0:                                                                                                            \
    default:                                                                                                           \
      EXPECT_TRUE(::mc::obeys_bsdf_laws(mc_expression, bsdf, wo __VA_OPT__(, ) __VA_ARGS__))

#define EXPECT_SAMPLES_MATCH_PDF(sampler, pdf, domain, ...)                                                            \
  switch (constexpr bool mc_fits = ::mc::detail::draws_points<decltype(sampler), decltype(domain)>; 0)                 \
  case 0:                                                                                                              \
  default:                                                                                                             \
    switch (const char* mc_expression =                                                                                \
                [] {                                                                                                   \
                  static_assert(mc_fits, "the sampler must take u, a point of the unit cube, or mc::Pcg&");            \
                  return #sampler;                                                                                     \
                }();                                                                                                   \
            0)                                                                                                         \
    case 0:                                                                                                            \
    default:                                                                                                           \
      EXPECT_TRUE(::mc::samples_match_pdf(mc_expression, sampler, pdf, domain __VA_OPT__(, ) __VA_ARGS__))

#define EXPECT_MEAN(values, value, ...) EXPECT_TRUE(::mc::has_mean(#values, values, value __VA_OPT__(, ) __VA_ARGS__))
