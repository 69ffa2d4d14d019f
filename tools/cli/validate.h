#pragma once
/// carlo validate: checks distributions with laws and statistical tests.

#include <options/checkpoint_options.h>
#include <options/subcommand.h>

namespace carlo {

struct ValidateCommandOptions {
  std::vector<std::string> names;
  bool all = false, list = false;
  bool verbose = false;              ///< print every check that does not pass
  double alpha = 0.01;               ///< family-wise over every statistical test of the run
  std::uint64_t samples = 1'000'000; ///< per case
  std::uint64_t seed = 1;
  std::string scalar;                  ///< "float", "double"; empty: both
  int threads = 0;                     ///< 0: all
  std::optional<double> detect;        ///< relative error to catch with probability .99; chooses `samples`
  std::string json, junit;             ///< files; empty: none
  std::string plugin;                  ///< a shared object with distributions to check
  std::vector<std::string> parameters; ///< sets or sweeps for the plugin, see parameters.h
  int random_parameters = 0;           ///< cases with random parameters for each sampler of the plugin
  std::string sampler_command;         ///< a program that answers over pipes, see command.h
  std::string uniforms;               ///< per sample of the program: a number or "own"; empty: dimensions of the domain
  std::optional<double> timeout;      ///< wall-clock seconds per case of foreign code; none: 60
  std::optional<double> memory;       ///< GiB for foreign code; none: 4
  std::string samples_file, pdf_file; ///< samples, and a density on a grid, see samples_file.h
  std::string pdf;                    ///< the density as an expression
  std::string domain;                 ///< of the samples; empty: inferred from their columns
  std::string breaks;                 ///< places where the density jumps, see parse_breaks
  bool open_interval = false;         ///< u lies in (0,1): failures at single u are accepted
  bool dependent = false;             ///< the samples of a file need not be independent
  bool log_density = false;           ///< densities are given as logarithms
  std::string thin;                   ///< rows of a Markov chain to keep: "auto" or each K-th
  bool unnormalized = false;          ///< the given density is only proportional to the true one
  std::string report;                 ///< folder for index.html; empty: none
  CheckpointFiles checkpoint;
  std::string output; ///< file of a part
  std::string command;
  std::string worker = "/proc/self/exe"; ///< the carlo that runs foreign code
};

/// The options as rows of --help, and its texts.
std::vector<Option> validate_rows(ValidateCommandOptions& options);
About validate_about();

int run_validate(const ValidateCommandOptions& options);

} // namespace carlo
