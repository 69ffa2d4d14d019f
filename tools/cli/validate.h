#pragma once
/// carlo validate: every sampler against its laws.

#include <options/subcommand.h>

namespace carlo {

struct ValidateOptions {
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
  std::string plugin;                  ///< a shared object whose samplers are checked instead of the catalogue's
  std::vector<std::string> parameters; ///< of the plugin: sets or sweeps, see parameters.h
  std::string sampler_command;         ///< or a program that answers over pipes, see command.h
  int uniforms = 0;                    ///< that one sample of it takes; 0: as many as the domain has dimensions
  std::optional<double> timeout;       ///< wall-clock seconds per case of foreign code; 60 where none is given
  std::optional<double> memory;        ///< GiB that it may have; 4 where none is given
  std::string samples_file, pdf_file;  ///< samples and the density on a grid, see samples_file.h
  std::string pdf;                     ///< or the density as an expression
  std::string domain;                  ///< of the samples; empty: by their columns
  std::string breaks;                  ///< where the density jumps along the axes of the domain, see parse_breaks
  bool open_interval = false;          ///< u in (0,1): a sampler may break at single u
  bool unnormalized = false;           ///< what is given is only proportional to the density
  std::string report;                  ///< folder for index.html; empty: none
  std::string command;
  std::string worker = "/proc/self/exe"; ///< the carlo that runs foreign code
};

/// The options as rows of --help, and its texts.
std::vector<Option> validate_rows(ValidateOptions& options);
About validate_about();

int validate(const ValidateOptions& options);

} // namespace carlo
