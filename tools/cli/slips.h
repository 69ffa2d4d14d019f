#pragma once
/// carlo slips: what the checkers make of the samplers that the books print.

#include <options/subcommand.h>

namespace carlo {

struct SlipsOptions {
  std::vector<std::string> names; ///< ids or names of slips; empty: all of them, and the Cornell boxes
  bool list = false;
  double alpha = 0.01;               ///< over all looks at one slip
  std::uint64_t samples = 1'000'000; ///< at most, per slip
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: all
  std::string json; ///< file; empty: none
  std::string command;
};

/// The wrong samplers of the books, the test that rejects each and after how many samples, the right one beside it; all
/// of them and the Cornell boxes when no slip is named.
/// JSON: {command, commit, seed, alpha, passed, slips: [{id, name, where, story, caught, test, samples (0: none
///       needed), fault, report, right: {verdict, p, samples}}],
///       boxes: [{name, where, story, mean, std_error, off, off_error, p, agrees}]}.
int slips(const SlipsOptions& options);

} // namespace carlo
