// Tests the real libusb with a USB tree simulated by umockdev.
#include "drivers/usb/libusb_bus.h"

#include <gmock/gmock.h>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "support/ordinary_user.h"
#include "usb/mock_bus.h"

namespace barehand {
namespace {

using test::MockBus;
using test::OrdinaryUser;
using ::testing::HasSubstr;

bool comes_true(const std::function<bool()>& condition) {
  for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

class LibUsb : public ::testing::Test {
 protected:
  MockBus usb_;
  LibUsbBus bus_;
};

TEST_F(LibUsb, AnEmptyBusHasNoSensors) {
  EXPECT_EQ(bus_.state(), "");
  ASSERT_TRUE(bus_.sensors());
  EXPECT_TRUE(bus_.sensors()->empty());
}

TEST_F(LibUsb, TellsPortAndSpeedOfEverySensorAndNothingOfOtherDevices) {
  // Three sensors among other devices.
  usb_.plug({.port = "1-2", .number = 4});
  usb_.plug({.port = "1-3", .number = 9, .vendor = 0x1d6b, .product = 2});  // a hub
  usb_.plug(
      {.port = "1-3.1", .number = 5, .vendor = 0x2bc5, .product = 0x0402, .megabits = 5000, .usb_version = 0x0300});
  usb_.plug({.port = "1-4", .number = 6, .vendor = 0x046d, .product = 0xc077, .megabits = 12});
  usb_.plug({.port = "1-5", .number = 7, .vendor = 0x045e, .product = 0x02ae});
  usb_.plug({.port = "1-6", .number = 8, .vendor = 0x045e, .product = 0x0745});

  // The motor of a Kinect.
  usb_.plug({.port = "1-7", .number = 10, .vendor = 0x045e, .product = 0x02b0, .megabits = 12});

  // Only the sensors are listed.
  const auto sensors = bus_.sensors();
  ASSERT_TRUE(sensors);
  std::vector<std::string> texts;
  for (const UsbSensor& sensor : *sensors) {
    texts.push_back(to_text(sensor));
    EXPECT_FALSE(sensor.obstacle) << sensor.obstacle->message();
    EXPECT_FALSE(sensor.held_back) << texts.back();
  }

  // Their texts state port and speed.
  EXPECT_THAT(texts,
              ::testing::UnorderedElementsAre("PrimeSense or Asus Xtion 1d27:0601 at USB port 1-2, USB 2 (480 Mb/s)",
                                              "Orbbec 2bc5:0402 at USB port 1-3.1, USB 3 (5000 Mb/s)",
                                              "Microsoft Kinect, camera 045e:02ae at USB port 1-5, USB 2 (480 Mb/s)"));
}

TEST_F(LibUsb, ASensorInASlowPortIsHeldBack) {
  usb_.plug({.port = "1-1", .number = 2, .megabits = 12});
  usb_.plug({.port = "1-2", .number = 3, .vendor = 0x045e, .product = 0x02c4, .usb_version = 0x0210});
  const auto sensors = bus_.sensors();
  ASSERT_TRUE(sensors);
  ASSERT_EQ(sensors->size(), 2u);
  for (const UsbSensor& sensor : *sensors) EXPECT_TRUE(sensor.held_back) << to_text(sensor);
}

TEST_F(LibUsb, SaysThatThisUserMayNotOpenIt) {
  // A sensor whose device file this user may not open.
  usb_.plug({.port = "1-2"});
  for (const char* place : {"", "/ioctl/_default"})  // umockdev's own sockets
    std::filesystem::permissions(usb_.root() + place, std::filesystem::perms::all);
  const std::string file = usb_.root() + "/dev/bus/usb/001/004";
  chmod(file.c_str(), 0600);
  if (geteuid() != 0) chmod(file.c_str(), 0);
  const OrdinaryUser user;

  // It is listed with the reason and the remedy.
  const auto sensors = bus_.sensors();
  ASSERT_TRUE(sensors) << sensors.error().message();
  ASSERT_EQ(sensors->size(), 1u);
  ASSERT_TRUE(sensors->front().obstacle);
  EXPECT_EQ(sensors->front().obstacle->what, "this user may not open it");
  EXPECT_THAT(sensors->front().obstacle->remedy, HasSubstr("60-barehand-sensors.rules"));
}

TEST_F(LibUsb, SaysThatADeviceFileIsMissing) {
  usb_.plug({.port = "1-2"});
  std::filesystem::remove_all(usb_.root() + "/dev/bus/usb/001");
  const auto sensors = bus_.sensors();
  ASSERT_TRUE(sensors);
  ASSERT_EQ(sensors->size(), 1u);
  ASSERT_TRUE(sensors->front().obstacle);
  EXPECT_THAT(sensors->front().obstacle->message(), HasSubstr("/dev/bus/usb/001/004: it has no device file"));
}

TEST_F(LibUsb, TheStateChangesWithEveryPlug) {
  usb_.plug({.port = "1-1", .number = 2, .vendor = 0x046d});
  const std::string before = bus_.state();
  EXPECT_EQ(bus_.state(), before);
  usb_.plug({.port = "1-2", .number = 3});
  const std::string with_sensor = bus_.state();
  EXPECT_NE(with_sensor, before);
  usb_.pull("1-2");
  EXPECT_EQ(bus_.state(), before);
  usb_.plug({.port = "1-2", .number = 4});  // the same port again
  EXPECT_NE(bus_.state(), with_sensor);
}

TEST_F(LibUsb, TheWatchTellsOfEveryPlug) {
  std::atomic<int> changes = 0;
  ASSERT_TRUE(bus_.watch([&] { ++changes; }));
  usb_.plug({.port = "1-2"});
  ASSERT_TRUE(comes_true([&] { return changes == 1; }));
  usb_.pull("1-2");
  ASSERT_TRUE(comes_true([&] { return changes == 2; }));
  usb_.plug({.port = "1-2", .number = 5});
  EXPECT_TRUE(comes_true([&] { return changes == 3; }));
}

/// Simulates the kernel for a device: answers the resets of it and counts them.
class Resets {
 public:
  Resets(MockBus& bus, const char* device, int error)
      : handler_(UMOCKDEV_IOCTL_BASE(g_object_new(UMOCKDEV_TYPE_IOCTL_BASE, nullptr))), error_(error) {
    g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(handle), this);
    GError* failed = nullptr;
    if (!umockdev_testbed_attach_ioctl(bus.testbed(), device, handler_, &failed))
      throw std::runtime_error(failed->message);
  }
  ~Resets() { g_object_unref(handler_); }
  int count() const { return count_; }

 private:
  static gboolean handle(UMockdevIoctlBase*, UMockdevIoctlClient* client, void* self) {
    auto* resets = static_cast<Resets*>(self);
    const bool reset = umockdev_ioctl_client_get_request(client) == USBDEVFS_RESET;
    resets->count_ += reset;
    umockdev_ioctl_client_complete(client, reset && resets->error_ ? -1 : 0, reset ? resets->error_ : 0);
    return TRUE;
  }

  UMockdevIoctlBase* handler_;
  const int error_;
  std::atomic<int> count_ = 0;
};

TEST_F(LibUsb, ResetsTheDeviceAtThisAddressOnly) {
  usb_.plug({.port = "1-1", .number = 3});
  usb_.plug({.port = "1-2", .number = 4});
  const Resets other(usb_, "/dev/bus/usb/001/003", 0), wanted(usb_, "/dev/bus/usb/001/004", 0);
  const auto done = bus_.reset({0x1d27, 0x0601, 1, 4});
  EXPECT_TRUE(done) << done.error().message();
  EXPECT_EQ(wanted.count(), 1);
  EXPECT_EQ(other.count(), 0);
}

TEST_F(LibUsb, ADeviceThatComesBackElsewhereWasReset) {
  usb_.plug({.port = "1-2", .number = 4});
  const Resets gone(usb_, "/dev/bus/usb/001/004", ENODEV);
  EXPECT_TRUE(bus_.reset({0x1d27, 0x0601, 1, 4}));
}

TEST_F(LibUsb, SaysWhyADeviceWasNotReset) {
  usb_.plug({.port = "1-2", .number = 4});
  const Resets broken(usb_, "/dev/bus/usb/001/004", EIO);
  const auto failed = bus_.reset({0x1d27, 0x0601, 1, 4});
  ASSERT_FALSE(failed);
  EXPECT_THAT(failed.error().message(), HasSubstr("cannot be reset"));
  const auto replugged = bus_.reset({0x1d27, 0x0601, 1, 9});
  ASSERT_FALSE(replugged);
  EXPECT_THAT(replugged.error().message(), HasSubstr("no longer plugged in"));
}

}  // namespace
}  // namespace barehand
