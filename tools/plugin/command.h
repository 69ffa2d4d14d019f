#pragma once
/// Samplers in any language, as a program that answers over pipes.
///
/// Protocol: carlo writes questions to the program's standard input, each a line and then numbers, and reads the
/// answer, numbers alone, from its standard output. Numbers are IEEE doubles of 8 bytes, least significant byte first.
///   "sample N K\n" and N K numbers : N points u of [0,1)^K. Answer: N C numbers, the samples x, C being the columns of
///                                    --domain
///   "pdf N C\n" and N C numbers    : N points x of the domain. Answer: N numbers, the densities; probabilities of
///                                    outcomes
/// The program answers each question before it reads the next, flushes, and ends when its input does. The same question
/// has the same answer. tests/tools/commands/sampler.py is one in 30 lines.

#include <plugin/worker.h>

#include <catalogue/catalogue.h>

#include <string>

namespace carlo {

struct CommandDistribution {
  std::string command; ///< for /bin/sh
  std::string domain;  ///< see parse_domain
  std::string breaks;  ///< see parse_breaks; may be empty
  int uniforms = 0;    ///< K; 0: as many as the domain has dimensions
};

/// The program's sampler as one case: every law of check_laws that needs no more than sample and pdf. It runs like a
/// plugin, in a process of its own under limits, and everything it started ends with it.
///   throws : Error for a domain that means nothing; when it runs, Error for a program that cannot be started, ends,
///            hangs, or answers with too few numbers
Case command_case(const CommandDistribution& distribution, const WorkerOptions& worker);

/// What the worker does with the request of command_case.
nlohmann::json run_command_task(const nlohmann::json& request, CallMonitor& monitor);

} // namespace carlo
