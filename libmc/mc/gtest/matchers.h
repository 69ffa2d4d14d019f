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

namespace mc {

inline testing::AssertionResult assert_passed(const Report& report) {
  return report.passed() ? testing::AssertionSuccess() : testing::AssertionFailure() << report.to_string();
}

template <class W> testing::AssertionResult obeys_laws(const char* expression, const W& warp, LawOptions options = {}) {
  if (options.name == LawOptions{}.name) options.name = expression;
  return assert_passed(check_laws(warp, options));
}

template <class Bsdf, class S>
testing::AssertionResult obeys_bsdf_laws(const char* expression, const Bsdf& bsdf, const Vec3<S>& wo,
                                         BsdfOptions options = {}) {
  if (options.name == BsdfOptions{}.name) options.name = expression;
  return assert_passed(check_bsdf<S>(bsdf, wo, options));
}

template <class Sampler, class Pdf, Domain D>
testing::AssertionResult samples_match_pdf(const char* expression, Sampler sampler, Pdf pdf, const D& domain,
                                           const SubjectOptions& options = {}) {
  return assert_passed(check_subject(make_subject(make_sampler(expression, domain, sampler, pdf)), options));
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

#define EXPECT_WARP_LAWS(warp, ...) EXPECT_TRUE(::mc::obeys_laws(#warp, warp __VA_OPT__(, ) __VA_ARGS__))
#define EXPECT_BSDF_LAWS(bsdf, wo, ...) EXPECT_TRUE(::mc::obeys_bsdf_laws(#bsdf, bsdf, wo __VA_OPT__(, ) __VA_ARGS__))
#define EXPECT_SAMPLES_MATCH_PDF(sampler, pdf, domain, ...)                                                            \
  EXPECT_TRUE(::mc::samples_match_pdf(#sampler, sampler, pdf, domain __VA_OPT__(, ) __VA_ARGS__))
#define EXPECT_MEAN(values, value, ...) EXPECT_TRUE(::mc::has_mean(#values, values, value __VA_OPT__(, ) __VA_ARGS__))
