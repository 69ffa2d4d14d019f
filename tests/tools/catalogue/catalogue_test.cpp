// Every distribution of the two libraries is in the catalogue, and every case obeys its laws.

#include <catalogue/catalogue.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// The types in a folder's headers that declare all of the members in their own body.
std::set<std::string> types_with(const fs::path& folder, const std::vector<std::string>& members) {
  static const std::regex declaration(
      R"((?:^|\n)(?:template <[^\n]*>\s*\n?)?(?:  requires[^\n]*\n)?(?:struct|class) (\w+)[^;{\n]*\{)");
  std::set<std::string> types;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".h" || entry.path().filename() == "concept.h") continue;
    const std::string text = text_of(entry.path());
    for (auto it = std::sregex_iterator(text.begin(), text.end(), declaration); it != std::sregex_iterator(); ++it) {
      const std::size_t start = static_cast<std::size_t>(it->position() + it->length());
      const std::string body = text.substr(start, text.find("\n}", start) - start);
      bool all = true;
      for (const std::string& member : members)
        all = all && std::regex_search(body, std::regex("[ >&]" + member + R"(\()"));
      if (all) types.insert((*it)[1]);
    }
  }
  return types;
}

// The alternatives of a closed set: struct Bsdf : std::variant<Lambert, RoughPlastic<LayeredBase>, ...>.
std::set<std::string> members_of(const fs::path& header) {
  const std::string text = text_of(header);
  std::smatch list;
  std::set<std::string> types;
  if (!std::regex_search(text, list, std::regex(R"(: std::variant<((?:[^<>]|<[^<>]*>)*)>)"))) return types;
  const std::string names = list[1].str();
  static const std::regex whole_name(R"(\w+(<[^<>]*>)?)");
  for (auto it = std::sregex_iterator(names.begin(), names.end(), whole_name); it != std::sregex_iterator(); ++it)
    types.insert(it->str().ends_with("<>") ? it->str().substr(0, it->length() - 2) : it->str());
  return types;
}

// Names of a case in a closed set: its own name, or the template name with the first parameters of the case.
std::set<std::string> names_of(const carlo::Case& c) {
  const std::size_t first = c.parameters.find(','), second = c.parameters.find(',', first + 1);
  return {c.name, c.name + "<" + c.parameters.substr(0, first) + ">",
          c.name + "<" + c.parameters.substr(0, second) + ">"};
}

TEST(Catalogue, EveryDistribution_IsListed) {
  std::set<std::string> known;
  for (const carlo::Case& c : carlo::catalogue()) known.merge(names_of(c));
  const fs::path root = MC_SOURCE_DIR;
  std::set<std::string> found;
  for (const char* folder : {"libmc/mc/warp", "libmc/mc/table"})
    for (const std::vector<std::string>& members : {std::vector<std::string>{"sample", "pdf"}, {"sample_index", "pmf"}})
      found.merge(types_with(root / folder, members));
  for (const char* closed_set : {"bsdf/bsdf.h", "film/filter.h", "light/light.h", "shape/shape.h"})
    found.merge(members_of(root / "librender/render" / closed_set));
  found.merge(types_with(root / "librender/render/camera", {"ray"}));
  found.merge(types_with(root / "librender/render/light", {"sample_index", "pmf"}));
  for (const char* type : {"Tent", "AliasTable", "Lambert", "RoughPlastic<LajollaBase>", "Sphere", "TriangleMesh",
                           "BoxFilter", "ThinLens", "AreaLight", "LightSampler"})
    EXPECT_TRUE(found.contains(type)) << "the scan of the headers misses " << type;
  for (const std::string& type : found)
    EXPECT_TRUE(known.contains(type)) << type << " is in no file of tools/catalogue";
}

TEST(Catalogue, Titles_AreUnique) {
  std::set<std::string> titles;
  for (const carlo::Case& c : carlo::catalogue()) EXPECT_TRUE(titles.insert(c.title()).second) << c.title();
}

// With 20000 samples the deterministic laws have full strength and the counts a coarse one; `carlo validate --all` runs
// them at 1e6. Alpha is 1e-6 for each case: the seeds are fixed and some five hundred cases must pass.
class CatalogueTest : public testing::TestWithParam<carlo::Case> {};

TEST_P(CatalogueTest, ObeysLaws) {
  const mc::Report report = GetParam().check({.samples = 20'000, .seed = 7, .alpha = 1e-6});
  EXPECT_TRUE(report.passed()) << report.to_string();
}

INSTANTIATE_TEST_SUITE_P(All, CatalogueTest, testing::ValuesIn(carlo::catalogue()), [](const auto& one) {
  std::string name = one.param.title();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char ch) { return std::isalnum(ch) == 0; }, '_');
  return name;
});

} // namespace

namespace carlo {
// Otherwise GoogleTest prints the bytes of a parameter.
void PrintTo(const Case& c, std::ostream* out) { *out << c.title(); }
} // namespace carlo
