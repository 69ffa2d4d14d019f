#pragma once
/// Samplers in any language, as a program that answers over pipes.
///
/// Questions, in the protocol of program.h:
///   "sample N K\n" and N K numbers : N points u of [0,1)^K. Answer: N C numbers, the samples x, where C is the number
///                                    of columns of --domain.
///   "draw N 1\n" and N numbers     : instead of "sample", for programs with random numbers of their own: N seeds,
///                                    whole numbers below 2^53. Answer: N C numbers, one sample for each seed.
///   "pdf N C\n" and N C numbers    : N points x of the domain. Answer: N numbers, the densities; for discrete outcomes
///                                    their probabilities. Or the logarithms of these, as stated.
/// examples/program-python/sampler.py is an example in 30 lines.

#include <plugin/worker.h>

#include <catalogue/catalogue.h>

#include <string>

namespace carlo {

struct CommandDistribution {
  std::string command;                   ///< command line for /bin/sh
  std::string domain;                    ///< see parse_domain
  std::string breaks;                    ///< see parse_breaks; may be empty
  int uniforms = 0;                      ///< K; 0: the dimension of the domain; own_numbers: none
  bool is_log = false;                   ///< "pdf" answers logarithms
  static constexpr int own_numbers = -1; ///< of uniforms: the program draws random numbers from a seed
};

/// The program's sampler as one case. It is checked by every law of check_laws that needs only sample and pdf. Like a
/// plugin it runs in a separate process under limits, and every process that it started ends with it.
///   throws : Error for an invalid domain; when it runs, Error for a program that cannot be started, ends, hangs, or
///            answers with too few numbers.
Case command_case(const CommandDistribution& distribution, const WorkerOptions& worker);

/// Answers the request of command_case in the worker.
nlohmann::json run_command_task(const nlohmann::json& request, CallMonitor& monitor);

} // namespace carlo
