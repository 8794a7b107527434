// Tests how the USB bus is used for a sensor of OpenNI2.
#include <gmock/gmock.h>

#include <atomic>

#include "drivers/openni2/finder.h"
#include "drivers/openni2/openni_live_source.h"
#include "drivers/openni2/usb_address.h"
#include "openni2/source_reader.h"
#include "openni2/virtual_sensor.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;

constexpr const char* kUri = "1d27/0601@1/4";
constexpr UsbAddress kAddress{0x1d27, 0x0601, 1, 4};

/// A simulated USB bus with one device. Resetting it calls `cure`, which ends the fault of the virtual sensor.
struct Bus {
  std::function<void()> changed, cure;
  std::vector<UsbSensor> plugged;
  std::string state = "1-2#4 ";
  std::atomic<int> looks = 0, resets = 0, states = 0;
  UsbAddress last_reset;
};
class RecordingBus : public UsbBus {
 public:
  explicit RecordingBus(Bus& bus) : bus_(bus) {}
  std::string state() override {
    ++bus_.states;
    return bus_.state;
  }
  Result<std::vector<UsbSensor>> sensors() override {
    ++bus_.looks;
    return bus_.plugged;
  }
  Result<void> watch(std::function<void()> changed) override {
    bus_.changed = std::move(changed);
    return {};
  }
  Result<void> reset(const UsbAddress& device) override {
    bus_.last_reset = device;
    ++bus_.resets;
    bus_.cure();
    return {};
  }

 private:
  Bus& bus_;
};

class OpenNiOnUsb : public ::testing::Test {
 protected:
  void open(const VirtualSensor::Settings& settings) {
    sensor_.set(settings);
    bus_.cure = [this] { sensor_.set({{"fault", "none"}}); };
    source_ = std::make_unique<OpenNiLiveSource>("", params_, 8, clock_, std::make_unique<RecordingBus>(bus_));
    reader_ = std::make_unique<SourceReader>(*source_);
  }

  const SystemClock clock_;
  VirtualSensor sensor_;
  OpenNiParams params_{.width = 160, .height = 120, .camera = {}};
  Bus bus_;
  std::unique_ptr<OpenNiLiveSource> source_;
  std::unique_ptr<SourceReader> reader_;
};

TEST(UsbAddressOfASensor, IsItsAddressInOpenNi2) {
  EXPECT_EQ(usb_address(kUri), kAddress);
  for (const char* other : {"virtual/1", "1d27/0601@1", "1d27/0601@1/4/5", "recording.oni", ""})
    EXPECT_FALSE(usb_address(other)) << other;
}

TEST_F(OpenNiOnUsb, ASensorThatOpensAndNeverAnswersIsReset) {
  open({{"uri", kUri}, {"fault", "stall"}});
  ASSERT_TRUE(reader_->frame()) << reader_->notices;
  EXPECT_EQ(bus_.resets, 1);
  EXPECT_EQ(bus_.last_reset, kAddress);
  EXPECT_THAT(reader_->notices, HasSubstr("its USB port was reset"));
}

TEST_F(OpenNiOnUsb, ASensorThatNoResetHelpsIsResetThreeTimes) {
  // A clock that runs fast shortens the waits.
  class Hurried : public SystemClock {
   public:
    std::int64_t steady_us() const override { return 10 * SystemClock::steady_us(); }
  } hurried;

  // A sensor that stalls; no reset ends the fault.
  sensor_.set({{"uri", kUri}, {"fault", "stall"}});
  bus_.cure = [] {};
  OpenNiLiveSource source("", params_, 8, hurried, std::make_unique<RecordingBus>(bus_));
  SourceReader reader(source);

  // The port may be reset after every second failed attempt to open the sensor.
  for (int opened = 0; opened < 9; ++opened) {
    reader.notices.clear();
    ASSERT_TRUE(reader.told("opened Barehand")) << opened;
    bus_.changed();  // ends the wait before the next attempt
  }
  EXPECT_EQ(bus_.resets, 3);
}

