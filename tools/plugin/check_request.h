#pragma once
/// The request to check one sampler of external code.

#include <catalogue/catalogue.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace carlo {

/// The fields that every such request contains; the task adds fields that identify the sampler.
nlohmann::json check_request(const char* task, const std::string& who, const std::string& title,
                             const CaseOptions& options);

/// Decodes the options of a request in the worker.
CaseOptions requested_options(const nlohmann::json& request);

} // namespace carlo
