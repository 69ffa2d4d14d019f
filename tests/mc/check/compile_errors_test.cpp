// Compiler messages for arguments that are not distributions: at most ten lines, one of which names the missing member.

#include <mc/core/file.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace {

struct WrongProgram {
  const char *name, *text, *said;

  friend void PrintTo(const WrongProgram& program, std::ostream* out) { *out << program.said; }
};

constexpr const char* bsdf_without_pdf = R"(
struct MyBsdf {
  struct Sample {
    mc::Vec3<float> wi;
    float f, pdf;
  };
  float eval(const mc::Vec3<float>&, const mc::Vec3<float>&) const { return 0; }
  std::optional<Sample> sample(const mc::Vec3<float>&, const mc::Vec2<float>&) const { return {}; }
};
const mc::Vec3<float> up(0, 0, 1);
)";

const std::string check_of_it = std::string("#include <mc/check/bsdf_laws.h>") + bsdf_without_pdf +
                                "const mc::Report report = mc::check_bsdf<float>(MyBsdf{}, up);\n";
const std::string test_of_it = std::string("#include <mc/gtest/matchers.h>") + bsdf_without_pdf +
                               "TEST(My, Bsdf) { EXPECT_BSDF_LAWS(MyBsdf{}, up); }\n";

constexpr const char* generator_in_a_warp = R"(
#include <random>
struct Mine {
  using Domain = mc::Interval<double>;
  Domain domain() const { return {}; }
  double sample(std::mt19937& g) const { return std::generate_canonical<double, 53>(g); }
  double pdf(double) const { return 1; }
};
)";

const std::string check_of_a_warp = std::string("#include <mc/check/laws.h>") + generator_in_a_warp +
                                    "const mc::Report report = mc::check_laws(Mine{});\n";
const std::string test_of_a_warp = std::string("#include <mc/gtest/matchers.h>") + generator_in_a_warp +
                                   "TEST(My, Warp) { EXPECT_WARP_LAWS(Mine{}); }\n";

constexpr const char* domain_without_const = R"(#include <mc/check/laws.h>
struct MyDomain : mc::Interval<double> {
  bool contains(double x) { return x >= 0 && x < 1; }
};
struct Mine {
  using Domain = MyDomain;
  Domain domain() const { return {}; }
  double sample(double u) const { return u; }
  double pdf(double) const { return 1; }
};
const mc::Report report = mc::check_laws(Mine{});
)";

constexpr const char* generator_in_a_lambda = R"(#include <mc/gtest/matchers.h>
#include <random>
const auto sampler = [](std::mt19937& g) { return std::generate_canonical<double, 53>(g); };
TEST(My, Sampler) { EXPECT_SAMPLES_MATCH_PDF(sampler, [](double) { return 1.0; }, mc::Interval<double>(0, 1)); }
)";

// The value of a sample under any other name than f and weight.
constexpr const char* bsdf_with_value = R"(
struct MyBsdf {
  struct Sample {
    mc::Vec3<float> wi;
    float pdf, value;
  };
  float eval(const mc::Vec3<float>&, const mc::Vec3<float>&) const { return 0; }
  float pdf(const mc::Vec3<float>&, const mc::Vec3<float>&) const { return 0; }
  std::optional<Sample> sample(const mc::Vec3<float>&, const mc::Vec2<float>&) const { return {}; }
};
const mc::Vec3<float> up(0, 0, 1);
)";

const std::string check_of_value = std::string("#include <mc/check/bsdf_laws.h>") + bsdf_with_value +
                                   "const mc::Report report = mc::check_bsdf<float>(MyBsdf{}, up);\n";
const std::string test_of_value = std::string("#include <mc/gtest/matchers.h>") + bsdf_with_value +
                                  "TEST(My, Bsdf) { EXPECT_BSDF_LAWS(MyBsdf{}, up); }\n";

class CompileErrors : public testing::TestWithParam<WrongProgram> {};

TEST_P(CompileErrors, AreShortAndNameMissingMember) {
  const std::string base = testing::TempDir() + "/wrong_" + GetParam().name, source = base + ".cpp",
                    said = base + ".txt";
  mc::write_file(source, GetParam().text);
  const std::string command = "'" MC_CXX_COMPILER "' -std=c++20 -fsyntax-only"
                              " -I'" MC_SOURCE_DIR "/libmc' $(pkg-config --cflags eigen3) '" +
                              source + "' > '" + said + "' 2>&1";
  EXPECT_NE(std::system(command.c_str()), 0) << "it compiles";
  const std::string text = mc::read_file(said);
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 10) << text;
  EXPECT_THAT(text, testing::HasSubstr(GetParam().said));
}

INSTANTIATE_TEST_SUITE_P(
    Checkers, CompileErrors,
    testing::Values(WrongProgram{"BsdfWithoutPdf", check_of_it.c_str(), "a BSDF needs pdf(wo, wi) const, a number"},
                    WrongProgram{"BsdfWithoutPdfInATest", test_of_it.c_str(), "and pdf(wo, wi), a number"},
                    WrongProgram{"GeneratorInAWarp", check_of_a_warp.c_str(), "sample(u) const must take u"},
                    WrongProgram{"GeneratorInATestOfAWarp", test_of_a_warp.c_str(),
                                 "sample(u), u of Domain::UnitPoint"},
                    WrongProgram{"BsdfWithValue", check_of_value.c_str(), "a member that is not checked"},
                    WrongProgram{"BsdfWithValueInATest", test_of_value.c_str(), "a member that is not checked"},
                    WrongProgram{"DomainWithoutConst", domain_without_const, "const from_unit, to_unit, jacobian"},
                    WrongProgram{"GeneratorInALambda", generator_in_a_lambda, "the function must take u"}),
    [](const auto& wrong) { return std::string(wrong.param.name); });

} // namespace
