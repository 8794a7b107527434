// Determines which sides and joints of the hand a scan has not seen yet.
#include "app/calibrate/scan_report.h"

#include <algorithm>

#include "core/quote.h"
#include "hand/joint_angles.h"

namespace barehand {
namespace {

constexpr double kFacing = 0.5;  // cosine of the angle between the line of sight and a side's normal: 60 degrees

}  // namespace

void ScanReport::add(const HandEstimate& estimate) {
  if (estimate.status != TrackStatus::tracking) return;
  const HandPose pose = pose_of(estimate.segments);
  for (int s = 0; s < kSegmentCount; ++s) {
    ScannedSegment& segment = segments_[s];

    if (!estimate.segments[s].seen) continue;
    const double back = -pose[s].R.col(1).dot(pose[s].t.normalized());  // cosine; +y points out of the back of the hand
    if (back > kFacing) ++segment.back_side;
    if (back < -kFacing) ++segment.palm_side;

    // Extend the range of flexion.
    const double bent = joint_angles(*estimate.profile, pose, s).flexion;
    segment.least_bent = segment.seen == 0 ? bent : std::min(segment.least_bent, bent);
    segment.most_bent = segment.seen == 0 ? bent : std::max(segment.most_bent, bent);
    ++segment.seen;
  }
  ++frames_;
}

std::vector<std::string> ScanReport::missing() const {
  // Find the segments whose palm or back side was seen in too few frames, or that were bent too little.
  std::vector<std::string> palm_sides, back_sides, stiff, sentences;
  for (int s = 0; s < kSegmentCount; ++s) {
    const ScannedSegment& segment = segments_[s];
    const std::string name(kSegmentNames[s]);
    if (segment.palm_side < kEnoughFrames) palm_sides.push_back(name);
    if (segment.back_side < kEnoughFrames) back_sides.push_back(name);
    if (asks_to_bend(s) && segment.most_bent - segment.least_bent < kEnoughBending) stiff.push_back(name);
  }

  // Ask for these views and motions, in one sentence per kind.
  if (!palm_sides.empty()) sentences.push_back("show the palm side of: " + comma_list(palm_sides));
  if (!back_sides.empty()) sentences.push_back("show the back of: " + comma_list(back_sides));
  if (!stiff.empty()) sentences.push_back("bend and stretch: " + comma_list(stiff));
  return sentences;
}

}  // namespace barehand
