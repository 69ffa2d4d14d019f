#pragma once
/// The results of carlo validate as files.

#include <catalogue/catalogue.h>
#include <string>
#include <vector>

namespace carlo {

/// What a run of validate was asked for, as far as its results name it.
struct ValidationSettings {
  std::string command;
  std::uint64_t seed = 1;
  std::uint64_t samples = 0; ///< per case
  double alpha = 0.01;       ///< family-wise
  bool from_file = false;    ///< the samples come from a file, which says how many there are
  bool open_interval = false;
};

/// A case that could not be checked: its sampler crashed, say.
struct UncheckedCase {
  const Case* test_case;
  std::string error;
};

/// A run of validate: a report for each case that finished.
struct ValidationRun {
  ValidationSettings settings;
  const std::vector<const Case*>& cases;
  const std::vector<mc::Report>& reports;
  bool interrupted = false;
  std::vector<UncheckedCase> unchecked = {};
};

/// The command that repeats one case of a run of so many cases, as a user would type it.
std::string repeat_command(const Case& c, const ValidationSettings& settings, std::size_t cases);

/// The schema is in tools/report/README.md; not finite numbers are null.
std::string validation_json(const ValidationRun& run);

/// One testsuite, one testcase per case with its figures as properties; the report of a case that did not pass is its
/// failure.
std::string validation_junit(const ValidationRun& run);

/// A page that needs no other file and no network: the results, and for each case that kept its evidence the maps of
/// observed and expected counts and of their residuals, and the way of its p-value. Cases that did not pass keep all of
/// their cells, the others 1024.
void write_validation_page(const std::string& file, const ValidationRun& run);

} // namespace carlo
