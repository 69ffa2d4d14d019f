#pragma once
/// Reports as JSON and back, for the option --json and for messages between processes of carlo.

#include <mc/check/report/report.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace carlo {

/// Returns every field by its name and enumerations as words. The evidence is present only if the report has it.
nlohmann::json to_json(const mc::Report& report);

/// Returns the report that was passed to to_json. CBOR preserves it bit for bit; in text, numbers that are not finite
/// become null and cannot be read back.
///   throws : Error for JSON that to_json did not create.
mc::Report report_from_json(const nlohmann::json& json);

/// Returns text for a file, indented by one blank. Numbers that are not finite become null; bytes that are not UTF-8
/// are replaced.
template <class Json> std::string json_text(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace carlo
