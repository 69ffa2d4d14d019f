// Layout rules: permitted includes, one test per header, and READMEs that quote compiled code.

#include "layout/source_tree.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

namespace {

using namespace layout;

using Modules = std::map<std::string, std::set<std::string>>;

// The modules that each module may include, directly or transitively.
Modules closure(Modules modules) {
  for (bool grown = true; grown;) {
    grown = false;
    for (auto& [module, allowed] : modules)
      for (const std::string& next : std::set<std::string>(allowed))
        if (const auto it = modules.find(next); it != modules.end())
          for (const std::string& further : it->second) grown |= allowed.insert(further).second;
  }
  return modules;
}

const Modules allowed_includes = closure({
    {"mc/core", {}},
    {"mc/random", {"mc/core"}},
    {"mc/domain", {"mc/core"}},
    {"mc/warp", {"mc/table", "mc/domain", "mc/core"}},
    {"mc/table", {"mc/domain", "mc/core"}},
    {"mc/sampler", {"mc/random"}},
    {"mc/points", {"mc/core", "mc/random"}},
    {"mc/run", {"mc/core", "mc/random"}},
    {"mc/stats", {"mc/core"}},
    {"mc/estimate", {"mc/warp", "mc/table", "mc/sampler", "mc/stats", "mc/run"}},
    {"mc/check", {"mc/estimate", "mc/stats", "mc/table", "mc/sampler"}},
    {"mc/gtest", {"mc/check"}},
    {"render/core", {"mc/core"}},
    {"render/texture", {"render/core", "mc/warp", "mc/table"}},
    {"render/shape", {"render/core", "mc/warp", "mc/table"}},
    {"render/bsdf", {"render/texture", "render/core", "mc/warp", "mc/table"}},
    {"render/light", {"render/shape", "render/texture", "render/core", "mc/warp", "mc/table"}},
    {"render/camera", {"render/core", "mc/warp", "mc/table"}},
    {"render/accel", {"render/shape"}},
    {"render/film", {"render/core", "mc/estimate"}},
    {"render/scene", {"render/accel", "render/bsdf", "render/light", "render/camera", "render/film"}},
    {"render/integrator", {"render/scene", "mc/sampler", "mc/estimate"}},
    {"render/io", {"render/scene", "render/film"}},
    {"render", {"render/integrator", "render/scene", "render/film", "mc/sampler", "mc/estimate", "mc/run"}},
});

// Module of a path: "libmc/mc/warp/disk.h" and "mc/warp/disk.h" give "mc/warp". Files directly in render/ belong to the
// module "render".
std::string module_of(std::string path) {
  for (const std::string prefix : {"libmc/", "librender/"})
    if (path.starts_with(prefix)) path.erase(0, prefix.size());
  const std::string parent = fs::path(path).parent_path().generic_string();
  std::vector<std::string> parts;
  std::stringstream stream(parent);
  for (std::string part; std::getline(stream, part, '/');) parts.push_back(part);
  return parts.size() < 2 ? parent : parts[0] + "/" + parts[1];
}

bool is_ours(const std::string& header) { return header.starts_with("mc/") || header.starts_with("render/"); }

TEST(Layout, IncludesPointDownwards) {
  for (const char* folder : {"libmc/mc", "librender/render"}) {
    for (const Include& i : includes(folder)) {
      if (!is_ours(i.header)) continue;
      const std::string from = module_of(i.file), to = module_of(i.header);
      ASSERT_TRUE(allowed_includes.contains(from))
          << i.file << ": add its folder to allowed_includes, so that the order of includes stays defined";
      EXPECT_TRUE(from == to || allowed_includes.at(from).contains(to))
          << i.file << ":" << i.line << ": " << from << " may not include <" << i.header
          << ">: includes point downwards only, so that each folder is understood and built without those above it";
    }
  }
}

TEST(Layout, LibrariesNeverIncludeTestsBenchOrTools) {
  for (const char* folder : {"libmc/mc", "librender/render"})
    for (const Include& i : includes(folder))
      EXPECT_TRUE(!i.header.starts_with("tests/") && !i.header.starts_with("tools/") &&
                  !i.header.starts_with("bench/") && !i.header.starts_with("support/"))
          << i.file << ":" << i.line << ": <" << i.header << "> is not installed with the libraries";
}

// A third-party library that is slow to compile or easy to replace is included by one .cpp file of each of our
// libraries that needs it.
TEST(Layout, EachThirdPartyLibraryIsIncludedByOneFile) {
  const std::map<std::string, std::string> doors = {{"CLI/", "CLI11"},
                                                    {"pugixml.hpp", "pugixml"},
                                                    {"OpenEXR/", "OpenEXR"},
                                                    {"Imf", "OpenEXR"},
                                                    {"turbojpeg.h", "libjpeg-turbo"},
                                                    {"png.h", "libpng"},
                                                    {"muParser", "muparser"},
                                                    {"zlib.h", "zlib"}};
  std::map<std::string, std::set<std::string>> users;
  for (const char* folder : {"libmc/mc", "librender/render", "tools"})
    for (const Include& i : includes(folder))
      for (const auto& [prefix, library] : doors)
        if (i.header.starts_with(prefix)) users[fmt::format("{} in {}", library, folder)].insert(i.file);
  for (const auto& [library, files] : users)
    EXPECT_LE(files.size(), 1u) << library << " is included by " << *files.begin() << " and " << *files.rbegin()
                                << ": one file keeps compile times low and the library replaceable";
}

TEST(Layout, EveryPublicHeaderHasATest) {
  for (const std::string base : {"libmc", "librender"}) {
    const fs::path inner = base == "libmc" ? "libmc/mc" : "librender/render";
    for (const fs::path& file : sources(inner)) {
      if (file.extension() != ".h" || file.filename() == "concept.h" || file.filename() == "types.h") continue;
      const fs::path relative = fs::relative(file, base);
      const fs::path test = root / "tests" / relative.parent_path() / (relative.stem().string() + "_test.cpp");
      EXPECT_TRUE(fs::exists(test)) << file << " has no " << fs::relative(test, root)
                                    << ": tests are found by the path of the header";
    }
  }
}

TEST(Layout, TopLevelHasOnlyKnownEntries) {
  const std::set<std::string> known = {"CMakeLists.txt",
                                       "CMakePresets.json",
                                       "README.md",
                                       "LICENSE",
                                       "libmc",
                                       "librender",
                                       "tools",
                                       "python",
                                       "tests",
                                       "bench",
                                       "examples",
                                       "notebooks-data",
                                       "build",
                                       "out",
                                       "docs",
                                       "CHANGELOG.md",
                                       "CONTRIBUTING.md",
                                       "CITATION.cff",
                                       "Containerfile",
                                       "pyproject.toml",
                                       "setup.py",
                                       "_skbuild"};
  for (const auto& entry : fs::directory_iterator(root)) {
    const std::string file = entry.path().filename().string();
    EXPECT_TRUE(file.starts_with(".") || known.contains(file))
        << file << ": list a new top-level entry here and in docs/architecture.md";
  }
}

// A consumer compiles with its own flags. No installed header branches on the instruction set, or includes a header
// that does. Such headers are not installed either.
TEST(Layout, InstalledHeadersDoNotDependOnInstructionSet) {
  static const std::regex branch(R"(__(AVX|SSE|GFNI|BMI|FMA|ARM)|immintrin|_mm\d*_)"),
      excluded(R"re(PATTERN "([\w.]+)" EXCLUDE)re");
  const std::string cmake = text_of("librender/CMakeLists.txt");
  std::set<std::string> not_installed;
  for (std::sregex_iterator match(cmake.begin(), cmake.end(), excluded), end; match != end; ++match)
    not_installed.insert((*match)[1]);
  EXPECT_FALSE(not_installed.empty());
  for (const char* folder : {"libmc/mc", "librender/render"}) {
    for (const fs::path& file : sources(fs::path(folder))) {
      if (file.extension() != ".h" || not_installed.contains(file.filename().string())) continue;
      EXPECT_FALSE(std::regex_search(text_of(file), branch)) << file;
    }
    for (const Include& i : includes(folder)) {
      if (!i.file.ends_with(".h") || not_installed.contains(fs::path(i.file).filename().string())) continue;
      EXPECT_FALSE(is_ours(i.header) && not_installed.contains(fs::path(i.header).filename().string()))
          << i.file << ":" << i.line << ": <" << i.header << "> is not installed";
    }
  }
}

// The test and the plugin in the READMEs are the files that the consumer compiles and runs against the installed
// package.
TEST(Layout, ReadmeExamplesAreCompiled) {
  EXPECT_NE(text_of("README.md").find("```cpp\n" + text_of("tests/consumer/my_test.cpp") + "```"), std::string::npos)
      << "README.md: the test is not tests/consumer/my_test.cpp";
  EXPECT_NE(text_of("tools/plugin/README.md").find("```c\n" + text_of("examples/plugin-c/mine.c") + "```"),
            std::string::npos)
      << "tools/plugin/README.md: the plugin is not examples/plugin-c/mine.c";
}

// Links to files of the project lead to existing files.
TEST(Layout, ReadmeLinksExist) {
  static const std::regex link(R"(\]\(([\w./-]+)\))");
  std::vector<fs::path> files = {"README.md",
                                 "libmc/README.md",
                                 "librender/scenes/README.md",
                                 "librender/scenes/GALLERY.md",
                                 "notebooks-data/README.md",
                                 "python/README.md",
                                 "examples/README.md",
                                 "examples/bsdf/README.md",
                                 "examples/integrand/README.md",
                                 "examples/light/README.md",
                                 "examples/plugin-fortran/README.md",
                                 "examples/plugin-rust/README.md",
                                 "examples/program-python/README.md",
                                 "examples/batch-job/README.md",
                                 "tests/references/README.md",
                                 "tests/refs/README.md",
                                 "tools/input/README.md",
                                 "tools/plugin/README.md",
                                 "tools/report/README.md",
                                 "CHANGELOG.md",
                                 "CONTRIBUTING.md"};
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") files.push_back(fs::relative(entry.path(), root));
  for (const fs::path& file : files) {
    const std::string text = text_of(file);
    for (std::sregex_iterator match(text.begin(), text.end(), link), end; match != end; ++match)
      EXPECT_TRUE(fs::exists(root / file.parent_path() / (*match)[1].str()))
          << file << ": no such file: " << (*match)[1];
  }
}

// The README is for the first ten minutes of a new user, on GitHub and in a terminal. Details belong to docs/.
TEST(Layout, ReadmeHasAtMost900WordsInShortLines) {
  std::stringstream text(text_of("README.md"));
  const auto words = std::distance(std::istream_iterator<std::string>(text), std::istream_iterator<std::string>());
  EXPECT_LE(words, 900) << "README.md is for the first ten minutes: move details to docs/";
  for (const std::string& line : lines_of("README.md")) EXPECT_LE(columns(line), 120u) << "README.md: " << line;
}

} // namespace
