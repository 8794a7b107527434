#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace barehand {

// The classes of grasps of the GRASP taxonomy without the shape of the object (Feix et al., The GRASP taxonomy of human
// grasp types, IEEE Transactions on Human-Machine Systems 46(1), 2016: 33 grasps, 17 classes). The values of the
// enumerations are those of grasp_state_t.

enum class GraspKind : std::int8_t { none = 0, power = 1, intermediate = 2, precision = 3 };
/// What holds the object: the fingers against the palm, pads against pads, or the sides of fingers.
enum class Opposition : std::int8_t { none = 0, palm = 1, pad = 2, side = 3 };
enum class ThumbPosition : std::int8_t { none = 0, abducted = 1, adducted = 2 };

/// One class of grasps.
struct GraspType {
  std::string_view name;
  GraspKind kind;
  Opposition opposition;
  ThumbPosition thumb;
  /// The fingers that oppose the thumb or the palm ("virtual finger 2"); 2: index, 5: little.
  int first_finger, last_finger;
  std::string_view example;  ///< the grasps of the taxonomy that belong to the class
};

inline constexpr int kGraspTypeCount = 17;
/// All classes.
const std::array<GraspType, kGraspTypeCount>& grasp_types();
/// "none" for 0, the name of class k for k + 1; "unknown" for any other number.
std::string_view grasp_name(int grasp);
/// "none", "power", "intermediate" or "precision"; "unknown" for any other number.
std::string_view kind_name(int kind);
/// Index of the class with this name; none if there is no such class.
std::optional<int> grasp_type_from_name(std::string_view name);

}  // namespace barehand
