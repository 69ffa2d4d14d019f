#pragma once
/// Measured curves drawn as SVG.

#include <converge/curve_style.h>

#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// The horizontal axis of a panel.
struct PanelOptions {
  std::string_view axis; ///< its label
  double (*x)(const mc::RmsError& e);
  bool theory = false;                        ///< dotted lines with the slopes of theory
  std::vector<TradeCandidate> pareto_front{}; ///< a broad line through these, where x is the cost
};

/// An SVG element: the RMS errors with their 95 % bands, both axes logarithmic; empty where no error is above 0. Grey
/// curves have no band. Winners are drawn last, broader, and with their names.
///   styles : of the curves, in their order
std::string error_panel(const std::vector<ConvergenceCurve>& curves, const std::vector<CurveStyle>& styles,
                        const PanelOptions& options);

} // namespace carlo
