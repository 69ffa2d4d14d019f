#include <report/projections.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

// Returns the side of one panel in pixels; more axes give smaller panels.
int side_of(int axes) {
  if (axes == 2) return 600;
  return axes <= 4 ? 300 : 180;
}

} // namespace

std::string projections_svg(mc::PointList points) {
  const int axes = static_cast<int>(std::min<std::size_t>(points.dim, 8));
  const int side = side_of(axes), gap = 28;
  const int width = (axes - 1) * (side + gap) + gap, height = width;
  const double dot = std::clamp(0.35 * side / std::sqrt(static_cast<double>(points.size())), 1.0, 6.0);
  std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" "
                                "font-family=\"sans-serif\" font-size=\"12\" fill=\"#333\">\n<rect width=\"100%\" "
                                "height=\"100%\" fill=\"#fff\"/>\n",
                                width, height);
  for (int y = 1; y < axes; ++y)
    for (int x = 0; x < y; ++x) {
      const int left = gap + x * (side + gap), top = (y - 1) * (side + gap) + gap / 2;
      svg +=
          fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#999\"/>\n"
                      "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text><text x=\"{}\" y=\"{}\" "
                      "text-anchor=\"end\">{}</text>\n<path fill=\"none\" stroke=\"#4477aa\" stroke-width=\"{:.3g}\" "
                      "stroke-linecap=\"round\" d=\"",
                      left, top, side, side, left + side / 2, top + side + 13, x, left - 6, top + side / 2, y, dot);
      for (std::size_t i = 0; i < points.size(); ++i) // a dot is a line of length 0 with round ends
        svg += fmt::format("M{:.1f} {:.1f}h0", left + side * points[i][x], top + side * (1 - points[i][y]));
      svg += "\"/>\n";
    }
  return svg + "</svg>\n";
}

} // namespace carlo
