#pragma once
/// carlo known-bugs: the checker's verdicts on sampling bugs from books, courses and renderers.

#include <options/subcommand.h>

namespace carlo {

struct KnownBugsCommandOptions {
  std::vector<std::string> names; ///< ids or names of bugs; empty: all, and the Cornell boxes
  bool list = false;
  double alpha = 0.01;               ///< over all sample sizes tried for one bug
  std::uint64_t samples = 1'000'000; ///< at most, for each bug
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: all
  std::string json; ///< file; empty: none
  std::string command;
};

/// Prints for each bug the test that rejects it, the number of samples that this takes, and the verdict on the
/// correction. Without a name: all bugs, and the Cornell boxes.
/// JSON: {command, commit, seed, alpha, passed, slips: [{id, name, where, story, caught, test, samples (0: none
///       needed), fault, report, right: {verdict, p, samples}}],
///       boxes: [{name, where, story, mean, std_error, off, off_error, p, agrees}]}.
int run_known_bugs(const KnownBugsCommandOptions& options);

} // namespace carlo