TEST_F(OpenNiOnUsb, ASensorThatStallsAfterItAnsweredIsOnlyOpenedAgain) {
  open({{"uri", kUri}});
  ASSERT_TRUE(reader_->frame());
  sensor_.set({{"fault", "stall"}, {"cured_by_reopen", "1"}});
  ASSERT_TRUE(reader_->told("stalled"));
  ASSERT_TRUE(reader_->frame());
  EXPECT_EQ(bus_.resets, 0);
}

TEST_F(OpenNiOnUsb, EveryPlugIsLookedAtWithoutDelay) {
  open({{"plugged", "0"}});
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) {
    const int looks = bus_.looks;
    bus_.changed();
    while (bus_.looks == looks) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(15)) << "back-off alone needs 27 s";
}

/// A SensorFinder, and no sensor that it could find.
class OpenNiFinderOnUsb : public ::testing::Test {
 protected:
  /// Whether the next search loads OpenNI2. If it does, it reads the state of the bus once more.
  bool loads() {
    const int before = bus_.states;
    EXPECT_FALSE(finder_.find());
    return bus_.states - before == 2;
  }
  /// Whether OpenNI2 is loaded again after this time.
  bool loads_after(std::int64_t seconds) {
    clock_.advance(seconds * 1'000'000);
    EXPECT_FALSE(loads()) << "it was loaded";
    return loads();
  }

  VirtualSensor sensor_{{{"plugged", "0"}}};
  ManualClock clock_;
  Bus bus_;
  RecordingBus usb_{bus_};
  OpenNiFinder finder_{"", [] {}, &usb_, clock_};
};

TEST_F(OpenNiFinderOnUsb, LoadsOpenNi2AnewWhenTheBusChanges) {
  EXPECT_TRUE(loads());
  EXPECT_FALSE(loads());
  bus_.state = "1-2#5 ";
  EXPECT_TRUE(loads_after(0));
}

TEST_F(OpenNiFinderOnUsb, LoadsOpenNi2AnewAfterAChangeThatItMayHaveSeenHalfOf) {
  bus_.state = "1-2#5 ";  // the device is listed already
  EXPECT_TRUE(loads());
  finder_.bus_changed();  // reports the change once more, when it is complete
  EXPECT_FALSE(loads()) << "it was loaded";
  EXPECT_TRUE(loads());
  EXPECT_FALSE(loads_after(0)) << "once is enough";
}

TEST_F(OpenNiFinderOnUsb, HardlyEverLoadsOpenNi2AnewWhereTheBusTells) {
  EXPECT_TRUE(loads());
  EXPECT_FALSE(loads_after(3600));
  EXPECT_TRUE(loads_after(24 * 3600));
}

TEST_F(OpenNiFinderOnUsb, LoadsOpenNi2AnewNowAndThenWhereTheBusDoesNotTell) {
  bus_.state = "";
  EXPECT_TRUE(loads());
  EXPECT_TRUE(loads_after(700));
}

TEST_F(OpenNiOnUsb, SaysWhatIsPluggedInWithoutADriver) {
  bus_.plugged = {{kAddress, "Maker", "1-2", 480, false, Error{"this user may not open it", "/dev/x", "do this"}}};
  open({{"plugged", "0"}});
  EXPECT_TRUE(
      reader_->told("plugged in: Maker 1d27:0601 at USB port 1-2, USB 2 (480 Mb/s), this user may not open it "
                    "(do this)"))
      << reader_->notices;
}

TEST_F(OpenNiOnUsb, SaysWhereTheOpenedSensorIsPlugged) {
  bus_.plugged = {{{1, 2, 3, 4}, "Another", "1-1", 480, false, {}}, {kAddress, "Maker", "1-2.3", 5000, false, {}}};
  open({{"uri", kUri}});
  EXPECT_TRUE(reader_->told("; Maker 1d27:0601 at USB port 1-2.3, USB 3 (5000 Mb/s)")) << reader_->notices;
}

}  // namespace
}  // namespace barehand
