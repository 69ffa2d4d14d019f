// Prints one table of all speeds of libmc: CPU time per item [ns], the median over the repetitions. The table also
// gives the time as a multiple of pcg32 in the same run, to compare machines. For batch forms ("name/n") it gives the
// speed-up.
#include "speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace {

class Table : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      Row& row = rows_[run.run_name.function_name];
      row.rank = run.family_index;
      row.ns.push_back(run.cpu_accumulated_time * 1e9 / static_cast<double>(run.iterations) / run.counters.at("items"));
      row.aim = run.counters.at("aim");
    }
  }

  void Finalize() override {
    const double yardstick = rows_.contains("pcg32") ? median("pcg32") : 0;
    fmt::print("{:<44} {:>8} {:>8} {:>8} {:>9} {:>7}\n", "per item", "ns", "x pcg32", "aim", "batch ns", "gain");
    std::map<std::int64_t, std::string> order;
    for (const auto& [name, row] : rows_)
      if (!name.ends_with("/n")) order[row.rank] = name;
    for (const auto& [rank, name] : order) {
      const double ns = median(name), aim = rows_.at(name).aim;
      fmt::print("{:<44} {:>8.2f} {:>8.2f}", name, ns, ns / yardstick);
      if (aim > 0) fmt::print(" {:>8.2f}", aim / 1.7);
      else fmt::print(" {:>8}", "");
      if (rows_.contains(name + "/n")) fmt::print(" {:>9.3f} {:>7.1f}", median(name + "/n"), ns / median(name + "/n"));
      fmt::print("\n");
    }
    fmt::print("aim: the most it should take, as a multiple of pcg32\n");
  }

 private:
  struct Row {
    std::vector<double> ns;
    double aim = 0;
    std::int64_t rank = 0; ///< order of registration
  };

  double median(const std::string& name) const {
    std::vector<double> ns = rows_.at(name).ns;
    std::nth_element(ns.begin(), ns.begin() + static_cast<std::ptrdiff_t>(ns.size() / 2), ns.end());
    return ns[ns.size() / 2];
  }

  std::map<std::string, Row> rows_;
};

} // namespace

int main(int argc, char** argv) {
  // Shuffles the repetitions of all benchmarks, so that a temporarily slow machine affects all of them.
  std::vector<std::string> words{argv[0], "--benchmark_repetitions=9", "--benchmark_min_time=0.02",
                                 "--benchmark_enable_random_interleaving=true"};
  words.insert(words.end(), argv + 1, argv + argc);
  std::vector<char*> args(words.size());
  std::transform(words.begin(), words.end(), args.begin(), [](std::string& word) { return word.data(); });
  int count = static_cast<int>(args.size());
  benchmark::Initialize(&count, args.data());
  if (benchmark::ReportUnrecognizedArguments(count, args.data())) return 1;
  Table table;
  benchmark::RunSpecifiedBenchmarks(&table);
}
