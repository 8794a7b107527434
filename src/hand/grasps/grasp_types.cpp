#include "hand/grasps/grasp_types.h"

namespace barehand {

const std::array<GraspType, kGraspTypeCount>& grasp_types() {
  using enum GraspKind;
  constexpr auto kPalmHolds = Opposition::palm, kPads = Opposition::pad, kSides = Opposition::side;
  constexpr auto kAbducted = ThumbPosition::abducted, kAdducted = ThumbPosition::adducted;
  static constexpr std::array<GraspType, kGraspTypeCount> kTypes = {{
      // Power grasps.
      {"wrap", power, kPalmHolds, kAbducted, 2, 5, "large and small diameter, medium wrap, power disk, power sphere"},
      {"index_extension", power, kPalmHolds, kAdducted, 3, 5, "index finger extension"},
      {"thumb_along", power, kPalmHolds, kAdducted, 2, 5, "adducted thumb, light tool, fixed hook, palmar"},
      {"ring", power, kPads, kAbducted, 2, 2, "ring"},
      {"sphere_3", power, kPads, kAbducted, 2, 3, "sphere 3-finger"},
      {"sphere_4", power, kPads, kAbducted, 2, 4, "sphere 4-finger"},
      {"extension", power, kPads, kAbducted, 2, 5, "extension type, distal type"},

      // Intermediate grasps.
      {"adduction", intermediate, kSides, kAbducted, 2, 2, "adduction grip"},
      {"tripod_variation", intermediate, kSides, kAbducted, 3, 3, "tripod variation"},
      {"lateral_tripod", intermediate, kSides, kAbducted, 3, 4, "lateral tripod"},
      {"lateral", intermediate, kSides, kAdducted, 2, 2, "lateral, stick, ventral"},

      // Precision grasps.
      {"pinch", precision, kPads, kAbducted, 2, 2, "palmar pinch, tip pinch, inferior pincer"},
      {"tripod", precision, kPads, kAbducted, 2, 3, "prismatic 2-finger, tripod"},
      {"quadpod", precision, kPads, kAbducted, 2, 4, "prismatic 3-finger, quadpod"},
      {"five_fingers", precision, kPads, kAbducted, 2, 5, "prismatic 4-finger, precision disk and sphere"},
      {"parallel_extension", precision, kPads, kAdducted, 2, 5, "parallel extension"},
      {"writing_tripod", precision, kSides, kAbducted, 3, 3, "writing tripod"},
  }};
  return kTypes;
}

std::string_view grasp_name(int grasp) {
  if (grasp == 0) return "none";
  return grasp < 0 || grasp > kGraspTypeCount ? "unknown" : grasp_types()[static_cast<std::size_t>(grasp - 1)].name;
}

std::string_view kind_name(int kind) {
  constexpr std::array<std::string_view, 4> kNames = {"none", "power", "intermediate", "precision"};
  return kind < 0 || kind >= 4 ? "unknown" : kNames[static_cast<std::size_t>(kind)];
}

std::optional<int> grasp_type_from_name(std::string_view name) {
  for (std::size_t i = 0; i < grasp_types().size(); ++i)
    if (grasp_types()[i].name == name) return static_cast<int>(i);
  return std::nullopt;
}

}  // namespace barehand
