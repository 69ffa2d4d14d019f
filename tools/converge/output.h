#pragma once
/// Measured curves as text, tables and pictures.

#include <converge/measure.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace carlo {

/// "slope -0.501 [-0.512, -0.490], theory -0.500".
std::string slope_text(const ConvergenceCurve& curve);

/// That the variance looks infinite, in one line; empty where it does not.
std::string variance_warning(const Measurement& m);

/// The title, a line for each curve, and what is to be said of the truth and of the variance.
std::string summary(const IntegralTarget& target, const Measurement& m);

/// How many of its curves reached their largest N.
std::size_t count_finished(const Measurement& m);

/// "interrupted: 2 of 23 ways were finished, one more up to N = 4096", the last being what was measured last.
std::string interrupted_text(std::size_t done, std::size_t wanted, std::string_view what, const Measurement& last);

/// A row for each error; that of a bound is empty between 0 and the bound.
std::string to_csv(const IntegralTarget& target, const Measurement& m);

/// A row for each curve: its slope beside theory. The first line names the columns.
std::string slopes_header();
std::string slopes_csv(const IntegralTarget& target, const Measurement& m);

/// All that was measured; `about` holds what else there is to say: command, commit, seed.
nlohmann::ordered_json to_json(const IntegralTarget& target, const Measurement& m, const nlohmann::ordered_json& about);

/// The gnuplot script of NAME.csv: error against N, and against CPU seconds.
std::string to_script(const IntegralTarget& target, const Measurement& m, const std::string& name);

/// The colour of the i-th curve, for colour-blind eyes too.
std::string color(std::size_t i);

} // namespace carlo
