// A table of accuracy: every warp and table at thousands of random parameters over its whole legal range. Reports the
// worst errors in epsilons and as multiples of the stated bounds. Arguments: trials per row, points per trial, seed,
// family.
#include "sweep/sweep.h"

#include <cstdlib>
#include <string_view>

namespace {
// The worst error in epsilons and as a multiple of the bound.
std::string text_of(const sweep::Law& l) {
  if (l.points == 0) return "-";
  return fmt::format("{:.3g} ({:.2g}{})", l.eps, l.worst, l.broken ? " !" : "");
}
} // namespace

int main(int argc, char** argv) {
  sweep::Effort effort;
  if (argc > 1) effort.trials = std::atoi(argv[1]);
  if (argc > 2) effort.points = std::atoi(argv[2]);
  if (argc > 3) effort.seed = static_cast<std::uint64_t>(std::atoll(argv[3]));
  const std::string_view wanted = argc > 4 ? argv[4] : "";
  constexpr std::pair<std::string_view, std::vector<sweep::Row> (*)(const sweep::Effort&)> families[] = {
      {"intervals", sweep::intervals}, {"planes", sweep::planes}, {"spheres", sweep::spheres},
      {"lobes", sweep::lobes},         {"lights", sweep::lights},
  };
  int broken = 0;
  fmt::print("{:<32} {:>7} {:>7} {:>20} {:>20} {:>20} {:>8} {:>8}\n", "worst error [eps], x bound", "trials", "refused",
             "sample", "pdf", "invert", "edges", "falls");
  for (const auto& [name, rows_of] : families) {
    if (!wanted.empty() && wanted != name) continue;
    for (const sweep::Row& row : rows_of(effort)) {
      fmt::print("{:<32} {:>7} {:>7} {:>20} {:>20} {:>20} {:>8} {:>8}\n", row.name, row.tried, row.refused,
                 text_of(row.sample), text_of(row.pdf), text_of(row.invert), row.edges.broken, row.monotone.broken);
      for (const auto& [law_name, l] : {std::pair("edges", &row.edges),
                                        {"sample", &row.sample},
                                        {"pdf", &row.pdf},
                                        {"invert", &row.invert},
                                        {"monotone", &row.monotone}})
        if (l->broken) {
          fmt::print("    {} broken at {} of {}: {}\n", law_name, l->broken, l->points, l->worst_case);
          ++broken;
        }
    }
  }
  return broken > 0;
}
