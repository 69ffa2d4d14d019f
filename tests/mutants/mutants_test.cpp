// Known-wrong samplers: each must be rejected, at 1e6 samples and alpha = 1 %, by the law that its fault breaks.
// The seeds are fixed; every mutant runs with two. P1 to P36 are the slips of the books and courses.

#include "mutants/mutants.h"

#include <mc/check/check_subject.h>

#include <gtest/gtest.h>

namespace mutants {

// GoogleTest prints the bytes of a parameter otherwise.
void PrintTo(const Mutant& m, std::ostream* out) { *out << m.story; }

} // namespace mutants

namespace {

class MutantTest : public testing::TestWithParam<mutants::Mutant> {};

TEST_P(MutantTest, IsRejected) {
  for (const std::uint64_t seed : {1, 2}) {
    mc::SubjectOptions o;
    o.samples = GetParam().samples;
    o.seed = seed;
    o.alpha = 0.01;
    const mc::Report report = check_subject(GetParam().subject, o);
    EXPECT_EQ(report.verdict(), mc::Verdict::fail) << report.to_string();
    EXPECT_TRUE(mutants::same_kind(report.fault(), GetParam().fault)) << report.to_string();
  }
}

INSTANTIATE_TEST_SUITE_P(All, MutantTest, testing::ValuesIn(mutants::all()), [](const auto& mutant) { return mutants::identifier(mutant.param.subject.name); });

} // namespace
