#pragma once
/// The page of carlo validate.

#include <mc/check/report/report.h>

#include <string>
#include <string_view>

namespace carlo {

/// The cells of a case as text, see packed(): one digit per inner node of their kd-tree in heap order (the axis), then
/// a split per inner node, the observed counts and the expected counts. Neighbours are joined until at most `most`
/// cells remain.
std::string pack_tree(const mc::PlotData& evidence, int dim, std::size_t most);

/// Observed, then expected counts of the outcomes as text, see packed(). Neighbours are joined until at most `most`
/// remain.
std::string pack_outcomes(const mc::PlotData& evidence, std::size_t most);

/// The page: one HTML file that contains its script and its data. `data` is JSON, see tools/report/README.md.
std::string fill_page_template(std::string_view data);

} // namespace carlo
