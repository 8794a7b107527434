// Compares one result of a tracker with the truth.
#include "app/eval/eval_report.h"

namespace barehand {

Result<EvaluatedRun> evaluate_run(const std::string& label, const std::string& truth_path,
                                  const std::string& result_path, const ResultTable& result,
                                  const ExpectedFrames& expected) {
  const auto truth = read_table(truth_path);
  if (!truth) return tl::unexpected(truth.error());
  auto evaluation = evaluate(*truth, result, expected);
  if (!evaluation) {
    evaluation.error().where = result_path + " against " + truth_path;
    return tl::unexpected(evaluation.error());
  }
  return EvaluatedRun{label, truth_path, result_path, result.truncated, std::move(*evaluation)};
}

}  // namespace barehand
