// Known bugs of warps. The law that a bug violates must reject it at alpha = 1 %, and the correct version must pass.
// tools/known_bugs/ describes the bugs. Seeds are fixed; each bug runs with two seeds, or with one if it needs many
// samples.

#include <known_bugs/known_bugs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace carlo {

// Without this function GoogleTest prints the bytes of a parameter.
void PrintTo(const KnownBug& s, std::ostream* out) { *out << s.title() << ", " << s.source << ": " << s.description; }

} // namespace carlo

namespace {

using carlo::KnownBug;
using mc::Fault;

// Tests of counts detect one fault at several scales. Its classification as shape, rotation, local or atom is a matter
// of degree.
bool same_kind(Fault a, Fault b) {
  const auto counted = [](Fault f) {
    return f == Fault::shape || f == Fault::rotation || f == Fault::local || f == Fault::atom;
  };
  return a == b || (counted(a) && counted(b));
}

std::string identifier(const testing::TestParamInfo<KnownBug>& bug) {
  std::string name = bug.param.title();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class MutantTest : public testing::TestWithParam<KnownBug> {};

TEST_P(MutantTest, IsRejected) {
  for (std::uint64_t seed = 1; seed <= (GetParam().samples > 4'000'000 ? 1 : 2); ++seed) {
    const mc::Report report = GetParam().wrong.check({.samples = GetParam().samples, .seed = seed, .alpha = 0.01});
    EXPECT_EQ(report.verdict(), mc::Verdict::fail) << report.to_string();
    EXPECT_TRUE(same_kind(report.fault(), GetParam().fault)) << report.to_string();
  }
}

// alpha = 0.01 % per bug: one of 150 seeds rejects some correct version by chance.
TEST_P(MutantTest, CorrectVersionPasses) {
  const std::uint64_t samples = std::min<std::uint64_t>(std::max<std::uint64_t>(GetParam().samples, 20'000), 60'000);
  const mc::Report report = GetParam().right.check({.samples = samples, .seed = 1, .alpha = 1e-4});
  EXPECT_TRUE(report.passed()) << report.to_string();
}

INSTANTIATE_TEST_SUITE_P(All, MutantTest, testing::ValuesIn(carlo::all_known_bugs()), identifier);

TEST(Mutants, EveryIdHasBugOrReason) {
  std::set<std::string> ids;
  for (const KnownBug& s : carlo::all_known_bugs()) {
    EXPECT_TRUE(ids.insert(s.id).second) << s.id;
    EXPECT_FALSE(s.source.empty() || s.description.empty() || s.name.empty()) << s.id;
  }
  // The comments at the top of known_bugs/books.cpp and known_bugs/courses.cpp explain why these have no warp.
  for (const char* none : {"P10", "P16", "P17", "P23", "P28", "P31", "P32"})
    EXPECT_TRUE(ids.insert(none).second) << none;
  for (int i = 1; i <= 36; ++i) EXPECT_TRUE(ids.contains("P" + std::to_string(i))) << i;
}

} // namespace
