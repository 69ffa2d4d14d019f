#include <mc/check/laws.h>

#include <mc/domain/disk.h>
#include <mc/domain/interval.h>
#include <mc/warp/hemisphere.h>

#include <Eigen/Geometry>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using mc::Fault;

constexpr mc::LawOptions cheap_options() { return {}; }

mc::LawOptions cheap() {
  mc::LawOptions o = cheap_options();
  o.statistics.samples = 20'000;
  o.points = 64;
  return o;
}

// Density 2 x on [0,1]; each `Bug` breaks one law.
enum class Bug { none, pdf_scale, invert, edge, precision };
template <class S, Bug bug> struct Ramp {
  using Scalar = S;
  using Domain = mc::Interval<S>;
  Domain domain() const { return {}; }
  S sample(S u) const {
    using std::sqrt;
    const S v = S(1) - u; // in (0, 1]
    S x = S(sqrt(v));
    if constexpr (bug == Bug::precision && std::floating_point<S>)
      x = x * (1 + 100 * std::numeric_limits<S>::epsilon()) < 1 ? x * (1 + 100 * std::numeric_limits<S>::epsilon()) : x;
    if constexpr (bug == Bug::edge) return u == 0 ? S(2) : x;
    return x;
  }
  S pdf(S x) const {
    if (!(x >= 0 && x <= 1)) return S(0);
    return S(bug == Bug::pdf_scale ? 2.001 : 2) * x;
  }
  S invert(S x) const { return S(1) - (bug == Bug::invert ? S(x * x * x) : S(x * x)); }
  template <mc::Real T> Ramp<T, bug> cast() const { return {}; }
};

template <class W> mc::Report laws(const W& w) { return check_laws(w, cheap()); }

TEST(Laws, CorrectWarp_Passes) {
  EXPECT_TRUE(laws(Ramp<float, Bug::none>{}).passed()) << laws(Ramp<float, Bug::none>{}).to_string();
  EXPECT_TRUE(laws(Ramp<double, Bug::none>{}).passed()) << laws(Ramp<double, Bug::none>{}).to_string();
  EXPECT_TRUE(laws(mc::UniformHemisphere<float>{}).passed());
}

TEST(Laws, EachBug_BreaksItsOwnLaw) {
  const auto broken = [](const mc::Report& r, const std::string& law) {
    for (const mc::Check& c : r.checks)
      if (c.name.find(law) != std::string::npos && c.verdict == mc::Verdict::fail) return true;
    return false;
  };
  EXPECT_TRUE(broken(laws(Ramp<double, Bug::pdf_scale>{}), "|det| pdf = 1"));
  EXPECT_TRUE(broken(laws(Ramp<double, Bug::pdf_scale>{}), "mass"));
  EXPECT_TRUE(broken(laws(Ramp<double, Bug::invert>{}), "invert"));
  EXPECT_TRUE(broken(laws(Ramp<double, Bug::edge>{}), "single u"));
  EXPECT_TRUE(broken(laws(Ramp<double, Bug::precision>{}), "sample against 50 digits"));
  EXPECT_TRUE(broken(laws(Ramp<float, Bug::precision>{}), "sample against 50 digits"));
}

TEST(Laws, Witness_IsPrintedInFullPrecision) {
  EXPECT_THAT(laws(Ramp<double, Bug::edge>{}).to_string(),
              testing::HasSubstr("sample is outside the domain, at u = 0, x = 2"));
}

// A struct with only sample and pdf.
struct OwnDisk {
  using Domain = mc::Disk<double>;
  double stretch = 1;
  Domain domain() const { return {}; }
  mc::Vec2<double> sample(const mc::Vec2<double>& u) const {
    const double r = std::sqrt(u[0]), phi = 2 * mc::pi<double> * u[1];
    return {r * std::cos(phi), r * std::sin(phi)};
  }
  double pdf(const mc::Vec2<double>& p) const { return p.norm() <= 1 ? stretch / mc::pi<double> : 0; }
};

TEST(Laws, StructOfSampleAndPdf_IsChecked) {
  EXPECT_TRUE(laws(OwnDisk{}).passed()) << laws(OwnDisk{}).to_string();
  EXPECT_EQ(laws(OwnDisk{1.001}).fault(), Fault::mass);
}

TEST(Laws, FunctionsOnDomain_AreChecked) {
  const auto sample = [](double u) { return std::sqrt(u); };
  const auto check = [&](auto pdf) { return mc::check_laws(mc::Interval<double>(0, 1), sample, pdf, cheap()); };
  // The density is 0 at the image of u = 0.
  const mc::Report r = check([](double x) { return 2 * x; });
  ASSERT_TRUE(r.passed() && r.warning()) << r.to_string();
  EXPECT_EQ(r.warning()->fault, Fault::measure_zero);
  EXPECT_TRUE(mc::check_laws(
                  mc::Interval<double>(0, 1), [](double u) { return std::sqrt(1 - u); }, [](double x) { return 2 * x; },
                  cheap())
                  .passed());
  EXPECT_EQ(check([](double) { return 1.0; }).verdict(), mc::Verdict::fail);
}

TEST(Laws, OptionalSample_MayFailAtStatedRate) {
  const auto sample = [](double u) -> std::optional<double> {
    if (u < 0.25) return {};
    return u;
  };
  const auto pdf = [](double x) { return x < 0.25 ? 0.0 : 1.0; };
  EXPECT_TRUE(mc::check_laws(mc::Interval<double>(0, 1), sample, pdf, cheap()).passed());
  EXPECT_EQ(mc::check_laws(
                mc::Interval<double>(0, 1), sample, [](double x) { return x < 0.25 ? 0.0 : 4.0 / 3; }, cheap())
                .fault(),
            Fault::failure);
}

