#include "evaluation/contact_evaluation.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "io/file_bytes.h"
#include "io/hand/table_fields.h"

namespace barehand {
namespace {

constexpr double kVisible = 0.5, kHidden = 0.1;  // as in the evaluation of poses
constexpr double kFarthest = 1e6;                // largest distance of a valid row [m]

void count(TouchCounts& counts, const StatedContact& stated, bool touches) {
  counts.unknown += !stated.known;
  if (touches)
    ++(stated.touching ? counts.right : counts.missed);
  else
    ++(stated.touching ? counts.wrong : counts.none);
}

}  // namespace

Result<ContactTruth> read_contact_truth(const std::string& path) {
  // Read the file, and check that it is a table of contacts.
  auto content = read_text(path);
  if (!content) return tl::unexpected(content.error());
  std::istringstream file(std::move(*content));
  std::string line;
  std::getline(file, line);
  if (!line.starts_with("utime,segment,distance"))
    return fail("line 1 is not the header of a contact table", path, "it must begin with \"utime,segment,distance\"");

  // Read line by line; normals are not compared.
  ContactTruth truth;
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.empty()) continue;
    const auto fields = split_fields(line);
    std::int64_t utime = 0;
    TrueContact contact;

    // Check that the row names a segment and that its numbers are plausible.
    const auto segment = fields.size() >= 6 ? segment_from_name(fields[1]) : std::nullopt;
    bool good = segment && parse_number(fields[0], utime) && parse_number(fields[2], contact.distance) &&
                std::abs(contact.distance) <= kFarthest;
    for (int axis = 0; good && axis < 3; ++axis)
      good = parse_number(fields[3 + axis], contact.point[axis]) && std::abs(contact.point[axis]) <= kFarthest;
    if (!good)
      return fail("line " + std::to_string(number) + ": is \"" + line + "\"", path,
                  "a line begins with utime,segment,distance,x,y,z");

    // Enter it into its frame, where a segment without a row touches nothing.
    auto [frame, is_new] = truth.try_emplace(utime);
    if (is_new) frame->second.fill({kFarthest, Eigen::Vector3d::Constant(kFarthest)});
    frame->second[static_cast<std::size_t>(*segment)] = contact;
  }
  return truth;
}

Result<ContactEvaluation> evaluate_contacts(const std::vector<ContactSequence>& sequences) {
  ContactEvaluation out;
  ProbabilityBins bins;

  // Visit the frames that both the truth and the statements have.
  for (const auto& [poses, truth, stated] : sequences)
    for (const TableFrame& frame : poses.frames) {
      const auto utime = static_cast<std::int64_t>(std::llround(frame.timestamp * 1e6));
      const auto is = truth.find(utime);
      const auto said = stated.find(utime);
      if (is == truth.end() || said == stated.end()) continue;
      ++out.frames;

      // Compare segment by segment.
      for (int s = 0; s < kSegmentCount; ++s) {
        const bool touches = is->second[s].distance <= kTouchDistance;
        StatedContact contact = said->second[s];

        // A touch of something other than the object of the truth does not count as a touch of it.
        const bool of_other =
            !touches && contact.touching && (contact.point - is->second[s].point).norm() > kSameSurface;
        if (of_other) contact = {true, false, 0, contact.point};

        // Count it, among all segments and among the fingertips.
        count(out.segments, contact, touches);
        const double visible = frame.rows[s].visible;
        if (is_tip(s))
          count(visible > kVisible  ? out.visible_tips
                : visible < kHidden ? out.hidden_tips
                                    : out.partial_tips,
                contact, touches);

        // Compare the probability.
        if (contact.known && !of_other) bins.add(contact.probability, touches);
      }
    }

  // It is an error if there was nothing to compare.
  if (out.frames == 0)
    return fail("have no frame in common with the truth", "the contacts", "give the truth of the same recording");

  out.probabilities = bins.means();
  return out;
}

}  // namespace barehand
