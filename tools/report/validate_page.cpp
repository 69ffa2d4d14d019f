#include <report/packed.h>
#include <report/page_template.h>
#include <report/validate_page.h>
#include <validate_page_parts.h>

#include <algorithm>
#include <bit>
#include <vector>

namespace carlo {
namespace {

mc::CellCount join(const mc::CellCount& a, const mc::CellCount& b) {
  mc::CellCount c{a.lo, a.hi, a.observed + b.observed, a.expected + b.expected};
  for (std::size_t d = 0; d < 3; ++d) {
    c.lo[d] = std::min(a.lo[d], b.lo[d]);
    c.hi[d] = std::max(a.hi[d], b.hi[d]);
  }
  return c;
}

} // namespace

std::string pack_tree(const mc::PlotData& evidence, int dim, std::size_t most) {
  const std::size_t n = evidence.cells.size();
  if (n == 0) return {};
  std::vector<mc::CellCount> nodes(2 * n); // heap order, root at 1
  std::copy(evidence.cells.begin(), evidence.cells.end(), nodes.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t i = n; i-- > 1;) nodes[i] = join(nodes[2 * i], nodes[2 * i + 1]);
  const std::size_t kept = std::min(n, std::bit_floor(most));
  std::string split_axes;
  std::vector<float> numbers;
  for (std::size_t i = 1; i < kept; ++i) {
    const mc::CellCount &left = nodes[2 * i], &right = nodes[2 * i + 1];
    std::size_t axis = 0;
    while (axis + 1 < static_cast<std::size_t>(dim) &&
           !(left.hi[axis] == right.lo[axis] && left.lo[axis] < right.lo[axis]))
      ++axis;
    split_axes += static_cast<char>('0' + axis);
    numbers.push_back(static_cast<float>(right.lo[axis]));
  }
  for (std::size_t i = kept; i < 2 * kept; ++i) numbers.push_back(static_cast<float>(nodes[i].observed));
  for (std::size_t i = kept; i < 2 * kept; ++i) numbers.push_back(static_cast<float>(nodes[i].expected));
  return packed(split_axes, numbers);
}

std::string pack_outcomes(const mc::PlotData& evidence, std::size_t most) {
  const std::size_t n = evidence.outcomes.size(), kept = std::min(n, most);
  std::vector<float> numbers(2 * kept);
  for (std::size_t k = 0; k < kept; ++k) {
    mc::CellCount sum;
    for (std::size_t i = k * n / kept; i < (k + 1) * n / kept; ++i) sum = join(sum, evidence.outcomes[i]);
    numbers[k] = static_cast<float>(sum.observed);
    numbers[kept + k] = static_cast<float>(sum.expected);
  }
  return packed("", numbers);
}

std::string fill_page_template(std::string_view data) {
  return filled(page_html, {{"@CSS@", page_css},
                            {"@MAPS@", std::string(page_unpack_js) + page_maps_js},
                            {"@JS@", page_js},
                            {"@DATA@", script_safe(data)}});
}

} // namespace carlo
