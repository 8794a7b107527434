// Writes the decisions of a tracker to a table.
#include "io/hand/decision_table.h"

#include <cmath>

#include "core/format.h"

namespace barehand {
namespace {

constexpr std::string_view kHeader = "frame,timestamp,hand,rule,winner,winner_score,loser,loser_score,advantage";

std::string number(double value) { return std::isfinite(value) ? formatted("%.6f", value) : ""; }

}  // namespace

Result<DecisionTable> DecisionTable::create(const std::string& path, bool overwrite) {
  auto rows = RowFile::create(path, kHeader, overwrite);
  if (!rows) return tl::unexpected(rows.error());
  return DecisionTable(std::move(*rows));
}

Result<void> DecisionTable::write(const HandEstimate& estimate) {
  if (estimate.decisions.empty()) return {};
  text_.clear();
  for (const Decision& decision : estimate.decisions) {
    text_ +=
        formatted("%lld,%.6f,", static_cast<long long>(estimate.number), 1e-6 * static_cast<double>(estimate.utime));
    for (const std::string_view word : {to_string(estimate.handedness), decision.rule, decision.winner})
      text_.append(word).append(",");
    text_.append(number(decision.winner_score)).append(",").append(decision.loser).append(",");
    text_.append(number(decision.loser_score)).append(",").append(number(decision.advantage)).append("\n");
  }
  return rows_.write(text_);
}

}  // namespace barehand
