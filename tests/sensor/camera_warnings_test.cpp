#include "sensor/camera_warnings.h"

#include <gmock/gmock.h>

namespace barehand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(CameraWarnings, OrdinaryCamerasRaiseNone) {
  for (const Intrinsics& camera : {
           Intrinsics{640, 480, 525, 525, 319.5, 239.5},        // Kinect, TUM's default
           Intrinsics{640, 480, 517.3, 516.5, 318.6, 255.3},    // TUM fr1
           Intrinsics{512, 424, 363.9, 363.9, 255.6, 206.3},    // Kinect v2
           Intrinsics{320, 240, 238.95, 238.95, 160, 120},      // SR300
           Intrinsics{1024, 1024, 502.7, 502.6, 512.7, 515.1},  // Azure Kinect, wide
           Intrinsics{640, 576, 504.2, 504.3, 321.5, 337.9},    // Azure Kinect, narrow
           Intrinsics{848, 480, 421.3, 421.3, 423.9, 238.7},    // D435
           Intrinsics{640, 480, 481.2, 480, 319.5, 239.5},      // ICL-NUIM
           Intrinsics{224, 171, 211.6, 211.6, 112.8, 87.1},     // pmd flexx
       })
    EXPECT_THAT(camera_warnings(camera), IsEmpty()) << camera.width << "x" << camera.height;
}

TEST(CameraWarnings, IntrinsicsOfAnotherSizeNameIt) {
  EXPECT_THAT(camera_warnings({640, 480, 1050, 1050, 639.5, 479.5}), ElementsAre(HasSubstr("of a 1280x960 image")));
  EXPECT_THAT(camera_warnings({320, 240, 525, 525, 319.5, 239.5}), ElementsAre(HasSubstr("of a 640x480 image")));
  EXPECT_THAT(camera_warnings({640, 480, 238.95, 238.95, 160, 120}), ElementsAre(HasSubstr("of a 320x240 image")));
  EXPECT_THAT(camera_warnings({640, 480, 1066, 1068, 945, 520}), ElementsAre(HasSubstr("of a 1920x1080 image")));
  EXPECT_THAT(camera_warnings({640, 480, 640, 640, 636, 365}), ElementsAre(HasSubstr("of a 1280x720 image")));
}

TEST(CameraWarnings, AFieldOfViewThatNoCameraHasIsNamed) {
  EXPECT_THAT(camera_warnings({640, 480, 5250, 5250, 319.5, 239.5}), ElementsAre(HasSubstr("6.98 degrees")));
  EXPECT_THAT(camera_warnings({640, 480, 52.5, 52.5, 319.5, 239.5}), ElementsAre(HasSubstr("161 degrees")));
  EXPECT_THAT(camera_warnings({640, 480, 1.93, 1.93, 319.5, 239.5}), ElementsAre(HasSubstr("in pixels")))
      << "millimetres of a lens";
}

TEST(CameraWarnings, APrincipalPointThatCannotBeIsNamed) {
  EXPECT_THAT(camera_warnings({640, 480, 525, 525, 0.5, 0.5}), ElementsAre(HasSubstr("fractions of the image size")));
  EXPECT_THAT(camera_warnings({640, 480, 525, 525, 100, 239.5}), ElementsAre(HasSubstr("far from the middle")));
  EXPECT_THAT(camera_warnings({640, 480, 525, 525, 239.5, 319.5}), IsEmpty()) << "swapped: an offset some cameras have";
  EXPECT_THAT(camera_warnings({640, 480, 525, 262, 319.5, 239.5}),
              ElementsAre(HasSubstr("differ by more than a quarter")));
}

}  // namespace
}  // namespace barehand
