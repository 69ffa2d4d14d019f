#pragma once
/// Measured curves as text, tables and plots.

#include <converge/measure.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace carlo {

/// For example "slope -0.501 [-0.512, -0.490], theory -0.500".
std::string slope_text(const ConvergenceCurve& curve);

/// One line of warning if the variance appears infinite; otherwise empty.
std::string variance_warning(const Measurement& m);

/// A line for each failed method; empty if there is none.
std::string failure_lines(const Measurement& m);

/// The title, a line for each curve and each failed method, and the warnings about the truth and the variance.
std::string summary(const IntegralTarget& target, const Measurement& m);

/// Number of curves that reached their largest N.
std::size_t count_finished(const Measurement& m);

/// For example "interrupted: 2 of 23 ways were finished, one more up to N = 4096". `last` is the last measurement.
std::string interrupted_text(std::size_t done, std::size_t wanted, std::string_view what, const Measurement& last);

/// A row for each error. The error of a bound is empty; its interval is from 0 to the bound.
std::string to_csv(const IntegralTarget& target, const Measurement& m);

/// A row for each curve: the measured and the theoretical slope. The first line names the columns.
std::string slopes_header();
std::string slopes_csv(const IntegralTarget& target, const Measurement& m);

/// The complete measurement. `about` contains additional metadata: command, commit, seed.
nlohmann::ordered_json to_json(const IntegralTarget& target, const Measurement& m, const nlohmann::ordered_json& about);

/// The gnuplot script for NAME.csv: error against N, and against CPU seconds.
std::string to_script(const IntegralTarget& target, const Measurement& m, const std::string& name);

} // namespace carlo