// A branch at u = 0.7 that leaves the domain at a single number.
struct Branching {
  using Domain = mc::Interval<double>;
  bool bug;
  Domain domain() const { return {0, 2}; }
  double sample(double u) const {
    if (u < 0.7) return u;
    return bug && u == 0.7 ? -1 : u + 1;
  }
  double pdf(double x) const { return (x >= 0 && x < 0.7) || (x >= 1.7 && x <= 2) ? 1 : 0; }
};

TEST(Laws, NeighboursOfBranch_AreTested) {
  EXPECT_TRUE(laws(Branching{false}).passed()) << laws(Branching{false}).to_string();
  EXPECT_THAT(laws(Branching{true}).to_string(),
              testing::HasSubstr("sample is outside the domain, at u = 0.69999999999999996"));
}

// A cosine lobe about an axis other than the chart's: points of the rim are rounded to either side.
template <class S> struct TiltedCosine {
  using Scalar = S;
  using Domain = mc::Sphere<S>;
  mc::Vec3<S> n{S(0.3), S(-0.5), S(0.8)};
  Domain domain() const { return {}; }
  mc::Vec3<S> normal() const { return n / std::sqrt(n.dot(n)); }
  mc::Vec3<S> sample(const mc::Vec2<S>& u) const {
    const S r = std::sqrt(u[0]), phi = 2 * mc::pi<S> * u[1], z = std::sqrt(std::max(S(0), 1 - u[0]));
    const mc::Vec3<S> s = normal().unitOrthogonal(), t = normal().cross(s);
    return r * std::cos(phi) * s + r * std::sin(phi) * t + z * normal();
  }
  S pdf(const mc::Vec3<S>& w) const { return std::max(S(0), w.dot(normal())) / mc::pi<S>; }
};

TEST(Laws, PointsRoundedOverDensityEdge_AreMeasureZero) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    mc::LawOptions o = cheap();
    o.statistics.seed = seed;
    o.statistics.open_interval = true;
    o.statistics.alpha = 1e-4; // for each of 40 reports
    EXPECT_TRUE(check_laws(TiltedCosine<double>{}, o).passed()) << seed;
    EXPECT_TRUE(check_laws(TiltedCosine<float>{}, o).passed()) << seed;
  }
}

TEST(Laws, NoSamples_SkipsStatisticalTests) {
  mc::LawOptions o = cheap();
  o.statistics.samples = 0;
  const mc::Report r = check_laws(mc::CosineHemisphere<double>{}, o);
  EXPECT_TRUE(r.passed());
  EXPECT_EQ(r.checks.size(), 11u);
}

TEST(Laws, LawsThatCannotBeTried_AreListed) {
  struct Bare {
    using Domain = mc::Interval<double>;
    Domain domain() const { return {}; }
    double sample(double u) const { return u; }
    double pdf(double) const { return 1; }
  };
  EXPECT_EQ(check_laws(Bare{}, cheap()).untried_text(),
            "not tried: batch consistency (sample takes one u at a time), pdf > 0 where eval > 0 (no eval), "
            "invert(sample(u)) = u (no invert), |det| pdf = 1 (needs invert, as many u as dimensions, and double or 50 "
            "digits), float and double against 50 digits (no cast to 50 digits), weight = f / pdf (a sample states no "
            "weight and no pdf)");
}

// A sampler of a varying number of random numbers, right and wrong.
TEST(Laws, RejectionSampler_NeedsNoU) {
  const auto disk = [](double radius) {
    return mc::make_distribution(
        "disk", mc::Disk<double>{},
        [radius](mc::Pcg& random) {
          for (;;) {
            const double x = 2 * random.uniform<double>() - 1, y = 2 * random.uniform<double>() - 1;
            if (x * x + y * y <= radius * radius) return mc::Vec2<double>(x, y);
          }
        },
        [](const mc::Vec2<double>&) { return 1 / mc::pi<double>; });
  };
  const mc::Report right = check_laws(disk(1), cheap());
  EXPECT_TRUE(right.passed()) << right.to_string();
  EXPECT_THAT(right.untried_text(), testing::HasSubstr("boundary and branches of u (sample takes no u)"));
  EXPECT_FALSE(check_laws(disk(0.99), cheap()).passed());
}

// x^(n - 1) n, which is right for every n, and for n < 8 only.
TEST(Laws, RandomParameters_FindTheWrongMember) {
  const auto family = [](double right_below) {
    return [=](mc::Pcg& random) {
      const double n = 1 + 9 * random.uniform<double>(), claimed = n < right_below ? n : 1.1 * n;
      return mc::make_distribution(
          fmt::format("power {:.3g}", n), mc::Interval<double>(0, 1), [n](double u) { return std::pow(u, 1 / n); },
          [claimed](double x) { return claimed * std::pow(x, claimed - 1); });
    };
  };
  const mc::LawOptions options{.statistics = {.samples = 20'000}};
  EXPECT_TRUE(mc::check_random_parameters(20, family(10), options).passed());
  const mc::Report wrong = mc::check_random_parameters(20, family(8), options);
  EXPECT_EQ(wrong.verdict(), mc::Verdict::fail);
  EXPECT_THAT(wrong.subject, testing::AnyOf(testing::StartsWith("power 8"), testing::StartsWith("power 9")));
}

} // namespace
