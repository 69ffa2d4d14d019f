#include <mc/check/bsdf_laws.h>

#include <mc/core/error.h>
#include <mc/core/frame.h>
#include <mc/warp/hemisphere.h>
#include <mc/warp/henyey_greenstein.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

namespace {

using V = mc::Vec3<double>;
using Color = Eigen::Array3d;
using mc::Fault;

enum class Bug {
  none,
  weight,
  cosine,
  energy,
  grazing_energy,
  reciprocity,
  negative,
  support,
  mirror_reciprocity,
  mirror_probability
};

struct Sample {
  V wi;
  Color f;
  double pdf;
  bool delta, transmission;
};

// A mixture of a Lambertian lobe of albedo 0.5 and a perfect mirror that is sampled with probability `mirror`.
struct Coated {
  Bug bug = Bug::none;
  double mirror = 0;

  Color eval(const V& wo, const V& wi) const {
    if (!(wo.z() > 0 && wi.z() > 0) || mirror == 1) return Color::Zero();
    double f = 0.5 / mc::pi<double>;
    if (bug == Bug::energy) f *= 2.2;
    if (bug == Bug::grazing_energy && wo.z() < 0.2) f *= 2.2;
    if (bug == Bug::reciprocity) f *= 0.5 + wo.z();
    if (bug == Bug::negative) f -= 0.1 * (wi.x() > 0.9);
    if (bug == Bug::negative && wi.x() > 0.9) f = -f;
    return Color::Constant(f);
  }
  double pdf(const V& wo, const V& wi) const {
    if (bug == Bug::support && wi.x() > 0.5) return 0;
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    return (1 - mirror) * (bug == Bug::cosine ? 1 / (2 * mc::pi<double>) : wi.z() / mc::pi<double>);
  }
  std::optional<Sample> sample(const V& wo, double uc, const mc::Vec2<double>& u) const {
    if (uc < mirror)
      return Sample{V(-wo.x(), -wo.y(), wo.z()),
                    Color::Constant((bug == Bug::mirror_reciprocity && wo.x() > 0 ? 0.5 : 0.2) * mirror / wo.z()),
                    bug == Bug::mirror_probability ? uc : mirror, true, false};
    const V wi = mc::CosineHemisphere<double>{}.sample(u);
    return Sample{wi, (bug == Bug::weight ? 1.01 : 1.0) * eval(wo, wi), pdf(wo, wi), false, false};
  }
};

mc::Report check(Coated b) { return mc::check_bsdf<double>(b, V(0.6, 0, 0.8), {.statistics = {.samples = 50'000}}); }

TEST(BsdfLaws, CorrectBsdf_PassesWithAndWithoutDeltaLobe) {
  EXPECT_TRUE(check({}).passed()) << check({}).to_string();
  EXPECT_TRUE(check({Bug::none, 0.3}).passed()) << check({Bug::none, 0.3}).to_string();
  EXPECT_TRUE(check({Bug::none, 1}).passed()) << check({Bug::none, 1}).to_string();
}

TEST(BsdfLaws, EachBug_IsNamed) {
  EXPECT_EQ(check({Bug::weight}).fault(), Fault::weight);
  EXPECT_EQ(check({Bug::energy}).fault(), Fault::physics);
  EXPECT_EQ(check({Bug::reciprocity}).fault(), Fault::physics);
  EXPECT_EQ(check({Bug::negative}).fault(), Fault::physics);
  EXPECT_EQ(check({Bug::cosine}).fault(), Fault::shape) << "though its white furnace is too bright";
  EXPECT_EQ(check({Bug::mirror_probability, 0.3}).fault(), Fault::weight);
}

bool broken(const mc::Report& r, const std::string& law) {
  return std::any_of(r.checks.begin(), r.checks.end(),
                     [&](const mc::Check& c) { return c.name == law && c.verdict == mc::Verdict::fail; });
}

TEST(BsdfLaws, SupportEnergyAndDeltaReciprocity_Fail) {
  EXPECT_TRUE(broken(check({Bug::support}), "pdf > 0 where f > 0"));
  EXPECT_TRUE(broken(check({Bug::grazing_energy}), "energy <= 1"));
  EXPECT_TRUE(broken(check({Bug::mirror_reciprocity, 0.3}), "reciprocity of delta lobes"));
}

TEST(BsdfLaws, NanAtTheEndsOfU_Fails) {
  struct AtEnd : Coated {
    double end;
    std::optional<Sample> sample(const V& wo, double uc, const mc::Vec2<double>& u) const {
      std::optional<Sample> s = Coated::sample(wo, uc, u);
      if (u[0] == end) s->wi.x() = NAN;
      return s;
    }
  };
  const auto checked = [](double end, bool open_interval) {
    return mc::check_bsdf<double>(AtEnd{{}, end}, V(0.6, 0, 0.8),
                                  {.statistics = {.samples = 50'000, .open_interval = open_interval}});
  };
  EXPECT_TRUE(broken(checked(0, false), "single u of measure zero"));
  EXPECT_TRUE(checked(0, true).passed());
  EXPECT_TRUE(broken(checked(1 - 0x1p-53, true), "boundary and branches of u"));
}

TEST(BsdfLaws, PdfZeroWhereFIsPositive_Fails) {
  // Half of the reflected light is never sampled.
  struct Half : Coated {
    double pdf(const V& wo, const V& wi) const { return wi.x() > 0 ? 2 * Coated::pdf(wo, wi) : 0; }
    std::optional<Sample> sample(const V& wo, double uc, const mc::Vec2<double>& u) const {
      auto s = Coated::sample(wo, uc, u);
      s->wi.x() = std::abs(s->wi.x());
      s->pdf = pdf(wo, s->wi);
      return s;
    }
  };
  const mc::Report r = mc::check_bsdf<double>(Half{}, V(0.6, 0, 0.8), {.statistics = {.samples = 50'000}});
  EXPECT_EQ(r.fault(), Fault::support) << r.to_string();
}

// Four wavelengths; faults affect only the last one.
struct FourWavelengths {
  using Spectrum = Eigen::Array4d;
  double last = 0.5, mirror_back = 0.2;
  bool mirror = false;

  struct Sample {
    V wi;
    Spectrum f;
    double pdf;
    bool delta;
  };
  Spectrum eval(const V& wo, const V& wi) const {
    if (mirror || !(wo.z() > 0 && wi.z() > 0)) return Spectrum::Zero();
    return Spectrum(0.5, 0.5, 0.5, last) / mc::pi<double>;
  }
  double pdf(const V& wo, const V& wi) const {
    return !mirror && wo.z() > 0 && wi.z() > 0 ? wi.z() / mc::pi<double> : 0;
  }
  std::optional<Sample> sample(const V& wo, const mc::Vec2<double>& u) const {
    if (mirror)
      return Sample{V(-wo.x(), -wo.y(), wo.z()), Spectrum(0.2, 0.2, 0.2, wo.x() > 0 ? 0.2 : mirror_back) / wo.z(), 1,
                    true};
    const V wi = mc::CosineHemisphere<double>{}.sample(u);
    return Sample{wi, eval(wo, wi), pdf(wo, wi), false};
  }
};

TEST(BsdfLaws, WrongSingleChannel_Fails) {
  const auto of = [](const FourWavelengths& b) {
    return mc::check_bsdf<double>(b, V(0.6, 0, 0.8), {.statistics = {.samples = 20'000}});
  };
  EXPECT_TRUE(of({}).passed()) << of({}).to_string();
  EXPECT_TRUE(of({.mirror = true}).passed()) << of({.mirror = true}).to_string();
  EXPECT_TRUE(broken(of({.last = 2}), "energy <= 1"));
  EXPECT_TRUE(broken(of({.mirror_back = 0.5, .mirror = true}), "reciprocity of delta lobes"));
}

TEST(BsdfLaws, WhiteFurnace_IsReported) {
  const mc::Report r = check({Bug::none, 0.3});
  ASSERT_EQ(r.figures.size(), 2u);
  EXPECT_NEAR(r.figures[0].value, 0.5 + 0.2 * 0.3, 5 * r.figures[0].std_error + 1e-12);
  EXPECT_GE(r.figures[1].value, r.figures[0].value - 5 * r.figures[0].std_error);
}

TEST(BsdfLaws, Witness_NamesRandomNumbers) {
  EXPECT_THAT(check({Bug::weight}).to_string(),
              testing::ContainsRegex("fail: f is 0.16.*, should be 0.159.*, at u = \\(0"));
}

// Glass of index 1.5 with Schlick's weights, with or without the squared index on refraction.
struct Glass {
  bool squared = true;
  struct Sample {
    V wi;
    double f, pdf;
    bool delta, transmission;
  };
  double eval(const V&, const V&) const { return 0; }
  double pdf(const V&, const V&) const { return 0; }
  std::optional<Sample> sample(const V& wo, double uc, const mc::Vec2<double>&) const {
    const double ratio = wo.z() > 0 ? 1.5 : 1 / 1.5, sin2 = (1 - wo.z() * wo.z()) / (ratio * ratio);
    const double cos_t = std::sqrt(std::max(1 - sin2, 0.0)), outer = wo.z() > 0 ? wo.z() : cos_t;
    const double r = sin2 < 1 ? 0.04 + 0.96 * std::pow(1 - outer, 5) : 1;
    if (uc < r) return Sample{V(-wo.x(), -wo.y(), wo.z()), r / std::abs(wo.z()), r, true, false};
    const V wi(-wo.x() / ratio, -wo.y() / ratio, wo.z() > 0 ? -cos_t : cos_t);
    return Sample{wi, (1 - r) / cos_t / (squared ? ratio * ratio : 1), 1 - r, true, true};
  }
};

TEST(BsdfLaws, Refraction_ReciprocityUsesSquaredIndex) {
  for (const V& wo : {V(0.6, 0, 0.8), V(0.3, 0, -std::sqrt(0.91))}) {
    const auto check = [&](Glass g) {
      return mc::check_bsdf<double>(g, wo, {.statistics = {.samples = 20'000}, .eta = 1.5, .lossless = true});
    };
    EXPECT_TRUE(check({}).passed()) << check({}).to_string();
    EXPECT_TRUE(broken(check({false}), "reciprocity of delta lobes"));
    EXPECT_TRUE(broken(check({false}), "energy <= 1"));
  }
}

// A phase function: no cosine, a weight instead of f, one channel.
struct Phase {
  double bug = 1;
  struct Sample {
    V wi;
    double pdf, weight;
  };
  mc::HenyeyGreenstein<double> lobe{0.6};
  static V about(const V& w, const V& local) { return mc::Frame<double>::from_z(w).to_world(local); }
  double eval(const V& wo, const V& wi) const { return pdf(wo, wi); }
  double pdf(const V& wo, const V& wi) const { return lobe.pdf(mc::Frame<double>::from_z(wo).to_local(wi)); }
  std::optional<Sample> sample(const V& wo, const mc::Vec2<double>& u) const {
    const V wi = about(wo, lobe.sample(u));
    return Sample{wi, pdf(wo, wi), bug};
  }
};

TEST(BsdfLaws, PhaseFunction_Passes) {
  const mc::BsdfOptions options{.statistics = {.samples = 50'000}, .cosine = false, .lossless = true};
  const mc::Report r = mc::check_bsdf<double>(Phase{}, V(0.6, 0, 0.8), options);
  EXPECT_TRUE(r.passed()) << r.to_string();
  EXPECT_NEAR(r.figures[0].value, 1, 1e-12);
  EXPECT_EQ(mc::check_bsdf<double>(Phase{1.01}, V(0.6, 0, 0.8), options).fault(), Fault::weight);
}

// A symmetric lobe about wo that is nearly 0 at the horizon: its value is reciprocal as it is.
struct NarrowPhase : Phase {
  double eval(const V& wo, const V& wi) const { return std::exp(80 * (wo.dot(wi) - 1)); }
};

TEST(BsdfLaws, NarrowPhaseFunction_IsReciprocal) {
  const mc::BsdfOptions options{.statistics = {.samples = 20'000}, .cosine = false};
  const mc::Report r = mc::check_bsdf<double>(NarrowPhase{}, V(0.6, 0, 0.8), options);
  for (const mc::Check& c : r.checks)
    if (c.name == "reciprocity") {
      EXPECT_EQ(c.verdict, mc::Verdict::pass) << c.detail;
    }
  EXPECT_TRUE(
      std::any_of(r.checks.begin(), r.checks.end(), [](const mc::Check& c) { return c.name == "reciprocity"; }));
}

// An eval that includes the cosine, with and without a nonreciprocal factor. The product of both cosines is symmetric,
// but is no reciprocal f.
struct WithCosine {
  enum class Kind { right, nonreciprocal, symmetric, glossy, nonreciprocal_glossy } kind = Kind::right;
  bool weighted = true;
  struct Sample {
    V wi;
    double pdf;
  };
  double eval(const V& wo, const V& wi) const {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    const double lobe = std::pow(std::max(0.0, wi.dot(V(-wo.x(), -wo.y(), wo.z()))), 8);
    switch (kind) {
    case Kind::right: return 0.3 * wi.z();
    case Kind::nonreciprocal: return 0.3 * wi.z() * (1 + 0.01 * wo.x());
    case Kind::symmetric: return 0.3 * wi.z() * wo.z();
    case Kind::glossy: return 0.1 * lobe * wi.z();
    case Kind::nonreciprocal_glossy: return 0.1 * lobe * wi.z() * (1 + 0.1 * wo.z());
    }
    return 0;
  }
  double pdf(const V&, const V& wi) const { return wi.z() > 0 ? wi.z() / mc::pi<double> : 0; }
  std::optional<Sample> sample(const V& wo, const mc::Vec2<double>& u) const {
    const V wi = mc::CosineHemisphere<double>{}.sample(u);
    return Sample{wi, pdf(wo, wi)};
  }
};

TEST(BsdfLaws, EvalWithCosine_IsComparedWithoutIt) {
  using Kind = WithCosine::Kind;
  for (const V& wo : {V(0.6, 0, 0.8), V(0.6, -0.8, 0), V(0, 0, 1), V(0.28, 0.96 * 0.6, 0.96 * 0.8)}) {
    const auto check = [&](Kind kind, bool cosine) {
      return mc::check_bsdf<double>(WithCosine{kind}, wo, {.statistics = {.samples = 20'000}, .cosine = cosine});
    };
    for (const Kind right : {Kind::right, Kind::glossy})
      EXPECT_TRUE(check(right, false).passed()) << check(right, false).to_string();
    if (wo.z() == 0 || wo.z() == 1) continue;
    for (const Kind wrong : {Kind::nonreciprocal, Kind::symmetric, Kind::nonreciprocal_glossy})
      EXPECT_TRUE(broken(check(wrong, false), "reciprocity")) << int(wrong) << check(wrong, false).to_string();
    EXPECT_THAT(check(Kind::right, true).to_string(),
                testing::AllOf(testing::HasSubstr("does eval include the cosine? Then set .cosine = false"),
                               testing::HasSubstr("law: reciprocity")));
  }
}

TEST(BsdfLaws, PhaseFunctionThatIsNotReciprocal_Fails) {
  struct Skewed : Phase {
    double eval(const V& wo, const V& wi) const { return pdf(wo, wi) * (1 + 0.01 * wo.z()); }
  };
  const mc::Report r =
      mc::check_bsdf<double>(Skewed{}, V(0.6, 0, 0.8), {.statistics = {.samples = 20'000}, .cosine = false});
  EXPECT_TRUE(broken(r, "reciprocity")) << r.to_string();
}

TEST(BsdfLaws, SampleWithoutValue_IsListedAsUntriedAndItsEnergyIsTested) {
  const mc::Report r =
      mc::check_bsdf<double>(WithCosine{}, V(0.6, 0, 0.8), {.statistics = {.samples = 20'000}, .cosine = false});
  EXPECT_THAT(r.to_string(mc::ReportText::full),
              testing::HasSubstr("not tried: weight = f |cos wi| / pdf (a sample states neither f nor weight)"));
  ASSERT_EQ(r.figures.size(), 2u);
  EXPECT_NEAR(r.figures[0].value, 0.3 * mc::pi<double>, 1e-9);
}

TEST(BsdfLaws, DirectionOfWrongLength_Throws) {
  for (const V& wo : {V(1, 1, 1), V(0.3, 0, 0.4), V(0, 0, 0), V(NAN, 0, 1), V(0, 0, 1.0001)})
    EXPECT_THROW(mc::check_bsdf<double>(Coated{}, wo, {.statistics = {.samples = 1000}}), mc::Error);
  EXPECT_TRUE(
      mc::check_bsdf<double>(Coated{}, V(0.577350, 0.577350, 0.577350), {.statistics = {.samples = 20'000}}).passed());
}

} // namespace
