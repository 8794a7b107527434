#include "evaluation/grasp_evaluation.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "io/file_bytes.h"
#include "io/hand/table_fields.h"

namespace barehand {
namespace {

/// Whether the truth has a grasp within kClosingUs of this time.
bool near_a_grasp(const GraspTruth& truth, std::int64_t utime) {
  for (auto at = truth.lower_bound(utime - kClosingUs); at != truth.end() && at->first <= utime + kClosingUs; ++at)
    if (at->second != 0) return true;
  return false;
}

GraspKind kind_of(int grasp) {
  return grasp == 0 ? GraspKind::none : grasp_types()[static_cast<std::size_t>(grasp - 1)].kind;
}

void count(GraspCounts& counts, int truth, const StatedGrasp& stated) {
  ++counts.frames;
  if (!stated.known) {
    ++counts.unknown;
    return;
  }
  const bool right = stated.grasp == truth;
  counts.right += right;
  counts.right_kind += stated.kind == kind_of(truth);
  counts.confident_wrong += !right && stated.probability >= kConfidentGrasp;
  ++counts.stated[static_cast<std::size_t>(stated.grasp)];
}

/// Counts how often the stated class changes while one grasp lasts, and how long it lasts.
void count_changes(const GraspSequence& sequence, GraspEvaluation& out) {
  std::optional<int> last;
  std::int64_t last_utime = 0;
  int last_truth = 0;
  for (const auto& [utime, truth] : sequence.truth) {
    // Add up the time of the grasp, and forget the class stated for an earlier one.
    const bool lasts = truth != 0 && truth == last_truth;
    if (lasts) out.held_seconds += 1e-6 * static_cast<double>(utime - last_utime);
    if (!lasts) last.reset();
    last_truth = truth;
    last_utime = utime;

    // A frame in which nothing is stated changes nothing.
    const auto stated = sequence.stated.find(utime);
    if (truth == 0 || stated == sequence.stated.end() || !stated->second.known) continue;
    out.changes += last && *last != stated->second.grasp;
    last = stated->second.grasp;
  }
}

}  // namespace

Result<GraspTruth> read_grasp_truth(const std::string& path) {
  // Read the file, and check that it is a table of grasps.
  auto content = read_text(path);
  if (!content) return tl::unexpected(content.error());
  std::istringstream file(std::move(*content));
  std::string line;
  std::getline(file, line);
  if (line != "utime,grasp")
    return fail("line 1 is not the header of a table of grasps", path, "it must be \"utime,grasp\"");

  // Read line by line; 0 stands for no grasp.
  GraspTruth truth;
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.empty()) continue;
    const auto fields = split_fields(line);

    // Read the time of the row, and its class or "none".
    std::int64_t utime = 0;
    const bool two = fields.size() == 2 && parse_number(fields[0], utime);
    const auto type = two ? grasp_type_from_name(fields[1]) : std::nullopt;
    if (!type && !(two && fields[1] == "none"))
      return fail("line " + std::to_string(number) + ": is \"" + line + "\"", path,
                  "a line is a time and none or the name of a class (docs/grasps.md)");
    truth[utime] = type ? 1 + *type : 0;
  }
  return truth;
}

Result<GraspEvaluation> evaluate_grasps(const std::vector<GraspSequence>& sequences) {
  GraspEvaluation out;
  ProbabilityBins bins;

  // Visit the frames of the truth, and count those that are stated too.
  for (const GraspSequence& sequence : sequences) {
    std::size_t common = 0;
    for (const auto& [utime, truth] : sequence.truth) {
      const auto found = sequence.stated.find(utime);
      common += found != sequence.stated.end();

      // Count the frame by its class, but leave out frames without a grasp that are close to one.
      if (truth == 0 && near_a_grasp(sequence.truth, utime)) continue;
      const StatedGrasp stated = found == sequence.stated.end() ? StatedGrasp() : found->second;
      count(out.classes[static_cast<std::size_t>(truth)], truth, stated);
      if (truth != 0) count(out.held, truth, stated);

      // Compare the probability.
      if (stated.known) bins.add(stated.probability, stated.grasp == truth);
    }

    // Reject a sequence that shares no frame with its truth.
    if (common == 0)
      return fail("have no frame in common with the truth", "the grasps", "give the truth of the same recording");
    count_changes(sequence, out);
  }

  out.probabilities = bins.means();
  return out;
}

}  // namespace barehand
