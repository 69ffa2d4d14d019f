#include <mc/core/error.h>
#include <mc/core/file.h>
#include <mc/estimate/adapt/density_file.h>
#include <mc/random/uniform.h>

#include <support/files.h>

#include <gmock/gmock.h>

#include <cmath>

namespace {

mc::AdaptedDensity made(std::uint64_t seed, int dim, std::size_t leaves) {
  mc::AdaptedDensity density{mc::ImportanceGrid(dim)};
  std::vector<double> power(static_cast<std::size_t>(dim) * mc::ImportanceGrid::bins);
  for (std::size_t i = 0; i < power.size(); ++i) power[i] = std::exp(20 * mc::hash_uniform<double>(seed, i));
  for (int rounds = 0; rounds < 3; ++rounds) density.grid.refine(power, 1'000'000);
  if (leaves > 0)
    density.tree = mc::BoxTree::from_function(
        dim, [&](std::span<const double> x) { return 1e-3 + std::pow(x[0], 4) * x[x.size() - 1]; }, leaves);
  return density;
}

TEST(DensityFile, RoundTripKeepsTheBits) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const int dim = 1 + static_cast<int>(seed % 5);
    const mc::AdaptedDensity density = made(seed, dim, seed % 3 * 20);
    const mc::AdaptedDensity again = mc::density_from_text(mc::to_text(density));
    EXPECT_EQ(again.tree.has_value(), density.tree.has_value());
    for (std::uint64_t i = 0; i < 200; ++i) {
      std::vector<double> x(static_cast<std::size_t>(dim));
      for (std::size_t d = 0; d < x.size(); ++d) x[d] = mc::hash_uniform<double>(seed, i, d);
      std::vector<double> y = x;
      ASSERT_EQ(density.map(x), again.map(y));
      ASSERT_EQ(x, y);
    }
  }
}

std::string refusal(const std::string& text) {
  return support::error_of([&] { mc::density_from_text(text); });
}

// Every changed byte and every truncation must be rejected with a one-line message.
TEST(DensityFile, DamagedTextIsRejected) {
  const std::string whole = mc::to_text(made(7, 2, 10));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    const std::string said = refusal(damaged);
    EXPECT_THAT(said, testing::StartsWith("density: ")) << i;
    EXPECT_EQ(said.find('\n'), std::string::npos) << i;
    EXPECT_NE(refusal(whole.substr(0, i)), "") << i;
  }
  EXPECT_NE(refusal(whole + "\n"), "");
}

// Errors that another program may make when it writes a density; the checksum is correct.
TEST(DensityFile, ErrorsNameTheLine) {
  const auto summed = [](const std::string& body) {
    std::uint64_t h = 0xcbf29ce484222325;
    for (const char c : body) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return body + fmt::format("checksum {:016x}\n", h);
  };
  std::string axis = "axis";
  for (std::size_t i = 0; i <= mc::ImportanceGrid::bins; ++i)
    axis += fmt::format(" {}", static_cast<double>(i) / mc::ImportanceGrid::bins);
  const std::string head = "mc-density 1\ndim 1\n" + axis + "\n";
  EXPECT_EQ(refusal(summed(head + "tree 3\ncut 0 0.5\nleaf 1\nleaf 3\n")), "");
  const struct {
    std::string text, says;
  } cases[] = {{summed(head + "tree 3\ncut 0 0.5\nleaf 1\n"), "ends at line 7"},
               {summed(head + "tree 3\ncut 0 0.5\nleaf 1\nleaf 0\n"), "a leaf has the weight 0"},
               {summed(head + "tree 3\ncut 1 0.5\nleaf 1\nleaf 1\n"), "cuts axis 1 of 1"},
               {summed(head + "tree 1\nleaf x\n"), "line 5"},
               {summed(head + "tree 1\nleaf 1\nleaf 1\n"), "more behind"},
               {summed("mc-density 1\ndim 1\n" + axis + " 1\ntree 0\n"), "line 3 goes on"},
               {summed("mc-density 1\ndim 0\ntree 0\n"), "0 edges"},
               {summed("mc-density 1\ndim 1\naxis 0 1\ntree 0\n"), "line 3 has too few"},
               {summed("mc-density 2\ndim 1\n"), "another version"},
               {"P6\n", "this is no density"},
               {"", "this is no density"}};
  for (const auto& c : cases) EXPECT_THAT(refusal(c.text), testing::HasSubstr(c.says)) << c.text.substr(0, 40);
}

using DensityFiles = support::ScratchTest;
TEST_F(DensityFiles, ErrorsNameTheFile) {
  const std::string file = path("density");
  mc::save_density(file, made(1, 2, 5));
  EXPECT_EQ(mc::load_density(file).tree->leaves(), 5u);
  mc::write_file(file, "nonsense");
  EXPECT_THAT(support::error_of([&] { mc::load_density(file); }), testing::StartsWith(file));
}

} // namespace
