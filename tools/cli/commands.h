#pragma once
/// The options of each subcommand of carlo, as plain data, and the functions that run them.
/// Each function prints its result on stdout and progress on stderr, returns the exit code, and throws mc::Error on bad
/// input.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carlo {

/// What carlo returns to the shell.
enum ExitCode : int {
  exit_ok = 0,           ///< done, and every check passed
  exit_failed = 1,       ///< done, but a check failed: a sampler broke a law, two images differ
  exit_bad_input = 2,    ///< bad usage, file or value; one line on stderr says what to do
  exit_interrupted = 130 ///< Ctrl-C; what was found so far is written, or said, and marked as such
};

struct RenderOptions {
  std::string scene;
  bool help_scene = false;            ///< print the reference of scene files, and stop
  std::string dialect = "mitsuba";    ///< whose defaults hold in the scene
  std::string output;                 ///< empty: the scene's name with .exr in the current folder
  std::optional<int> spp;             ///< samples per pixel
  std::optional<double> seconds;      ///< wall-clock budget [s]
  std::optional<double> target_error; ///< mean relative standard error to reach
  std::string size;                   ///< "WxH"; empty: the scene's
  std::string strategy, sampler;      ///< empty: mis, sobol
  std::optional<int> max_depth;       ///< path vertices after the camera; -1: unlimited
  std::uint64_t seed = 0;
  int threads = 0;            ///< 0: all
  double exposure = 0;        ///< stops, PNG only
  bool allow_invalid = false; ///< write the image although samples were not finite
  std::string command;        ///< the command line, for the metadata
};
int render(const RenderOptions& options);

struct CompareOptions {
  std::string a, b;
  std::string metric;   ///< empty: all
  std::string diff;     ///< file for the difference image; empty: none
  double alpha = 0.01;  ///< family-wise
  double tolerance = 0; ///< relative difference that still counts as agreement
};
int compare(const CompareOptions& options);

struct ValidateOptions {
  std::vector<std::string> names;
  bool all = false, list = false;
  double alpha = 0.01;               ///< family-wise over every statistical test of the run
  std::uint64_t samples = 1'000'000; ///< per case
  std::uint64_t seed = 1;
  std::string scalar;                  ///< "float", "double"; empty: both
  int threads = 0;                     ///< 0: all
  std::optional<double> detect;        ///< relative error to catch with probability .99; chooses `samples`
  std::string json, junit;             ///< files; empty: none
  std::string plugin;                  ///< a shared object whose samplers are checked instead of the catalogue's
  std::vector<std::string> parameters; ///< of the plugin: one set each, "alpha=0.1,n=3"
  double timeout = 60;                 ///< wall-clock seconds per case of the plugin
  std::string samples_file, pdf_file;  ///< samples and the density on a grid, see samples_file.h
  std::string domain;                  ///< of the grid; empty: by the columns of the samples
  bool unnormalized = false;           ///< the grid is only proportional to the density
  bool open_interval = false;          ///< accept samplers that break at u = 0
  std::string report;                  ///< folder for index.html; empty: none
  std::string command;
};
int validate(const ValidateOptions& options);

/// validate with names = {"book-slips", SLIP...}: the wrong samplers of the books, the test that rejects each and after
/// how many samples, the right one beside it; all of them and the Cornell boxes when no SLIP is named. `samples` bounds
/// the search.
/// JSON: {command, commit, seed, alpha, passed, slips: [{id, name, where, story, caught, test, samples (0: none
///       needed), fault,
/// report, right: {verdict, p, samples}}], boxes: [{name, where, story, mean, std_error, off, off_error, p, agrees}]}.
int book_slips(const ValidateOptions& options);

struct ConvergeOptions {
  std::vector<std::string> experiments; ///< empty: all
  bool list = false;
  std::string samplers = "random,stratified,sobol";
  std::uint64_t max_n = 1 << 18;
  int replicates = 128;
  std::uint64_t seed = 1;
  int threads = 0;
  std::string output = "out/convergence";
  std::string command;
};
int converge(const ConvergeOptions& options);

struct IntegrateOptions {
  std::string integrand; ///< a name, or an expression
  std::string domain;    ///< "x=0:1,y=-1:2" for an expression
  bool list = false;
  double rel_error = 1e-3, abs_error = 0;
  std::uint64_t max_calls = 10'000'000;
  std::string method = "auto";
  std::uint64_t seed = 1;
  int threads = 0;
  std::string json;
  std::string command;
};
int integrate(const IntegrateOptions& options);

} // namespace carlo
