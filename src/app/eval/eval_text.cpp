// The results of `barehand eval` as text tables for the user.
#include "app/eval/eval_report.h"
#include "core/format.h"
#include "math/angles.h"

namespace barehand {
namespace {

void print_head(std::string& out, const char* unit) {
  out += formatted("  %-22s %7s %7s %7s %7s %7s %7s %7s %7s %7s\n", unit, "count", "mean", "median", "min", "q1", "q3",
                   "90%", "95%", "max");
}

void print_row(std::string& out, const std::string& name, const Distribution& d, double scale) {
  if (d.count == 0) {
    out += formatted("  %-22s %7d       -\n", name.c_str(), 0);
    return;
  }
  out += formatted("  %-22s %7zu %7.2f %7.2f %7.2f %7.2f %7.2f %7.2f %7.2f %7.2f\n", name.c_str(), d.count,
                   d.mean * scale, d.median * scale, d.min * scale, d.quartile1 * scale, d.quartile3 * scale,
                   d.p90 * scale, d.p95 * scale, d.max * scale);
}

/// Frame numbers with ranges, for example "3, 7-12, 20".
std::string frame_list(const std::vector<std::int64_t>& numbers) {
  std::string text;

  // Find the end of a run of consecutive numbers.
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i;
    while (end + 1 < numbers.size() && numbers[end + 1] == numbers[end] + 1) ++end;

    // Append it as a single number or as a range.
    if (!text.empty()) text += ", ";
    text += std::to_string(numbers[i]);
    if (end > i) text += formatted("-%lld", static_cast<long long>(numbers[end]));
    i = end + 1;
  }
  return text;
}

/// Prints the frames in which a hand was reported although there was none, and how long it took to track a returning
/// hand.
void print_false_hands_and_returns(std::string& out, const Evaluation& e) {
  if (!e.false_hands.empty()) out += "  frames with a hand although there is none: " + frame_list(e.false_hands) + "\n";
  if (e.returns.empty()) return;
  out += formatted("  %zu returns into view (frame: frames until tracked):", e.returns.size());
  for (const Return& r : e.returns)
    out += formatted(" %lld: %s", static_cast<long long>(r.number),
                     r.frames ? std::to_string(*r.frames).c_str() : "never");
  out += "\n";
}

void print_run(std::string& out, const EvaluatedRun& run, const std::optional<double>& hand_length) {
  // Print what was compared, and how many frames were tracked.
  const Evaluation& e = run.evaluation;
  out += formatted("%s: %s against %s\n", run.label.c_str(), run.result_path.c_str(), run.truth_path.c_str());
  if (run.truncated) out += formatted("  the result is truncated; its incomplete last frame is ignored\n");
  out += formatted("  frames %zu, tracked %zu, lost %zu (%zu without a hand, %zu off by more than %.0f mm)\n",
                   e.frames.size(), e.frames.size() - e.untracked, e.lost.size(), e.untracked,
                   e.lost.size() - e.untracked, kLostFrameError * kMillimetre);

  // Print the frames that were lost.
  if (!e.lost.empty()) out += "  lost: " + frame_list(e.lost) + "\n";
  print_false_hands_and_returns(out, e);

  // Print the distributions of the errors.
  print_head(out, "error [mm]");
  print_row(out, "frame", e.frame_error, kMillimetre);
  print_row(out, "frame without palm", e.frame_error_without_palm, kMillimetre);
  print_row(out, "segment", e.segment_error, kMillimetre);
  print_row(out, "segment seen", e.seen, kMillimetre);
  print_row(out, "segment hidden", e.hidden, kMillimetre);
  for (int s = 0; s < kSegmentCount; ++s) print_row(out, std::string(kSegmentNames[s]), e.per_segment[s], kMillimetre);

  // Print the mean error relative to the hand's length, and the joint gap.
  if (hand_length && e.frame_error.count > 0)
    out += formatted("  mean frame error = %.2f %% of a hand length of %.0f mm\n",
                     e.frame_error.mean / *hand_length * 100, *hand_length * kMillimetre);
  if (e.joint_gap.count > 0)
    out += formatted("  joint gap of the result: mean %.3f mm, deviation %.3f mm (0 for a closed chain)\n",
                     e.joint_gap.mean * kMillimetre, e.joint_gap.deviation * kMillimetre);
  out += "\n";
}

void print_fingertips(std::string& out, const FingertipEvaluation& e) {
  out += formatted("fingertips: %zu labels, %zu in frames without a hand\n", e.labels, e.missing);
  print_head(out, "distance [px]");
  print_row(out, "all", e.all, 1);
  for (int f = 0; f < kFingerCount; ++f) print_row(out, std::string(kFingerNames[f]), e.per_finger[f], 1);
}

/// Prints how often the truth lies within the stated 90 % intervals, and the stated and actual size of the errors.
void print_coverage(std::string& out, const char* name, const Coverage& c) {
  if (c.intervals == 0) return;
  out += formatted("  %-22s %9zu %9.1f %% %12.2f %12.2f\n", name, c.intervals, c.covered * 100, c.stated * kMillimetre,
                   c.actual * kMillimetre);
}

/// Prints stated and actual values, one line per bin.
void print_bins(std::string& out, const char* title, const std::vector<ReliabilityBin>& bins, double scale) {
  out += formatted("  %-22s %9s %12s %12s\n", title, "count", "stated", "actual");
  for (const ReliabilityBin& bin : bins)
    out += formatted("  %-22s %9zu %12.2f %12.2f\n", "", bin.count, bin.stated * scale, bin.actual * scale);
}

void print_reliability(std::string& out, const Reliability& r) {
  out += formatted("stated uncertainty, %zu frames\n", r.frames);
  out += formatted("  %-22s %9s %11s %12s %12s\n", "90 % intervals", "count", "covered", "stated [mm]", "actual [mm]");
  print_coverage(out, "all", r.all);
  print_coverage(out, "seen", r.seen);
  print_coverage(out, "inferred", r.inferred);
  print_bins(out, "error of an end [mm]", r.errors, kMillimetre);
  print_bins(out, "within 10 mm [%]", r.confidences, 100);
}

void print_touches(std::string& out, const char* name, const TouchCounts& c) {
  out += formatted("  %-22s %9zu %9zu %9zu %9zu %10.3f %10.3f %10.3f\n", name, c.right, c.wrong, c.missed, c.unknown,
                   c.precision(), c.recall(), c.f1());
}

void print_contacts(std::string& out, const ContactEvaluation& e) {
  out += formatted("touches of an object (within %.0f mm), %zu frames\n", kTouchDistance * kMillimetre, e.frames);
  out += formatted("  %-22s %9s %9s %9s %9s %10s %10s %10s\n", "", "right", "wrong", "missed", "unknown", "precision",
                   "recall", "F1");
  print_touches(out, "fingertips visible", e.visible_tips);
  print_touches(out, "fingertips in part", e.partial_tips);
  print_touches(out, "fingertips hidden", e.hidden_tips);
  print_touches(out, "all segments", e.segments);
  print_bins(out, "touching [%]", e.probabilities, 100);
}

void print_grasp_row(std::string& out, const std::string& name, const GraspCounts& c, const std::string& rest) {
  out += formatted("  %-22s %9zu %9.1f %9.1f %9.1f %9.1f %s\n", name.c_str(), c.frames, 100 * c.fraction(c.right),
                   100 * c.fraction(c.right_kind), 100 * c.fraction(c.confident_wrong), 100 * c.fraction(c.unknown),
                   rest.c_str());
}

/// Which other class was stated most often.
std::string mistaken_for(const GraspCounts& counts, int truth) {
  int most = -1;
  for (int k = 0; k < kGraspCount; ++k)
    if (k != truth && counts.stated[k] > (most < 0 ? 0 : counts.stated[most])) most = k;
  return most < 0
             ? ""
             : formatted("%s %.1f", std::string(grasp_name(most)).c_str(), 100 * counts.fraction(counts.stated[most]));
}

void print_grasps(std::string& out, const GraspEvaluation& e) {
  out += formatted("grasps, %.0f s held, %.2f changes of the stated class a second\n", e.held_seconds,
                   e.changes_per_second());
  out += formatted("  %-22s %9s %9s %9s %9s %9s %s\n", "[%]", "frames", "class", "kind", "sure+wrong", "unknown",
                   "most often taken for");
  print_grasp_row(out, "held", e.held, "");
  for (int k = 0; k < kGraspCount; ++k) {
    const GraspCounts& counts = e.classes[k];
    if (counts.frames > 0) print_grasp_row(out, std::string(grasp_name(k)), counts, mistaken_for(counts, k));
  }
  print_bins(out, "class [%]", e.probabilities, 100);
}

void print_object(std::string& out, const ObjectEvaluation& e) {
  out += formatted("object %s: %zu frames, stated %zu, lost %zu\n", e.name.c_str(), e.frames, e.stated, e.lost);
  for (const double moved : e.symmetries)
    out +=
        formatted("  half a turn that moves the surface by %.2f mm in the mean counts as none\n", kMillimetre * moved);
  if (e.turned > 0) out += formatted("  %zu poses are stated half a turn from the truth\n", e.turned);
  print_head(out, "error");
  print_row(out, "position [mm]", e.position, kMillimetre);
  print_row(out, "rotation [degrees]", e.rotation, 1 / kDegree);
  print_row(out, "surface [mm]", e.surface, kMillimetre);
}

}  // namespace

std::string text_report(const EvalReport& report) {
  std::string out;
  for (const EvaluatedRun& run : report.runs) print_run(out, run, report.hand_length);
  if (report.fingertips) print_fingertips(out, *report.fingertips);
  if (report.reliability) print_reliability(out, *report.reliability);
  if (report.contacts) print_contacts(out, *report.contacts);
  if (report.grasps) print_grasps(out, *report.grasps);
  for (const ObjectEvaluation& object : report.objects) print_object(out, object);
  return out;
}

}  // namespace barehand
