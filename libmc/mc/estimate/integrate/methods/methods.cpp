#include <mc/core/text.h>
#include <mc/estimate/integrate/methods/methods.h>

#include <array>

namespace mc {

namespace detail {
std::span<const MethodRow> method_rows() {
  static constexpr std::array<MethodRow, 6> rows = {{
      {Method::automatic, "auto",
       "Starts with rqmc; learns a density if much is missing, and keeps what promises the least error.", true,
       run_automatic},
      {Method::plain, "plain", "Independent points; the error falls like N^-1/2 for any integrand.", false, run_plain},
      {Method::stratified, "stratified", "Jittered points, one in each box of a grid; for up to four dimensions.",
       false, run_stratified},
      {Method::rqmc, "rqmc", "Randomised quasi-Monte Carlo: replicates of scrambled Sobol' sequences.", false,
       run_rqmc},
      {Method::vegas, "vegas", "rqmc with importance sampling by a grid learned along each axis.", true, run_vegas},
      {Method::tree, "tree", "rqmc with importance sampling by a learned grid and a tree of boxes within it.", true,
       run_tree},
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
