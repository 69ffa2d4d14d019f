#pragma once
/// The results of carlo validate as files.

#include <catalogue/catalogue.h>
#include <string>
#include <vector>

namespace carlo {

/// The settings of a run that its results contain.
struct ValidationSettings {
  std::string command;
  std::uint64_t seed = 1;
  std::uint64_t samples = 0; ///< per case
  double alpha = 0.01;       ///< family-wise level
  bool from_file = false;    ///< the samples come from a file, which determines their number
  bool open_interval = false;
};

/// A case without a report, for example because its distribution crashed.
struct UncheckedCase {
  const Case* test_case;
  std::string error;
};

/// A run of validate, with a report for each finished case.
struct ValidationRun {
  ValidationSettings settings;
  const std::vector<const Case*>& cases;
  const std::vector<mc::Report>& reports;
  bool interrupted = false;
  std::vector<UncheckedCase> unchecked = {};
};

/// Returns the command with which a user repeats one case of a run of `cases` cases.
std::string repeat_command(const Case& c, const ValidationSettings& settings, std::size_t cases);

/// Returns JSON with the schema of tools/report/README.md; numbers that are not finite become null.
std::string validation_json(const ValidationRun& run);

/// Returns one testsuite with one testcase per case and its values as properties. A case that does not pass has its
/// report as failure.
std::string validation_junit(const ValidationRun& run);

/// A page that needs no other file and no network. It contains the results and, for cases with evidence, maps of
/// observed and expected counts, of residuals, and the p-value as a function of the number of samples. A map has at
/// most 512 cells for a pass, else 4096.
std::string validation_page(const ValidationRun& run);

} // namespace carlo
