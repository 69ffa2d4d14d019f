#include <known_bugs/test_cases.h>

#include <mc/check/bsdf_laws.h>
#include <mc/check/laws/law.h>
#include <mc/estimate/moments.h>
#include <mc/stats/t_test.h>
#include <mc/warp/hemisphere.h>

namespace carlo {
namespace {

using Kind = mc::Subject::Draw::Kind;

template <class D> mc::Subject on(const D& domain, SampleDirection sample, Density pdf, Failures failures) {
  mc::Subject s = make_subject("", domain, std::move(sample), std::move(pdf));
  s.may_fail = failures == Failures::allowed;
  return s;
}

bool is_bad(const mc::Subject& s, const mc::Subject::Draw& d) {
  switch (d.kind) {
  case Kind::failed: return !s.may_fail;
  case Kind::outside:
  case Kind::not_finite: return true;
  case Kind::atom:
  case Kind::point: break;
  }
  return !d.pdf_positive || !(std::abs(d.weight - 1) <= s.weight_tolerance);
}

mc::Report report_of(const CaseOptions& c) {
  mc::Report report;
  report.alpha = c.alpha;
  report.samples = c.samples;
  return report;
}

mc::Check finite_check(const mc::Moments& moments, std::uint64_t samples) {
  const auto bad = static_cast<double>(moments.non_finite_count());
  mc::Check check{"finite", mc::Verdict::pass, {}, 0, bad, 0, mc::Fault::not_finite, {}};
  if (bad > 0) {
    check.verdict = mc::Verdict::fail;
    check.detail =
        fmt::format("estimate {} is not finite; {} of {} estimates", moments.first_non_finite(), bad, samples);
  }
  return check;
}

mc::Check mean_check(const mc::Moments& moments, double value, double alpha) {
  const bool exact =
      std::abs(moments.mean() - value) <= 1e-12 * std::abs(value); // a perfect estimator has zero variance
  const mc::TTest test = exact ? mc::TTest{} : mc::t_test(moments, value, alpha);
  mc::Check check{"mean", mc::Verdict::pass, test.p, 1, test.t, 0, mc::Fault::bias, {}};
  if (test.p <= alpha) {
    check.verdict = mc::Verdict::fail;
    check.detail = fmt::format("mean of the estimates is {:.6g} +- {:.2g}, should be {:.6g}", moments.mean(),
                               moments.std_error(), value);
  }
  return check;
}

// Calls the function of the options that may end a check, every 2^16 samples.
void look_for_end(const CaseOptions& c, std::uint64_t sample) {
  constexpr std::uint64_t every = 65536;
  if (c.before_draws && sample % every == 0) (*c.before_draws)(every);
}

mc::Report mean_report(double value, const SampleNumber& estimator, const CaseOptions& c) {
  mc::Report report = report_of(c);
  mc::Moments moments;
  mc::Pcg random(c.seed);
  for (std::uint64_t i = 0; i < c.samples; ++i) {
    look_for_end(c, i);
    moments.add(estimator(random), i);
  }
  report.checks.push_back(finite_check(moments, c.samples));
  if (moments.non_finite_count() == 0) report.checks.push_back(mean_check(moments, value, c.alpha));
  return report;
}

mc::Report law_report(mc::WorstError worst, const SampleNumber& error, const CaseOptions& c) {
  mc::Report report = report_of(c);
  mc::Pcg random(c.seed);
  for (std::uint64_t i = 0; i < c.samples; ++i) {
    look_for_end(c, i);
    const double off = error(random);
    worst.note(off, [&] { return fmt::format("error is {:.3g} at random point {}", off, i); });
  }
  report.checks.push_back(worst.check());
  return report;
}

// The laws of a sampler, with the inverse first: its failure is reported before failures of counts.
TestCase test_case_with_inverse(const mc::AnyDistribution& distribution, double tolerance) {
  TestCase t = test_case(make_subject(distribution));
  t.check = [counts = t.check, distribution, tolerance](const CaseOptions& c) {
    mc::Report report = counts(c);
    for (mc::Check& check :
         mc::inverse_law(distribution, {.statistics = c, .invert_eps = tolerance / distribution.epsilon()}).checks)
      report.checks.insert(report.checks.begin(), std::move(check));
    return report;
  };
  return t;
}

} // namespace

mc::Subject on_hemisphere(SampleDirection sample, Density pdf, Failures failures) {
  return on(mc::Hemisphere<double>{}, std::move(sample), std::move(pdf), failures);
}
mc::Subject on_sphere(SampleDirection sample, Density pdf) {
  return on(mc::Sphere<double>{}, std::move(sample), std::move(pdf), Failures::never);
}
mc::Subject on_interval(double lo, double hi, SampleNumber sample, std::function<double(double)> pdf) {
  return make_subject("", mc::Interval<double>(lo, hi), std::move(sample), std::move(pdf));
}

TestCase test_case(mc::Subject subject) {
  TestCase t;
  t.first_failure = [subject](std::uint64_t seed, std::uint64_t most) -> std::uint64_t {
    constexpr std::uint64_t chunk = 256;
    std::vector<mc::Subject::Draw> draws;
    for (std::uint64_t first = 0; first < most; first += chunk) {
      draws.clear();
      subject.draw(mc::hash(seed, first), chunk, draws);
      for (std::size_t i = 0; i < draws.size(); ++i)
        if (is_bad(subject, draws[i])) return first + i + 1;
    }
    return 0;
  };
  t.check = [subject = std::move(subject)](const CaseOptions& c) { return check_subject(subject, c); };
  return t;
}

TestCase test_case(const InvertibleWarp& warp, double tolerance) {
  mc::AnyDistribution distribution = make_distribution("", mc::Hemisphere<double>{}, warp.sample, warp.pdf);
  distribution.invert = [invert =
                             warp.invert](const mc::PointArray& x) -> std::optional<mc::AnyDistribution::Uniforms> {
    const mc::Vec2<double> u = invert({x[0], x[1], x[2]});
    return mc::AnyDistribution::Uniforms{u[0], u[1]};
  };
  return test_case_with_inverse(distribution, tolerance);
}

TestCase test_case(const InvertibleWarp1D& warp, double tolerance) {
  mc::AnyDistribution distribution = make_distribution("", mc::Interval<double>{}, warp.sample, warp.pdf);
  distribution.invert = [invert =
                             warp.invert](const mc::PointArray& x) -> std::optional<mc::AnyDistribution::Uniforms> {
    return mc::AnyDistribution::Uniforms{invert(x[0])};
  };
  return test_case_with_inverse(distribution, tolerance);
}

TestCase test_case(const BsdfFunctions& bsdf, double theta_o) {
  const Direction wo = incident(theta_o);
  TestCase t = test_case(mc::bsdf_subject<double>(bsdf, wo));
  t.check = [bsdf, wo](const CaseOptions& c) {
    return mc::check_bsdf<double>(bsdf, wo, {.name = "", .statistics = c});
  };
  return t;
}

TestCase mean_test_case(double value, const SampleNumber& estimator) {
  TestCase t;
  t.min_samples = 16;
  t.first_failure = [estimator](std::uint64_t seed, std::uint64_t most) -> std::uint64_t {
    mc::Pcg random(seed);
    for (std::uint64_t i = 1; i <= most; ++i)
      if (!std::isfinite(estimator(random))) return i;
    return 0;
  };
  t.check = [value, estimator](const CaseOptions& c) { return mean_report(value, estimator, c); };
  return t;
}

TestCase law_test_case(const std::string& law, double limit, mc::Fault fault, const SampleNumber& error) {
  TestCase t;
  t.min_samples = 16;
  t.first_failure = [limit, error](std::uint64_t seed, std::uint64_t most) -> std::uint64_t {
    mc::Pcg random(seed);
    for (std::uint64_t i = 1; i <= most; ++i)
      if (!(error(random) <= limit)) return i;
    return 0;
  };
  t.check = [worst = mc::WorstError(law, limit, fault), error](const CaseOptions& c) {
    return law_report(worst, error, c);
  };
  return t;
}

Direction cosine(mc::Pcg& r) { return mc::CosineHemisphere<double>{}.sample(r.point<double, 2>()); }

Direction in_ball(mc::Pcg& r) {
  for (;;) {
    const Direction p{2 * r.uniform<double>() - 1, 2 * r.uniform<double>() - 1, 2 * r.uniform<double>() - 1};
    if (p.squaredNorm() < 1) return p;
  }
}

} // namespace carlo
