#include <converge/curve_style.h>

#include <gmock/gmock.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <set>

namespace {

using namespace carlo;
using testing::HasSubstr;

/// A measurement of curves whose last errors grow with their positions.
struct Curves {
  std::deque<SamplingMethod> methods;
  Measurement m;

  explicit Curves(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      methods.emplace_back().name = name;
      ConvergenceCurve c;
      c.method = &methods.back();
      const double error = 0.1 + 0.01 * double(m.curves.size());
      c.errors = {{64, error, error, error, 1}};
      m.curves.push_back(c);
    }
  }
  TradeCandidate candidate(std::size_t i) const { return {&m.curves[i], 64, {1, 1, 1}, {0.1, 0.1, 0.1}}; }
};

const std::vector<std::string> ten = {"a", "b", "c", "d", "e", "f", "g", "h", "i", "random"};

TEST(CurveStyles, UpToEightCurves_HaveTheColorsOfTheirPositions) {
  const Curves eight({"a", "b", "c", "d", "e", "f", "g", "random"});
  const std::vector<CurveStyle> styles = curve_styles(eight.m, nullptr);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(styles[i].color, i);
}

TEST(CurveStyles, ManyCurves_EightHaveColorsOfTheirOwn) {
  const Curves many(ten);
  const std::vector<CurveStyle> styles = curve_styles(many.m, nullptr);
  std::set<std::size_t> used;
  for (const CurveStyle& s : styles)
    if (s.color) used.insert(*s.color);
  EXPECT_EQ(used.size(), 8u);
  EXPECT_EQ(styles[9].color, 0u) << "plain Monte Carlo, although its error is the largest";
  EXPECT_EQ(styles[0].color, 1u) << "the smallest error";
  EXPECT_FALSE(styles[7].color || styles[8].color);
  EXPECT_EQ(page_color(styles[8]), "var(--curve-other)");
  EXPECT_EQ(drawing_order(styles).front(), 7u) << "grey curves first, below the others";
  EXPECT_EQ(drawing_order(styles).back(), 6u);
}

TEST(CurveStyles, WinnersAndTheirRivalsComeFirst) {
  const Curves many(ten);
  TradeResults trade_results;
  trade_results.by_error = {{0.1, {many.candidate(8), many.candidate(7)}, {}, {}}, {1e-9, {}, {many.candidate(6)}, {}}};
  trade_results.by_time = {{1, {many.candidate(5)}, {}}};
  const std::vector<CurveStyle> styles = curve_styles(many.m, &trade_results);
  EXPECT_TRUE(styles[8].is_cheapest && !styles[8].is_most_accurate && styles[8].wins());
  EXPECT_TRUE(styles[5].is_most_accurate && !styles[5].is_cheapest);
  EXPECT_FALSE(styles[6].wins()) << "the nearest of those that miss the error";
  EXPECT_EQ(styles[8].color, 0u);
  EXPECT_EQ(styles[5].color, 1u);
  EXPECT_EQ(styles[9].color, 2u);
  EXPECT_TRUE(styles[6].color && styles[7].color);
}

TEST(CurveStyles, FloatVariantsLeaveColorsToOtherMethods) {
  const Curves many({"a_float", "b_float", "c", "d", "e", "f", "g", "h", "i", "random"});
  const std::vector<CurveStyle> styles = curve_styles(many.m, nullptr);
  EXPECT_FALSE(styles[0].color || styles[1].color);
}

// Linear RGB to the plane of what a dichromat distinguishes (Machado, Oliveira and Fernandes 2009, severity 1).
std::array<Eigen::Matrix3d, 4> color_visions() {
  std::array<Eigen::Matrix3d, 4> all;
  all[0].setIdentity();
  all[1] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998;
  all[2] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881;
  all[3] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900;
  return all;
}

Eigen::Vector3d linear_rgb(const std::string& hex) {
  unsigned r = 0, g = 0, b = 0;
  EXPECT_EQ(std::sscanf(hex.c_str(), "#%2x%2x%2x", &r, &g, &b), 3);
  const auto linear = [](unsigned v) {
    const double c = v / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return {linear(r), linear(g), linear(b)};
}

// CIE 1976 L*a*b*, D65.
Eigen::Vector3d lab(const Eigen::Vector3d& rgb) {
  Eigen::Matrix3d xyz;
  xyz << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Eigen::Vector3d white(0.9505, 1, 1.089);
  const Eigen::Vector3d t = (xyz * rgb.cwiseMax(0).cwiseMin(1)).cwiseQuotient(white);
  const auto f = [](double x) { return x > 0.008856 ? std::cbrt(x) : 7.787 * x + 16.0 / 116; };
  return {116 * f(t.y()) - 16, 500 * (f(t.x()) - f(t.y())), 200 * (f(t.y()) - f(t.z()))};
}

// A difference of 20 in L*a*b* is seen at a glance; 2.3 is the smallest that is seen.
TEST(CurveStyles, ColorsDifferForEveryColorVision) {
  std::vector<std::string> colors;
  for (std::size_t i = 0; i < curve_color_count; ++i) colors.push_back(color_on_white({.color = i}));
  for (const Eigen::Matrix3d& vision : color_visions())
    for (std::size_t i = 0; i < colors.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE((lab(vision * linear_rgb(colors[i])) - lab(vision * linear_rgb(colors[j]))).norm(), 20)
            << colors[i] << " " << colors[j];
}

TEST(CurveStyles, PagesDefineEveryColorForLightAndDark) {
  const std::string css = curve_color_css();
  for (std::size_t i = 0; i < curve_color_count; ++i) {
    const std::string name = "--curve-" + std::to_string(i) + ":";
    const std::size_t first = css.find(name);
    ASSERT_NE(first, std::string::npos);
    EXPECT_NE(css.find(name, first + 1), std::string::npos);
  }
  EXPECT_THAT(css, HasSubstr("prefers-color-scheme: dark"));
}

} // namespace
