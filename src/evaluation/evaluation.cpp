#include "evaluation/evaluation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

namespace barehand {
namespace {

// Compares a result with the truth frame by frame, and summarises the errors.

using FramesByNumber = std::map<std::int64_t, const TableFrame*>;

FramesByNumber by_number(const ResultTable& table) {
  FramesByNumber frames;
  for (const TableFrame& frame : table.frames) frames[frame.number] = &frame;
  return frames;
}

FrameErrors frame_errors(const TableFrame& truth, const TableFrame& result) {
  FrameErrors errors{truth.number, truth.timestamp, true, {}, 0, 0};
  double sum = 0;
  for (int s = 0; s < kSegmentCount; ++s) {
    errors.segments[s] = segment_error(truth.rows[s], result.rows[s]);
    sum += errors.segments[s];
  }
  errors.mean = sum / kSegmentCount;
  errors.mean_without_palm = (sum - errors.segments[kPalm]) / (kSegmentCount - 1);
  return errors;
}

/// The frames of the truth that the run was meant to track.
std::vector<const TableFrame*> expected_frames(const ResultTable& truth, const ExpectedFrames& expected) {
  std::vector<const TableFrame*> frames;
  if (truth.frames.empty()) return frames;

  // If no start is given, the run begins at the first frame, or at the last one if it is played backwards.
  const auto [first, last] =
      std::minmax_element(truth.frames.begin(), truth.frames.end(),
                          [](const TableFrame& a, const TableFrame& b) { return a.number < b.number; });
  const std::int64_t start = expected.start.value_or(expected.step > 0 ? first->number : last->number);

  // Keep every step-th frame from there on.
  for (const TableFrame& frame : truth.frames) {
    const std::int64_t from_start = frame.number - start;
    if (from_start % expected.step == 0 && from_start / expected.step >= 0) frames.push_back(&frame);
  }
  return frames;
}

/// All individual values of an evaluation before they are summarised.
struct Collected {
  std::vector<double> frame, without_palm, all, seen, hidden, gap;
  std::array<std::vector<double>, kSegmentCount> segment;

  void add(const FrameErrors& errors, const TableFrame& truth, const TableFrame& result) {
    frame.push_back(errors.mean);
    without_palm.push_back(errors.mean_without_palm);
    for (int s = 0; s < kSegmentCount; ++s) {
      all.push_back(errors.segments[s]);
      segment[s].push_back(errors.segments[s]);
      if (truth.rows[s].visible > kSeen) seen.push_back(errors.segments[s]);
      if (truth.rows[s].visible < kHidden) hidden.push_back(errors.segments[s]);
      // Leave out the joints of the palm, of which only the middle finger's knuckle is at the palm's distal end.
      if (s != kPalm && parent_of(s) != kPalm)
        gap.push_back((result.rows[parent_of(s)].distal - result.rows[s].proximal).norm());
    }
  }
  void summarise_into(Evaluation& evaluation) const {
    evaluation.frame_error = summarise(frame);
    evaluation.frame_error_without_palm = summarise(without_palm);
    evaluation.segment_error = summarise(all);
    evaluation.seen = summarise(seen);
    evaluation.hidden = summarise(hidden);
    evaluation.joint_gap = summarise(gap);
    for (int s = 0; s < kSegmentCount; ++s) evaluation.per_segment[s] = summarise(segment[s]);
  }
};

bool half_in_view(const TableFrame& truth) {
  double visible = 0;
  for (const TableRow& row : truth.rows) visible += row.visible / kSegmentCount;
  return visible >= 0.5;
}

/// Finds the returns of the hand into view. `truths` and `frames` correspond: every `step`-th frame of the recording
/// in which there is a hand, played backwards if `step` is negative.
std::vector<Return> find_returns(const std::vector<const TableFrame*>& truths, const std::vector<FrameErrors>& frames,
                                 std::int64_t step) {
  // While the hand is out of view, the truth has no rows, so there is a gap in its frame numbers.
  std::vector<Return> returns;
  bool away = false, waiting = false;
  const auto played = [&](std::size_t i) { return step > 0 ? i : frames.size() - 1 - i; };
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const FrameErrors& frame = frames[played(i)];
    if (frame.number - frames[played(i - 1)].number != step) away = true, waiting = false;

    // A return begins when half of the hand is visible, and ends with the first frame that is not lost.
    if (away && half_in_view(*truths[played(i)])) {
      returns.push_back({frame.number, std::nullopt});
      away = false;
      waiting = true;
    }

    // Store how many frames the hand took to be found again.
    if (!waiting || frame.lost()) continue;
    returns.back().frames = static_cast<int>((frame.number - returns.back().number) / step);
    waiting = false;
  }
  return returns;
}

/// Frames of the result, between the truth's first and last frame, for which the truth has no rows.
std::vector<std::int64_t> find_false_hands(const ResultTable& truth, const ResultTable& result) {
  const FramesByNumber truths = by_number(truth);
  std::vector<std::int64_t> false_hands;
  for (const auto& [number, frame] : by_number(result))
    if (number > truths.begin()->first && number < truths.rbegin()->first && !truths.contains(number))
      false_hands.push_back(number);
  return false_hands;
}

}  // namespace

double segment_error(const TableRow& truth, const TableRow& result) {
  return 0.5 * ((truth.proximal - result.proximal).norm() + (truth.distal - result.distal).norm());
}

Result<Evaluation> evaluate(const ResultTable& truth, const ResultTable& result, const ExpectedFrames& expected) {
  // Compare the result with the truth frame by frame.
  assert(expected.step != 0);
  const FramesByNumber results = by_number(result);
  Evaluation evaluation;
  Collected collected;
  const std::vector<const TableFrame*> truths = expected_frames(truth, expected);
  for (const TableFrame* frame_of_truth : truths) {
    const TableFrame& frame = *frame_of_truth;
    // A frame without rows in the result stays untracked.
    FrameErrors errors{frame.number, frame.timestamp, false, {}, 0, 0};

    // Compare the poses if the result has the frame, which must then have the time stamp of the truth.
    if (const auto found = results.find(frame.number); found != results.end()) {
      if (!same_time(found->second->timestamp, frame.timestamp))
        return fail("frame " + std::to_string(frame.number) + " has other time stamps in truth and result", {},
                    "compare tables of the same recording");
      errors = frame_errors(frame, *found->second);
      collected.add(errors, frame, *found->second);
    } else {
      ++evaluation.untracked;
    }

    // Store the errors, also those of a lost frame.
    if (errors.lost()) evaluation.lost.push_back(frame.number);
    evaluation.frames.push_back(errors);
  }

  // Report tables that do not belong together.
  if (collected.frame.empty() && !result.frames.empty())
    return fail("truth and result have no frame in common", {}, "compare tables of the same recording");
  if (evaluation.frames.empty()) return fail("the truth has none of the requested frames", {}, "check start and step");

  // Summarise the errors.
  collected.summarise_into(evaluation);
  evaluation.returns = find_returns(truths, evaluation.frames, expected.step);
  evaluation.false_hands = find_false_hands(truth, result);
  return evaluation;
}

}  // namespace barehand
