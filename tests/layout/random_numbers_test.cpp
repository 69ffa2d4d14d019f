// In librender, random numbers are only passed to warps, tables, mixtures and estimators of libmc; no source does
// arithmetic on them. The test treats these as random numbers: parameters named u or uc, values from a stream,
// u_remapped, and variables made from them.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

std::string without_comments(std::string text) {
  text = std::regex_replace(text, std::regex(R"(//[^\n]*)"), "");
  return std::regex_replace(text, std::regex(R"("[^"\n]*")"), "\"\"");
}

// Variables that contain random numbers, such as `Vec2 v(part.u_remapped, u[1])`, but not results of sampling.
std::set<std::string> random_names(const std::string& code) {
  std::set<std::string> names = {"u", "uc"};
  static const std::regex declaration(R"((?:Float|Vec2|Vec3|auto|double|mc::Vec2<\w+>)&? (\w+)\s*[=({]([^;]*);)");
  for (bool grown = true; grown;) {
    grown = false;
    for (std::sregex_iterator it(code.begin(), code.end(), declaration), end; it != end; ++it) {
      const std::string value = (*it)[2];
      if (value.find("sample") != std::string::npos) continue;
      bool random = std::regex_search(value, std::regex(R"(\bnext2?\(|\bu_remapped\b)"));
      for (const std::string& name : names) random |= std::regex_search(value, std::regex(R"(\b)" + name + R"(\b)"));
      if (random) grown |= names.insert((*it)[1]).second;
    }
  }
  return names;
}

// Lines in which a random number is an operand of an operator or an argument of a function that is no warp.
std::vector<std::string> misuses(const std::string& text) {
  std::string code = without_comments(text);
  std::string name = R"(\w+(?:\.|->)next2?\(\)|\w+(?:\.|->)u_remapped)";
  for (const std::string& one : random_names(code)) name += "|" + one;
  const std::string number = R"((?:\b(?:)" + name + R"()(?![\w(])(?:\[\w+\]|\.[xyz]\(\))?))";
  // A cast of a random number is a random number.
  code = std::regex_replace(code, std::regex(R"(\b(?:double|Float|float)\(\s*()" + number + R"()\s*\))"), "$1");
  const std::regex before(R"((?:[-+*/%]| [<>]|==|!=)\s*)" + number),
      after(number + R"((?:\s*(?:[-+*/%]|==|!=)| [<>]))"),
      function(R"(\b(?:sqrt|cbrt|log|log1p|exp|expm1|pow|sin|cos|tan|asin|acos|atan2?|floor|ceil|round|fmod|min|max|)"
               R"(clamp|abs)\s*(?:<\w+>)?\((?:[^;]*[^\w.])?)" +
               number);
  std::vector<std::string> found;
  std::istringstream lines(code);
  for (std::string line; std::getline(lines, line);)
    if (std::regex_search(line, before) || std::regex_search(line, after) || std::regex_search(line, function))
      found.push_back(line);
  return found;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(RandomNumbers, AreOnlyUsedThroughLibmc) {
  const fs::path root = fs::path(MC_SOURCE_DIR) / "librender/render";
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    const bool reads_files = fs::relative(entry.path(), root).begin()->string() == "io"; // io uses no random numbers
    if ((extension != ".h" && extension != ".cpp") || reads_files) continue;
    ++files;
    for (const std::string& line : misuses(text_of(entry.path())))
      ADD_FAILURE() << fs::relative(entry.path(), root) << ": a random number outside of a warp: " << line;
  }
  EXPECT_GE(files, 30);
}

// Random numbers come from the streams of libmc.
TEST(RandomNumbers, AreNotGeneratedInLibrender) {
  const fs::path root = fs::path(MC_SOURCE_DIR) / "librender/render";
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_regular_file()) continue;
    EXPECT_FALSE(
        std::regex_search(text_of(entry.path()), std::regex(R"(mc/random/(?:pcg|uniform)|std::rand|<random>)")))
        << name << " makes random numbers of its own";
  }
}

TEST(RandomNumbers, MisusesAreDetected) {
  for (const char* wrong :
       {"const Float z = 1 - 2 * u[0];", "  return std::sqrt(u[0]);", "if (uc < r) return;", "  return radius * u;",
        "const Float a = stream.next();\n  return a * a;", "return std::cos(2 * mc::pi<Float> * u[1]);",
        "const auto s = table.sample_index(u[0]);\nconst Float w = s.u_remapped;\nreturn std::log(w);",
        "if (!(stream.next() < survive)) return false;", "const double target = double(u[0]) * area_;",
        "const Vec2 v(u[1], u[0]);\nreturn v[0] / 2;", "return std::min(uc, Float(1));"})
    EXPECT_FALSE(misuses(wrong).empty()) << wrong;
  for (const char* right : {"std::optional<S> sample(const Vec3& ref, const Vec2& u) const;", "return warp.sample(u);",
                            "const Vec2 v(s.u_remapped, u[1]); return warp.sample(v);",
                            "const auto s = bsdf.sample(wo, uc, u);\nreturn s * 2;", "const Vec2 u = stream.next2();",
                            "x = n > 1 ? stream.next() : Float(0);", "lens.sample({uc, u[0], u[1]}) * 2",
                            "const auto w = mc::UniformDisk<Float>{}.sample(u);\nreturn 2 * w[0];", "// u[0] * 2",
                            "const Vec2 lens = radius_ * mc::UniformDisk<Float>{}.sample(u);"})
    EXPECT_TRUE(misuses(right).empty()) << right << "\n-> " << misuses(right).front();
}

} // namespace
