#pragma once
/// The files that carlo points writes of what it measured.

#include <quality/measure.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace carlo {

/// quality.csv: a line for each row. What is not known is left empty.
std::string quality_csv(const std::vector<QualityRow>& rows);

/// spectrum.csv: a line for each row and ring; its header alone in one dimension.
std::string spectrum_csv(const std::vector<QualityRow>& rows);

/// The script that draws both over N; the title stands on top.
std::string quality_script(const std::string& title, const std::vector<QualityRow>& rows);

nlohmann::json to_json(const QualityRow& row);

} // namespace carlo
