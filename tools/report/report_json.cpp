#include <report/report_json.h>

#include <mc/core/error.h>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

namespace nlohmann {

template <class T> struct adl_serializer<std::optional<T>> {
  static void to_json(json& j, const std::optional<T>& value) { j = value ? json(*value) : json(); }
  static void from_json(const json& j, std::optional<T>& value) {
    if (!j.is_null()) value = j.get<T>();
  }
};

} // namespace nlohmann

namespace mc {

namespace {

// Enumerations are stored as the words of name().
template <class E> E from_word(const std::string& word) {
  for (int i = 0;; ++i) {
    const auto known = name(static_cast<E>(i));
    if (known == word) return static_cast<E>(i);
    require(!known.empty(), "'{}' is not a verdict, fault or axis scale of a report", word);
  }
}

} // namespace

void to_json(nlohmann::json& j, Verdict v) { j = name(v); }
void from_json(const nlohmann::json& j, Verdict& v) { v = from_word<Verdict>(j.get<std::string>()); }
void to_json(nlohmann::json& j, Fault f) { j = name(f); }
void from_json(const nlohmann::json& j, Fault& f) { f = from_word<Fault>(j.get<std::string>()); }
void to_json(nlohmann::json& j, Axis::Scale s) { j = name(s); }
void from_json(const nlohmann::json& j, Axis::Scale& s) { s = from_word<Axis::Scale>(j.get<std::string>()); }

// Lists each field once, for both directions.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Axis, name, scale, a, b)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Check, name, verdict, p, share, statistic, limit, fault, detail)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WorstCell, lo, hi, observed, expected, z, where)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CellCount, lo, hi, observed, expected)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PlotData::PValueAfter, samples, p)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PlotData, cells, outcomes, p_after)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedValue, name, value, std_error, where)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(UntriedLaw, name, reason)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Report, subject, alpha, samples, mass, mass_error, detectable, detectable_cell,
                                   seconds, ns_per_sample, checks, axes, worst, evidence, figures, untried)

namespace {

// Fails to compile after a field is added; list the field above as well.
[[maybe_unused]] void every_field(Report& r, Check& c, Axis& x) {
  [[maybe_unused]] auto& [r1, r2, r3, r4, r5, r6, r7, r8, r9, r10, r11, r12, r13, r14, r15] = r;
  [[maybe_unused]] auto& [c1, c2, c3, c4, c5, c6, c7, c8] = c;
  [[maybe_unused]] auto& [x1, x2, x3, x4] = x;
}

} // namespace

} // namespace mc

namespace carlo {

nlohmann::json to_json(const mc::Report& report) {
  nlohmann::json j = report;
  if (!report.evidence) j.erase("evidence");
  return j;
}

mc::Report report_from_json(const nlohmann::json& json) {
  try {
    nlohmann::json whole = json;
    if (!whole.contains("evidence")) whole["evidence"] = nullptr;
    return whole.get<mc::Report>();
  } catch (const nlohmann::json::exception& e) {
    throw mc::Error(fmt::format("the report is damaged: {}", e.what()));
  }
}

} // namespace carlo
