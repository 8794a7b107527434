#pragma once

#include <gtest/gtest.h>

#include "drivers/synthetic/hand/hand_mesh_file.h"
#include "drivers/synthetic/hand/measured_profile.h"
#include "drivers/synthetic/sequences/sequence.h"

namespace barehand::synthetic {

/// Base of tests with the hand mesh that deploy/fetch_hand_mesh.sh downloads. Without the mesh, they fail with a
/// message that names the script.
class HandTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const Handedness side : {Handedness::right, Handedness::left}) {
      const auto path = find_hand_mesh(side);
      ASSERT_TRUE(path.has_value()) << path.error().message();
      const auto mesh = load_hand_mesh(*path, side);
      ASSERT_TRUE(mesh.has_value()) << mesh.error().message();
      (side == Handedness::right ? right_ : left_) = *mesh;
    }
  }
  HandRig rig() const { return {right_, measure_profile(right_)}; }

  HandMesh right_, left_;
};

}  // namespace barehand::synthetic
