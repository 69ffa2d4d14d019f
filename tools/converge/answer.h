#pragma once
/// The answer of carlo trade in words.

#include <converge/trade.h>

#include <string>

namespace carlo {

/// Sentences that name the cheapest method for each wanted error, and the most accurate one for each wanted cost.
/// Wanted values with the same winner share a sentence.
std::string answer_text(const Measurement& m, const TradeResults& trade_results);

} // namespace carlo
