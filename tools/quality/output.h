#pragma once
/// The files that carlo points writes.

#include <quality/measure.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace carlo {

/// quality.csv: a line for each row. Unknown values are empty.
std::string quality_csv(const std::vector<QualityRow>& rows);

/// spectrum.csv: a line for each row and ring; only the header in one dimension.
std::string spectrum_csv(const std::vector<QualityRow>& rows);

/// The gnuplot script that draws both files over N, with the title at the top.
std::string quality_script(const std::string& title, const std::vector<QualityRow>& rows);

nlohmann::json to_json(const QualityRow& row);

} // namespace carlo
