// Laws of distributions with faults that the warps of laws_test.cpp cannot have.

#include <mc/check/laws.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace {

using mc::Fault, mc::PointArray, mc::AnyDistribution;
using testing::HasSubstr;

// Returns a distribution on the unit square with density 1 and sample(u) = point(u0, u1).
AnyDistribution on_square(const std::function<PointArray(double, double)>& point) {
  AnyDistribution s = mc::detail::distribution_on("mine", mc::Square<double>());
  s.uniforms = 2;
  s.sample = [point](const AnyDistribution::Uniforms& u) {
    AnyDistribution::Sample d;
    d.x = point(u[0], u[1]);
    return std::optional(d);
  };
  s.pdf = [](const PointArray&) { return 1.0; };
  return s;
}

std::string full(const mc::Report& report) { return report.to_string(mc::ReportText::full); }

mc::Report laws(const AnyDistribution& s, bool open_interval = false) {
  return check_laws(s, {.statistics = {.samples = 20'000, .open_interval = open_interval}});
}

TEST(Law, Determinism_FunctionOfU_Passes) {
  const mc::Report r = laws(on_square([](double a, double b) { return PointArray{a, b}; }));
  EXPECT_TRUE(r.passed()) << r.to_string();
}

TEST(Law, Determinism_SampleIgnoresU_Fails) {
  const auto random = std::make_shared<mc::Pcg>(7);
  const mc::Report r = laws(on_square([random](double, double) {
    return PointArray{random->uniform<double>(), random->uniform<double>()};
  }));
  EXPECT_EQ(r.fault(), Fault::nondeterministic) << r.to_string();
  EXPECT_THAT(full(r), HasSubstr("law: determinism of sample"));
}

TEST(Law, Determinism_SampleReturnsPreviousPoint_Fails) {
  const auto before = std::make_shared<PointArray>(PointArray{0.5, 0.5});
  const mc::Report r = laws(on_square([before](double a, double b) {
    const PointArray last = *before;
    *before = {a, b};
    return last;
  }));
  EXPECT_EQ(r.fault(), Fault::nondeterministic) << r.to_string();
}

// Every second call of a function gives a different result.
TEST(Law, Determinism_AlternatingResults_Fail) {
  const AnyDistribution right = mc::make_distribution(
      "mine", mc::Interval<double>(0, 2), [](double u) { return 2 * u; }, [](double) { return 0.5; });
  const auto calls = std::make_shared<int>(0);
  AnyDistribution sample = right, pdf = right, invert = right;
  sample.sample = [=](const AnyDistribution::Uniforms& u) {
    return right.sample(++*calls % 2 ? u : AnyDistribution::Uniforms{1 - u[0]});
  };
  EXPECT_EQ(laws(sample).fault(), Fault::nondeterministic) << laws(sample).to_string();
  // A change of one unit in the last place, which hardly changes the integral.
  pdf.pdf = [=](const PointArray&) { return ++*calls % 2 ? 0.5 : std::nextafter(0.5, 1.0); };
  EXPECT_THAT(laws(pdf).to_string(), HasSubstr("law: determinism of pdf"));
  invert.invert = [=](const PointArray& x) {
    return std::optional(AnyDistribution::Uniforms{++*calls % 2 ? x[0] / 2 : std::nextafter(x[0] / 2, 1.0)});
  };
  EXPECT_THAT(laws(invert).to_string(), HasSubstr("law: determinism of invert"));
}

// The density depends on the last sample instead of its argument.
TEST(Law, Determinism_PdfDependsOnLastSample_Fails) {
  const auto last = std::make_shared<double>(0);
  AnyDistribution s = on_square([last](double a, double b) { return PointArray{*last = a, b}; });
  s.pdf = [last](const PointArray&) { return *last < 0.5 ? 1.0 : std::nextafter(1.0, 2.0); };
  EXPECT_THAT(laws(s).to_string(), HasSubstr("law: determinism of pdf"));
}

// The law repeats pdf for a distribution that draws from a stream.
TEST(Law, Determinism_StreamWithPdf_RepeatsPdf) {
  AnyDistribution s = mc::detail::distribution_on("mine", mc::Interval<double>(0, 1));
  s.sample_stream = [](mc::Pcg& random) {
    AnyDistribution::Sample d;
    d.x[0] = random.uniform<double>();
    return std::optional(d);
  };
  s.pdf = [](const PointArray&) { return 1.0; };
  EXPECT_TRUE(laws(s).passed()) << laws(s).to_string();
  const auto calls = std::make_shared<int>(0);
  s.pdf = [calls](const PointArray&) { return ++*calls % 2 ? 1.0 : std::nextafter(1.0, 2.0); };
  EXPECT_EQ(laws(s).fault(), Fault::nondeterministic) << laws(s).to_string();
}

// Between 1e6 and 1e6 + 1 there are 15 floats: their counts depend more on rounding than on the density.
TEST(Law, Resolution_IntervalOfFewFloats_IsInconclusive) {
  const auto tried = []<class S>(S, double power) {
    const auto sample = [power](S u) { return S(1e6) + static_cast<S>(std::pow(u, power)); };
    return mc::check_laws(mc::Interval<S>(1e6, 1e6 + 1), sample, [](S) { return S(1); },
                          {.statistics = {.samples = 20'000}});
  };
  for (const double power : {1.0, 1.5}) {
    const mc::Report r = tried(1.0f, power);
    EXPECT_EQ(r.verdict(), mc::Verdict::inconclusive) << r.to_string();
    EXPECT_THAT(r.to_string(), HasSubstr("compute it in double"));
  }
  EXPECT_TRUE(tried(1.0, 1).passed()) << tried(1.0, 1).to_string();
  EXPECT_EQ(tried(1.0, 1.5).verdict(), mc::Verdict::fail);
  EXPECT_TRUE(mc::check_laws(
                  mc::Interval<float>(1e6, 1e6 + 64), [](float u) { return 1e6f + 64 * u; },
                  [](float) { return 1.0f / 64; }, {.statistics = {.samples = 20'000}})
                  .passed());
}

TEST(Law, BatchConsistency_BatchDiffersFromSingle_Fails) {
  AnyDistribution s = on_square([](double a, double b) { return PointArray{a, b}; });
  const auto many = [s](std::size_t shift, double rounded) {
    AnyDistribution batched = s;
    batched.sample_many = [=](std::span<const AnyDistribution::Uniforms> u) {
      std::vector<std::optional<AnyDistribution::Sample>> drawn;
      for (std::size_t i = 0; i < u.size(); ++i) {
        drawn.push_back(s.sample(u[(i + shift) % u.size()]));
        drawn.back()->x[0] *= rounded;
        drawn.back()->pdf = 1;
      }
      return drawn;
    };
    batched.pdf_many = [=](std::span<const PointArray> x) { return std::vector<double>(x.size(), rounded); };
    return batched;
  };
  EXPECT_TRUE(laws(many(0, 1)).passed()) << laws(many(0, 1)).to_string();
  EXPECT_THAT(full(laws(many(1, 1))), HasSubstr("batch consistency of sample"));
  const double in_float = 1 - 1e-7; // rounding of float vector code
  EXPECT_THAT(full(laws(many(0, in_float))), testing::Not(HasSubstr("batch")));
  EXPECT_THAT(full(laws(many(0, 0.99))), HasSubstr("batch consistency of pdf"));
}

// A constant point is a function of u.
TEST(Law, Determinism_ConstantSample_IsAtom) {
  const mc::Report r = laws(on_square([](double, double) { return PointArray{0.5, 0.5}; }));
  EXPECT_EQ(r.fault(), Fault::atom) << r.to_string();
  EXPECT_THAT(full(r), HasSubstr("sample depends on u"));
}

// Whether a report passes with a warning of measure zero.
bool is_warned(const mc::Report& r) { return r.passed() && r.warning() && r.warning()->fault == Fault::measure_zero; }

TEST(Law, Boundary_SampleFailsAtZeroU_IsMeasureZero) {
  const auto tried = [](bool open) {
    return mc::check_laws(
        mc::Interval<double>(0, 1), [](double u) { return std::exp(std::log(u)) / (u > 0 ? 1.0 : 0.0); },
        [](double) { return 1.0; }, {.statistics = {.samples = 20'000, .open_interval = open}});
  };
  EXPECT_EQ(tried(false).fault(), Fault::measure_zero) << tried(false).to_string();
  EXPECT_THAT(tried(false).to_string(), HasSubstr("--open-interval"));
  EXPECT_TRUE(tried(true).passed()) << tried(true).to_string();
}

// NaN and a negative pdf are no limits of a density.
TEST(Law, Boundary_PdfThatIsNoLimitAtZeroU_Fails) {
  for (const double bad : {std::nan(""), -1.0}) {
    const mc::Report r = mc::check_laws(
        mc::Interval<double>(0, 1), [](double u) { return u; }, [=](double x) { return x == 0 ? bad : 1.0; },
        {.statistics = {.samples = 20'000}});
    EXPECT_EQ(r.verdict(), mc::Verdict::fail) << bad << ": " << r.to_string();
  }
}

TEST(Law, Boundary_ZeroPdfAtZeroU_IsWarning) {
  const auto interval = [](auto sample, auto pdf, bool open) {
    return mc::check_laws(mc::Interval<double>(0, 1), sample, pdf,
                          {.statistics = {.samples = 20'000, .open_interval = open}});
  };
  const auto root = [](double u) { return std::sqrt(u); };
  const auto ramp = [](double x) { return 2 * x; };
  const mc::Report closed = interval(root, ramp, false);
  EXPECT_TRUE(is_warned(closed)) << closed.to_string();
  EXPECT_TRUE(interval(root, ramp, true).passed()) << interval(root, ramp, true).to_string();
  // A wrong density and an edge of positive measure still fail.
  EXPECT_NE(interval(
                root, [](double) { return 1.0; }, true)
                .verdict(),
            mc::Verdict::pass);
  const auto leaves = [](double u) { return u > 1 - 1e-15 ? 2.0 : u; };
  EXPECT_EQ(interval(
                leaves, [](double) { return 1.0; }, true)
                .fault(),
            Fault::boundary);
}

// The density |x|: sample is correct except at u = 1/2.
TEST(Law, Boundary_PdfZeroAtOnePoint_IsMeasureZero) {
  const auto root = [](std::floating_point auto u) {
    using S = decltype(u);
    return std::copysign(std::sqrt(std::abs(2 * u - 1)), u - S(0.5));
  };
  const auto tried = [&]<class S>(S, double gap, bool open) {
    const auto pdf = [gap](S x) { return std::abs(static_cast<double>(x)) <= gap ? S(0) : std::abs(x); };
    return mc::check_laws(mc::Interval<S>(-1, 1), root, pdf,
                          {.statistics = {.samples = 20'000, .open_interval = open}});
  };
  EXPECT_TRUE(is_warned(tried(0.0, 0, false))) << tried(0.0, 0, false).to_string();
  EXPECT_TRUE(is_warned(tried(0.0f, 0, false))) << tried(0.0f, 0, false).to_string();
  EXPECT_TRUE(tried(0.0, 0, true).passed()) << tried(0.0, 0, true).to_string();
  EXPECT_EQ(tried(0.0, 1e-7, true).fault(), Fault::boundary) << "more than one u";
  AnyDistribution open =
      mc::make_distribution("|x|", mc::Interval<double>(-1, 1), root, [](double x) { return std::abs(x); });
  open.open_interval = true;
  EXPECT_TRUE(is_warned(laws(open))) << "it says that no u is 0: that excuses no other";
}

// The arcsine density is infinite at both ends, and the last u is rounded onto the upper end.
TEST(Law, Boundary_InfinitePdfAtDomainEdge_IsMeasureZero) {
  const auto tried = [](double power, bool open) {
    const auto sine = [power](double u) { return std::pow(std::sin(mc::pi<double> / 2 * u), power); };
    const auto pdf = [](double x) { return 1 / (mc::pi<double> * std::sqrt(x * (1 - x))); };
    return mc::check_laws(mc::Interval<double>(0, 1), sine, pdf,
                          {.statistics = {.samples = 20'000, .open_interval = open}});
  };
  EXPECT_TRUE(is_warned(tried(2, false))) << tried(2, false).to_string();
  EXPECT_TRUE(tried(2, true).passed()) << tried(2, true).to_string();
  EXPECT_EQ(tried(2.2, true).fault(), Fault::shape);
}

// An inverse without an oracle: the Jacobian is tested in double.
TEST(Law, Jacobian_WithoutOracle_IsTestedInDouble) {
  const auto with = [](double bug, double inverse_bug) {
    AnyDistribution s = on_square([](double a, double b) { return PointArray{1 - std::sqrt(1 - a), b}; });
    s.pdf = [bug](const PointArray& x) { return bug * 2 * (1 - x[0]); };
    s.invert = [inverse_bug](const PointArray& x) {
      return std::optional(AnyDistribution::Uniforms{1 - (1 - x[0]) * (1 - x[0]), inverse_bug * x[1]});
    };
    return laws(s);
  };
  EXPECT_TRUE(with(1, 1).passed()) << with(1, 1).to_string();
  EXPECT_THAT(full(with(1.0001, 1)), HasSubstr("also fails: |det| pdf = 1, upper quartile"));
  EXPECT_EQ(with(1, 0.99).fault(), Fault::inverse);
}

TEST(Law, Support_IntegrandPositiveWherePdfIsZero_Fails) {
  AnyDistribution s = on_square([](double a, double b) { return PointArray{a, b}; });
  s.eval = [](const PointArray& x) { return x[0]; };
  EXPECT_TRUE(laws(s).passed());
  s.eval = [](const PointArray& x) { return x[0] - 0.5; };
  EXPECT_EQ(laws(s).fault(), Fault::physics);
  s = on_square([](double a, double b) { return PointArray{a / 2, b}; });
  s.pdf = [](const PointArray& x) { return x[0] <= 0.5 ? 2.0 : 0.0; };
  s.eval = [](const PointArray&) { return 1.0; };
  EXPECT_EQ(laws(s).fault(), Fault::support);
}

} // namespace
