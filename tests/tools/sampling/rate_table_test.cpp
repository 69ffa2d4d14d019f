// The committed table of rates, notebooks-data/rates/slopes.csv. It has a row for each integrand and method, agrees
// with theory(), and its deviations are explained.

#include <integrands/rate_integrals.h>
#include <sampling/sampling_methods.h>
#include <sampling/theory.h>

#include <mc/core/file.h>
#include <mc/core/text.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace {

const std::string data = MC_SOURCE_DIR "/notebooks-data/";

// Columns of slopes.csv.
enum Column { experiment, of_class, dimension, sampler, around_n, slope, lo, hi, stated, at_these_n, within, source };

using Fields = std::vector<std::string>;

std::vector<Fields> rows() {
  const std::string text = mc::read_file(data + "rates/slopes.csv");
  std::vector<Fields> all;
  for (const std::string_view line : mc::split(text, '\n')) {
    if (line.empty()) continue;
    const std::vector<std::string_view> fields = mc::split(line, ','); // no source contains a comma
    all.emplace_back(fields.begin(), fields.end());
  }
  all.erase(all.begin()); // the column names
  return all;
}

double number(const std::string& field) { return std::strtod(field.c_str(), nullptr); }

TEST(RateTable, HasARowForEachIntegrandAndMethod) {
  const std::vector<Fields> all = rows();
  ASSERT_EQ(all.size(), carlo::rate_integrals().size() * carlo::sampling_methods().size());
  std::size_t i = 0;
  for (const carlo::UnitCubeIntegral& e : carlo::rate_integrals())
    for (const carlo::SamplingMethod& w : carlo::sampling_methods()) {
      ASSERT_EQ(all[i].size(), std::size_t{source} + 1) << i;
      EXPECT_EQ(all[i][experiment], e.name);
      EXPECT_EQ(all[i][sampler], w.name);
      ++i;
    }
}

TEST(RateTable, StatesTheTheoreticalRates) {
  const std::vector<Fields> all = rows();
  std::size_t i = 0;
  for (const carlo::UnitCubeIntegral& e : carlo::rate_integrals())
    for (const carlo::SamplingMethod& w : carlo::sampling_methods()) {
      const Fields& row = all.at(i++);
      const auto rate = carlo::theoretical_rate(w.name, e.smoothness, e.dim);
      ASSERT_TRUE(rate) << e.name << ' ' << w.name;
      EXPECT_EQ(row[stated], rate->to_string(4)) << e.name << ' ' << w.name;
      EXPECT_EQ(row[source], rate->source) << e.name << ' ' << w.name;
      EXPECT_NEAR(number(row[at_these_n]), -rate->local_exponent(number(row[around_n])), 1e-3)
          << e.name << ' ' << w.name;
      // The printed ends are rounded: within half a digit of theory either answer may be right.
      const double digit = 1e-4, n = number(row[around_n]), from = number(row[lo]), to = number(row[hi]);
      if (rate->is_consistent_with(from - digit, to + digit, n) !=
          rate->is_consistent_with(from + digit, to - digit, n))
        continue;
      EXPECT_EQ(row[within], rate->is_consistent_with(from, to, n) ? "yes" : "no") << e.name << ' ' << w.name;
    }
}

// docs/results.md states how many intervals contain the theoretical slope. It names the method and integrand of all
// others.
TEST(RateTable, DeviationsFromTheoryAreExplained) {
  const std::string text = mc::read_file(MC_SOURCE_DIR "/docs/results.md");
  const std::vector<Fields> all = rows();
  std::size_t hold = 0;
  for (const Fields& row : all) {
    hold += row[within] == "yes";
    if (row[within] == "yes") continue;
    const std::string of = row[experiment].substr(0, row[experiment].rfind('_'));
    bool explained = false;
    for (const std::string_view line : mc::split(text, '\n'))
      explained =
          explained || (line.find("`" + row[sampler] + "`") != line.npos && line.find("`" + of + "`") != line.npos);
    EXPECT_TRUE(explained) << row[experiment] << ' ' << row[sampler];
  }
  EXPECT_NE(text.find(fmt::format("{} of {} intervals of 95 % contain", hold, all.size())), std::string::npos) << hold;
}

} // namespace
