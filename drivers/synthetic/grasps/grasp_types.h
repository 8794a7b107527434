#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace barehand::synthetic {

/// A class of the GRASP taxonomy without the shape of the object (Feix et al., The GRASP taxonomy of human grasp types,
/// IEEE Transactions on Human-Machine Systems 46(1), 2016: 33 grasps, 17 classes).
struct GraspType {
  std::string_view name;
  std::string_view family;      ///< power, intermediate or precision
  std::string_view opposition;  ///< palm, pad or side
  std::string_view thumb;       ///< abducted or adducted
  std::string_view fingers;     ///< of virtual finger 2; index is 2, little is 5
  std::string_view example;     ///< grasps of the taxonomy that it unites
};

/// All 17 classes.
const std::vector<GraspType>& grasp_types();
/// Index of a class by its name; none if there is none.
std::optional<int> grasp_type_from_name(std::string_view name);

}  // namespace barehand::synthetic
