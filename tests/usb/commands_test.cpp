// Tests commands of the program with a USB tree simulated by umockdev.
#include <gmock/gmock.h>

#include <csignal>

#include "support/barehand_program.h"
#include "usb/mock_bus.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;

TEST(UsbCommands, DoctorTellsPortAndSpeed) {
  test::MockBus usb;
  usb.plug({.port = "1-2"});
  usb.plug({.port = "1-3", .number = 5, .vendor = 0x2bc5, .product = 0x0402, .usb_version = 0x0210});
  const Outcome doctor = barehand({"doctor", "--lcm-url", "memq://"});
  EXPECT_THAT(doctor.output,
              HasSubstr("ok      USB: PrimeSense or Asus Xtion 1d27:0601 at USB port 1-2, USB 2 (480 Mb/s)\n"));
  EXPECT_THAT(
      doctor.output,
      HasSubstr("warning USB: Orbbec 2bc5:0402 at USB port 1-3, USB 2 (480 Mb/s), although it supports a faster one"));
}

TEST(UsbCommands, TrackingNoticesASensorThatIsPluggedIn) {
  test::MockBus usb;
  ChildProcess track({BAREHAND_PROGRAM, "track", "--source", "openni2", "--no-publish"});
  ASSERT_TRUE(track.wait_for("no sensor yet")) << track.output();
  usb.plug({.port = "1-2"});
  // OpenNI2's own driver finds the sensor and cannot talk to it, since the tree is only simulated.
  EXPECT_TRUE(track.wait_for("1d27/0601@1/4 cannot be opened")) << track.output();
  track.signal(SIGTERM);
  EXPECT_EQ(track.finish(), 0) << track.output();
}

}  // namespace
}  // namespace barehand
