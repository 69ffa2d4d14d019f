#pragma once
/// The results of carlo validate as files.

#include "catalogue.h"
#include "commands.h"

#include <string>
#include <vector>

namespace carlo {

/// {command, commit, seed, samples, alpha, passed, cases: [{name, parameters, scalar, verdict, p, fault, mass, mass_error, detectable,
/// detectable_cell, ns_per_sample, seconds, checks: [{name, verdict, p, share, statistic, limit, detail}],
/// worst: [{lo, hi, observed, expected, z, where}]}]}; not finite numbers are null.
void write_json(const std::string& file, const ValidateOptions& options, const std::vector<const Case*>& cases, const std::vector<mc::Report>& reports);

/// One testsuite, one testcase per case with its seconds; the report of a case that did not pass is its failure.
void write_junit(const std::string& file, const std::vector<const Case*>& cases, const std::vector<mc::Report>& reports);

} // namespace carlo
