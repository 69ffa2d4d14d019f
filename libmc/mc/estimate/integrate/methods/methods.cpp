#include <mc/core/text.h>
#include <mc/estimate/integrate/methods/methods.h>

#include <array>

namespace mc {

namespace detail {
std::span<const MethodRow> method_rows() {
  static constexpr std::array<MethodRow, 6> rows = {{
      {Method::automatic, "auto", true, run_automatic},
      {Method::plain, "plain", false, run_plain},
      {Method::stratified, "stratified", false, run_stratified},
      {Method::rqmc, "rqmc", false, run_rqmc},
      {Method::vegas, "vegas", true, run_vegas},
      {Method::tree, "tree", true, run_tree},
  }};
  return rows;
}
} // namespace detail

std::string_view name(Method method) { return detail::method_rows()[static_cast<std::size_t>(method)].name; }

Method parse_method(std::string_view word) {
  std::vector<std::string_view> names;
  for (const detail::MethodRow& row : detail::method_rows()) names.push_back(row.name);
  return static_cast<Method>(index_of("method", word, names));
}

} // namespace mc
