#pragma once
/// Reports as JSON and back: what --json writes, and what one process of carlo tells another.

#include <mc/check/report/report.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace carlo {

/// Every field by its name, enumerations by their words. The evidence is there only where the report has it.
nlohmann::json to_json(const mc::Report& report);

/// The report that to_json was given, bit for bit as long as the JSON was kept as CBOR; as text, what is not finite is
/// null and cannot be read back.
///   throws : Error for JSON that to_json did not make
mc::Report report_from_json(const nlohmann::json& json);

/// As text for a file, indented by one blank; not finite numbers are null, bytes that are no UTF-8 are replaced.
std::string json_text(const nlohmann::json& json);

} // namespace carlo
