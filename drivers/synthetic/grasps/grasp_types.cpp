#include "drivers/synthetic/grasps/grasp_types.h"

namespace barehand::synthetic {

const std::vector<GraspType>& grasp_types() {
  static const std::vector<GraspType> kTypes = {
      // Power grasps.
      {"wrap", "power", "palm", "abducted", "2-5", "large and small diameter, medium wrap, power disk, power sphere"},
      {"index_extension", "power", "palm", "adducted", "3-5", "index finger extension"},
      {"thumb_along", "power", "palm", "adducted", "2-5", "adducted thumb, light tool, fixed hook, palmar"},
      {"ring", "power", "pad", "abducted", "2", "ring"},
      {"sphere_3", "power", "pad", "abducted", "2-3", "sphere 3-finger"},
      {"sphere_4", "power", "pad", "abducted", "2-4", "sphere 4-finger"},
      {"extension", "power", "pad", "abducted", "2-5", "extension type, distal type"},

      // Intermediate grasps.
      {"adduction", "intermediate", "side", "abducted", "2", "adduction grip"},
      {"tripod_variation", "intermediate", "side", "abducted", "3", "tripod variation"},
      {"lateral_tripod", "intermediate", "side", "abducted", "3-4", "lateral tripod"},
      {"lateral", "intermediate", "side", "adducted", "2", "lateral, stick, ventral"},

      // Precision grasps.
      {"pinch", "precision", "pad", "abducted", "2", "palmar pinch, tip pinch, inferior pincer"},
      {"tripod", "precision", "pad", "abducted", "2-3", "prismatic 2-finger, tripod"},
      {"quadpod", "precision", "pad", "abducted", "2-4", "prismatic 3-finger, quadpod"},
      {"five_fingers", "precision", "pad", "abducted", "2-5", "prismatic 4-finger, precision disk and sphere"},
      {"parallel_extension", "precision", "pad", "adducted", "2-5", "parallel extension"},
      {"writing_tripod", "precision", "side", "abducted", "3", "writing tripod"},
  };
  return kTypes;
}

std::optional<int> grasp_type_from_name(std::string_view name) {
  for (std::size_t i = 0; i < grasp_types().size(); ++i)
    if (grasp_types()[i].name == name) return static_cast<int>(i);
  return std::nullopt;
}

}  // namespace barehand::synthetic
