// Readability rules: short files and functions, small folders, and no include cycles between folders.

#include "layout/source_tree.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace {

using namespace layout;

const std::vector<const char*> everything = {"libmc", "librender", "tools", "python", "tests", "bench"};

struct Function {
  std::size_t line, length; ///< Number of the first line, from 1, and length in lines.
};

std::size_t indent(const std::string& line) { return line.find_first_not_of(' '); }

// True for ": a(b)" after a constructor, but not for "::a b()".
bool is_initializer(const std::string& line) { return line.compare(indent(line), 2, ": ") == 0; }

// Functions of more than `longest` lines in the style of clang-format. A body ends at the first line that starts with a
// brace at the indentation of the function, or where the braces of a lambda close.
std::vector<Function> long_functions(const std::vector<std::string>& lines, std::size_t longest) {
  static const std::regex other(R"(^\s*(template.*>\s*)?(namespace|struct|class|enum|union|extern|typedef|concept)\b)");
  const auto unclosed = [](const std::string& line) {
    return std::count(line.begin(), line.end(), '(') - std::count(line.begin(), line.end(), ')');
  };
  const auto braces = [](const std::string& line) {
    return std::count(line.begin(), line.end(), '{') - std::count(line.begin(), line.end(), '}');
  };
  std::vector<Function> found;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].ends_with('{') || lines[i].find(')') == std::string::npos) continue;
    std::size_t start = i;
    auto open = unclosed(lines[i]);
    while (start > 0 && (open < 0 || is_initializer(lines[start]) || lines[start - 1].ends_with(',') ||
                         lines[start - 1].ends_with('=') || lines[start - 1].ends_with("&&")))
      open += unclosed(lines[--start]);
    std::size_t end = i + 1;
    if (open > 0) { // a lambda as an argument, which may start anywhere in its line
      start = i;
      for (auto depth = 1 + braces(lines[end]); end + 1 < lines.size() && depth > 0; depth += braces(lines[end])) ++end;
    } else {
      if (std::regex_search(lines[start], other)) continue;
      while (end < lines.size() && (lines[end].empty() || indent(lines[end]) != indent(lines[start]) ||
                                    lines[end][indent(lines[end])] != '}'))
        ++end;
    }
    if (end - start + 1 > longest) found.push_back({start + 1, end - start + 1});
  }
  return found;
}

TEST(Readability, LongFunctionsAreDetected) {
  const std::vector<std::string> lines = {"struct A {",
                                          "  A(int a,",
                                          "    int b)",
                                          "      : a_(a),",
                                          "        b_(b) {",
                                          "    if (a) {",
                                          "    }",
                                          "  }",
                                          "  int f() {",
                                          "  }",
                                          "  ::b f() {",
                                          "  }",
                                          "};",
                                          "  call(1,",
                                          "       [](int) {",
                                          "         go();",
                                          "       });",
                                          "  call(1, [](int) {",
                                          "         if (a) {",
                                          "         }",
                                          "       });",
                                          "}",
                                          "template <class T>",
                                          "concept Named = Any<T> &&",
                                          "    requires(T t) {",
                                          "  t.name();",
                                          "};"};
  const std::vector<Function> found = long_functions(lines, 2);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].line, 2u);
  EXPECT_EQ(found[0].length, 7u);
  EXPECT_EQ(found[1].line, 15u);
  EXPECT_EQ(found[1].length, 3u);
  EXPECT_EQ(found[2].line, 18u);
  EXPECT_EQ(found[2].length, 4u);
}

TEST(Readability, FunctionsHaveAtMost80Lines) {
  for (const fs::path& file : sources(everything))
    for (const Function& f : long_functions(lines_of(file), 80))
      ADD_FAILURE() << file.string() << ":" << f.line << ": a function of " << f.length
                    << " lines; at most 80 fit on two screens, so that a reader keeps all of it in view";
}

TEST(Readability, LinesHaveAtMost120Columns) {
  for (const fs::path& file : sources(everything)) {
    const std::vector<std::string> lines = lines_of(file);
    for (std::size_t i = 0; i < lines.size(); ++i)
      EXPECT_LE(columns(lines[i]), 120u) << file.string() << ":" << i + 1
                                         << ": longer lines wrap in reviews and terminals; clang-format breaks code";
  }
}

// Considers assignments of simple values only: commas also separate arguments and captures.
TEST(Readability, NoCommaOperatorBetweenAssignments) {
  static const std::regex two(R"(^\s*\w[\w.\[\]>-]* [-+*/|&]?= [^;"(){}[]*, \w[\w.\[\]>-]* [-+*/|&]?= .*;$)");
  EXPECT_TRUE(std::regex_match("  a.b = 1, c[i] += 2;", two));
  EXPECT_FALSE(std::regex_match("  const int a = 1, b = 2;", two));
  for (const fs::path& file : sources(everything)) {
    const std::vector<std::string> lines = lines_of(file);
    for (std::size_t i = 0; i < lines.size(); ++i)
      EXPECT_FALSE(std::regex_match(lines[i], two))
          << file.string() << ":" << i + 1 << ": two assignments read as one; give each a line: " << lines[i];
  }
}

/// Maps from and to folders to the place of an include.
using Graph = std::map<std::string, std::map<std::string, std::string>>;

// A cycle through `node`, or "".
std::string find_cycle(const Graph& graph, const std::string& node, std::vector<std::string>& path,
                       std::set<std::string>& done) {
  if (const auto it = std::find(path.begin(), path.end(), node); it != path.end()) {
    std::string text;
    for (auto from = it; from != path.end(); ++from)
      text += graph.at(*from).at(from + 1 == path.end() ? node : *(from + 1)) + "\n";
    return text;
  }
  if (!graph.contains(node) || done.contains(node)) return "";
  path.push_back(node);
  for (const auto& [to, place] : graph.at(node))
    if (const std::string found = find_cycle(graph, to, path, done); !found.empty()) return found;
  path.pop_back();
  done.insert(node);
  return "";
}

// Between two folders, all includes point in one direction.
TEST(Readability, FoldersHaveNoIncludeCycles) {
  const std::vector<const char*> bases = {"libmc", "librender", "tools"};
  Graph graph;
  for (const char* base : bases)
    for (const Include& i : includes(base))
      for (const char* other : bases) {
        const fs::path header = fs::path(other) / i.header;
        const std::string from = fs::path(i.file).parent_path().string(), to = header.parent_path().string();
        if (fs::exists(root / header) && from != to)
          graph[from].emplace(to, i.file + ":" + std::to_string(i.line) + ": <" + i.header + ">");
      }
  EXPECT_GT(graph.size(), 30u);
  std::set<std::string> done;
  for (const auto& [folder, edges] : graph) {
    std::vector<std::string> path;
    const std::string found = find_cycle(graph, folder, path, done);
    ASSERT_TRUE(found.empty()) << "folders include each other in a circle:\n" << found;
  }
}

} // namespace
