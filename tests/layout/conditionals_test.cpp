// A choice among three or more values is written as if and return, a switch or a table. In the product code no
// conditional a ? b : c contains another one.

#include "layout/source_tree.h"

#include <gtest/gtest.h>

#include <cctype>

namespace {

using namespace layout;

// End of the comment, string or character literal that begins at i; i if none begins there.
std::size_t end_of_quoted(const std::string& text, std::size_t i) {
  const auto behind = [&](const std::string& end, std::size_t from) {
    const std::size_t at = text.find(end, from);
    return at == text.npos ? text.size() : at + end.size();
  };
  if (text.compare(i, 2, "//") == 0) return std::min(text.find('\n', i), text.size());
  if (text.compare(i, 2, "/*") == 0) return behind("*/", i + 2);
  if (text.compare(i, 2, "R\"") == 0) {
    const std::size_t open = text.find('(', i);
    return behind(")" + text.substr(i + 2, open - i - 2) + "\"", open);
  }
  const bool separates_digits = i > 0 && std::isalnum(static_cast<unsigned char>(text[i - 1]));
  if (text[i] != '"' && (text[i] != '\'' || separates_digits)) return i;
  std::size_t end = i + 1;
  while (end < text.size() && text[end] != text[i]) end += text[end] == '\\' ? 2 : 1;
  return std::min(end + 1, text.size());
}

// The text without comments and literals, with the same lines.
std::string code_of(const std::string& text) {
  std::string code;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = end_of_quoted(text, i);
    if (end == i) code += text[i++];
    else
      code.append(static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                                      text.begin() + static_cast<std::ptrdiff_t>(end), '\n')),
                  '\n');
    i = std::max(i, end);
  }
  return code;
}

// Lines, counted from 1, of conditionals in an arm of another conditional. Text in braces, such as the body of a
// lambda, is analysed separately.
std::vector<int> nested_conditionals(const std::string& text) {
  struct Bracket {
    char kind;
    bool conditional = false; // contains a conditional since its last comma or semicolon
  };
  std::vector<Bracket> open = {{'{'}};
  std::vector<int> found;
  int line = 1;
  for (const char c : code_of(text)) {
    switch (c) {
    case '\n': ++line; break;
    case '(':
    case '[':
    case '{': open.push_back({c}); break;
    case ')':
    case ']':
    case '}':
      if (open.size() > 1) open.pop_back();
      break;
    case ',':
    case ';': open.back().conditional = false; break;
    case '?': {
      auto around = open.rbegin();
      while (!around->conditional && around->kind != '{') ++around;
      if (around->conditional) found.push_back(line);
      open.back().conditional = true;
      break;
    }
    default: break;
    }
  }
  return found;
}

TEST(Conditionals, NestedOnesAreDetected) {
  for (const char* wrong : {"x = a ? b : c ? d : e;", "x = a ? b ? c : d : e;", "x = a ? f(b ? c : d) : e;",
                            "x = a ? b : (c ? d : e);", "f(a ? v[b ? 0 : 1] : e, 1);", "x = a ? \"?\" : b ? '\"' : c;"})
    EXPECT_EQ(nested_conditionals(wrong).size(), 1u) << wrong;
  for (const char* right : {"x = a ? b : c; y = d ? e : f;", "f(a ? b : c, d ? e : f);",
                            "x = (a ? b : c) + (d ? e : f);", "x = a ? [](int i) { return i ? 1 : 2; } : f;",
                            "x = a ? \"b ? c : d\" : e; // ? ? : :", "if (a ? b : c) return d ? e : f;",
                            "x = a ? 1'000 : 2; y = '?'; /* a ? b : c ? */", "x = a ? R\"(?\")\" : b;"})
    EXPECT_TRUE(nested_conditionals(right).empty()) << right;
  EXPECT_EQ(nested_conditionals("// ?\nx = a ? b\n  : c ? d : e;"), (std::vector<int>{3}));
}

TEST(Conditionals, AreNotNested) {
  for (const fs::path& file : sources({"libmc", "librender", "tools", "python"}))
    for (const int line : nested_conditionals(text_of(file)))
      ADD_FAILURE() << file.string() << ":" << line << ": a conditional within another";
}

} // namespace
