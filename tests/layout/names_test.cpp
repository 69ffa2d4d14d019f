// Vocabulary of the sources: standard terms of the field, not the retired names.

#include "layout/source_tree.h"

#include <gtest/gtest.h>

#include <map>

namespace {

using namespace layout;

// Maps each retired name in retired_names.txt to its replacement.
std::map<std::string, std::string> retired_names() {
  std::map<std::string, std::string> names;
  for (const std::string& line : lines_of("tests/layout/retired_names.txt")) {
    const std::size_t space = line.find(' ');
    if (!line.starts_with('#') && space != std::string::npos) names[line.substr(0, space)] = line.substr(space + 1);
  }
  return names;
}

// The identifiers in a line of C++, without comments and string literals.
std::vector<std::string> identifiers(const std::string& line) {
  static const std::regex text(R"re("(?:[^"\\]|\\.)*"|//.*)re"), word(R"([A-Za-z_]\w*)");
  const std::string code = std::regex_replace(line, text, " ");
  return {std::sregex_token_iterator(code.begin(), code.end(), word), std::sregex_token_iterator()};
}

TEST(LayoutNames, IdentifiersAreFoundOutsideOfTextOnly) {
  const std::string line = "  a.b_2(\"Text \\\" x\", Word{}); // Comment";
  EXPECT_EQ(identifiers(line), (std::vector<std::string>{"a", "b_2", "Word"}));
}

// pbrt, Veach, Owen and Boost.Math define a term for nearly every concept of this project.
TEST(LayoutNames, RetiredNamesAreNotUsed) {
  const std::map<std::string, std::string> retired = retired_names();
  ASSERT_GT(retired.size(), 200u);
  const std::vector<const char*> folders = {"libmc", "librender", "tools", "python", "tests", "bench"};
  for (const fs::path& file : sources(folders)) {
    const std::vector<std::string> lines = lines_of(file);
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (const std::string& name : identifiers(lines[i]))
        if (const auto it = retired.find(name); it != retired.end())
          ADD_FAILURE() << file.string() << ":" << i + 1 << ": " << name << " is a retired name; use " << it->second
                        << ", or another standard term of the field";
  }
}

} // namespace
