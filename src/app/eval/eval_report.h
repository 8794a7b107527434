#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "evaluation/contact_evaluation.h"
#include "evaluation/evaluation.h"
#include "evaluation/fingertips.h"
#include "evaluation/grasp_evaluation.h"
#include "evaluation/object_evaluation.h"
#include "evaluation/reliability.h"

namespace barehand {

// The results of `barehand eval`.

/// One result that was compared with its truth.
struct EvaluatedRun {
  std::string label, truth_path, result_path;
  bool truncated = false;  ///< the result ends in the middle of a frame
  Evaluation evaluation;
};

/// Compares `result`, read from `result_path`, with the truth in `truth_path`. Errors: a truth that cannot be read, and
/// those of evaluate().
Result<EvaluatedRun> evaluate_run(const std::string& label, const std::string& truth_path,
                                  const std::string& result_path, const ResultTable& result,
                                  const ExpectedFrames& expected = {});

/// All results of one run of `barehand eval`.
struct EvalReport {
  std::vector<EvaluatedRun> runs;
  std::optional<double> hand_length;  ///< length of the hand [m], to state errors as a fraction of it
  std::optional<FingertipEvaluation> fingertips;
  std::optional<Reliability> reliability;
  std::optional<ContactEvaluation> contacts;
  std::optional<GraspEvaluation> grasps;
  std::vector<ObjectEvaluation> objects;
};

/// The report as text tables, in millimetres and pixels.
std::string text_report(const EvalReport& report);
/// Writes the report as JSON, in millimetres and pixels.
Result<void> write_json_report(const EvalReport& report, const std::string& path);
/// Draws runs.png (paper Fig. 7), segments.png, time.png, fingertips.png, reliability.png and confidence.png, each if
/// the report has data for it. Creates the folder.
Result<void> write_plots(const EvalReport& report, const std::string& directory);

}  // namespace barehand
