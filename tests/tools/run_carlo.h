#pragma once
// Runs the carlo binary on the command line.

#include <support/run.h>

#include <string>

namespace support {

inline ProcessResult run_carlo(const std::string& arguments) { return run("'" CARLO_PATH "' " + arguments); }

inline bool has_gnuplot() { return run(std::string("command -v gnuplot")).exit_code == 0; }

} // namespace support
