#pragma once
/// Colours of measured curves.

#include <converge/trade.h>

#include <optional>
#include <string>
#include <vector>

namespace carlo {

inline constexpr std::size_t curve_color_count = 8;

/// How a curve is drawn.
struct CurveStyle {
  std::optional<std::size_t> color; ///< index below curve_color_count; nothing: grey
  bool is_cheapest = false;         ///< costs least for one of the wanted errors
  bool is_most_accurate = false;    ///< has the smallest error for one of the wanted costs

  bool wins() const { return is_cheapest || is_most_accurate; }
};

/// The style of each curve of a measurement. Up to eight curves have the colours of their positions. Of more curves
/// eight have a colour, in this order: the winners of the answers, plain Monte Carlo, the other candidates by rank, the
/// curves with the smallest error at their largest N.
///   answers : of carlo trade; may be null
std::vector<CurveStyle> curve_styles(const Measurement& m, const TradeResults* trade_results);

/// Indices of the curves: the grey ones, then the others in the order of their colours.
std::vector<std::size_t> drawing_order(const std::vector<CurveStyle>& styles);

/// "#2160c2": a colour for white ground.
std::string color_on_white(const CurveStyle& style);

/// "var(--curve-0)": a colour of a page that contains curve_color_css().
std::string page_color(const CurveStyle& style);

/// CSS that defines the colours for light and dark pages.
std::string curve_color_css();

} // namespace carlo
