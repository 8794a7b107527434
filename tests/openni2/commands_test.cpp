// Tests commands of the program with the virtual sensor.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <thread>

#include "openni2/virtual_sensor.h"
#include "support/barehand_program.h"

namespace barehand {
namespace {

using ::testing::HasSubstr;
using Settings = VirtualSensor::Settings;

TEST(OpenNiCommands, DoctorListsTheSensors) {
  VirtualSensor sensor(Settings{{"second_uri", "virtual/2"}});
  const Outcome doctor = barehand({"doctor", "--lcm-url", "memq://"});
  EXPECT_THAT(doctor.output, HasSubstr("2 sensors"));
  EXPECT_THAT(doctor.output, HasSubstr("sensor: Barehand Virtual Sensor, --source openni2:virtual/1"));
  EXPECT_THAT(doctor.output, HasSubstr("--source openni2:virtual/2"));
}

TEST(OpenNiCommands, RecordsAndPlaysBack) {
  VirtualSensor sensor;
  const test::TempFolder folder;
  const std::string log = folder / "session.lcmlog";
  const Outcome recorded = barehand({"record", "--source", "openni2", "--frames", "12", "--out", log});
  EXPECT_EQ(recorded.exit_code, 0) << recorded.output;
  EXPECT_THAT(recorded.output, HasSubstr("openni2: opened Barehand Virtual Sensor"));
  EXPECT_THAT(recorded.output, HasSubstr("12 frames written"));
  const Outcome copied = barehand({"convert", log, folder / "copy"});
  EXPECT_EQ(copied.exit_code, 0) << copied.output;
  EXPECT_THAT(copied.output, HasSubstr("12 frames written"));
}

TEST(OpenNiCommands, ARecordingSaysThatItsDiskCannotKeepUp) {
  // The log is written to a pipe, which is as slow as its reader: it replaces a slow disk.
  VirtualSensor sensor;
  const test::TempFolder folder;
  const std::string log = folder / "slow.lcmlog";
  ASSERT_EQ(mkfifo(log.c_str(), 0600), 0);
  const int reader = open(log.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  fcntl(reader, F_SETFL, 0);

  // Record until frames are missing.
  ChildProcess record({BAREHAND_PROGRAM, "record", "--source", "openni2", "--overwrite", "--out", log});
  ASSERT_TRUE(record.wait_for("opened Barehand Virtual Sensor")) << record.output();
  std::atomic<bool> slow = true;
  std::thread disk([&] {
    char buffer[1 << 16];
    while (read(reader, buffer, sizeof buffer) > 0)
      if (slow) std::this_thread::sleep_for(std::chrono::milliseconds(200));
  });
  EXPECT_TRUE(record.wait_for("frames missing so far, ")) << record.output();

  // The recorder ends normally and reports what was lost.
  slow = false;
  record.signal(SIGTERM);
  EXPECT_EQ(record.finish(), 0) << record.output();
  disk.join();
  close(reader);
  EXPECT_THAT(record.output(), HasSubstr(" came faster than they could be written"));
}

TEST(OpenNiCommands, ConvertsAnOniFileCompletely) {
  VirtualSensor sensor;
  const test::TempFolder folder;
  const std::string oni = folder / "recording.oni";
  ChildProcess recorder({BAREHAND_RECORD_ONI, oni, "1500", "both"});
  ASSERT_EQ(recorder.finish(), 0) << recorder.output();
  const Outcome converted = barehand({"convert", oni, folder / "out.lcmlog"});
  EXPECT_EQ(converted.exit_code, 0) << converted.output;
  EXPECT_THAT(converted.output, HasSubstr(" frames written"));
  EXPECT_THAT(converted.output, ::testing::Not(HasSubstr("unreadable")));
  const Outcome part = barehand({"convert", oni, folder / "part.lcmlog", "--start", "3", "--frames", "4"});
  EXPECT_EQ(part.exit_code, 0) << part.output;
  EXPECT_THAT(part.output, HasSubstr("4 frames written"));
}

TEST(OpenNiCommands, RefusesAnOniFileThatIsNotThere) {
  const Outcome outcome = barehand({"track", "--source", "openni2:/nonexistent.oni", "--no-publish"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("no such file"));
}

TEST(OpenNiCommands, RefuseHalfOfTheIntrinsics) {
  const test::TempFolder folder;
  const std::vector<std::vector<std::string>> halves{{"--fx", "500", "--fy", "500"},
                                                     {"--fx", "500", "--cx", "320", "--cy", "240"},
                                                     {"--cx", "320", "--cy", "240"},
                                                     {"--fx", "-500", "--fy", "500", "--cx", "320", "--cy", "240"}};
  for (const std::vector<std::string>& half : halves) {
    std::vector<std::string> record{"record", "--source", "openni2", "--seconds", "0.1", "--out", folder / "log"};
    record.insert(record.end(), half.begin(), half.end());
    const Outcome outcome = barehand(record);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("give all four"));
  }
}

TEST(OpenNiCommands, SayWhoseIntrinsicsOfTheConfigurationAreHalf) {
  const test::TempFolder folder;
  std::string text = barehand({"track", "--print-config"}).output;
  text.replace(text.find("  fx: 0\n", text.find("\nopenni2:")), 8, "  fx: 500\n");
  test::write_text(folder / "half.yaml", text);
  const Outcome outcome = barehand({"track", "--source", "openni2", "--config", folder / "half.yaml", "--no-publish"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("openni2, fx, fy, cx, cy: no camera has these intrinsics"));
}

/// Parses "6 frames in 1.0 s (6.0 frames/s): 5 published, 1 dropped, 0 failed".
struct Counts {
  long captured = -1, published = 0, dropped = 0, failed = 0;
};
Counts counts_in(const std::string& output) {
  Counts counts;
  const auto end = output.rfind(" published, ");
  const auto line = output.rfind('\n', end) + 1;
  std::sscanf(output.c_str() + line, "%ld frames in %*f s (%*f frames/s): %ld published, %ld dropped, %ld failed",
              &counts.captured, &counts.published, &counts.dropped, &counts.failed);
  return counts;
}

TEST(OpenNiCommands, TrackingOutlivesTheCable) {
  // Start without a sensor, then plug it in.
  VirtualSensor sensor(Settings{{"plugged", "0"}, {"sim", "fist,noise=kinect,width=320,height=240"}});
  ChildProcess track({BAREHAND_PROGRAM, "track", "--source", "openni2", "--no-publish", "--health"});
  ASSERT_TRUE(track.wait_for("no sensor yet")) << track.output();
  sensor.plug();
  ASSERT_TRUE(track.wait_for("opened Barehand Virtual Sensor")) << track.output();
  ASSERT_TRUE(track.wait_for("captured ")) << track.output();  // health: frames pass through the pipeline

  // Unplug it; after a while another sensor is plugged in.
  sensor.unplug();
  ASSERT_TRUE(track.wait_for("was unplugged")) << track.output();

  // Wait long enough for a second message about the same fault.
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  sensor.set({{"plugged", "1"}, {"uri", "virtual/3"}, {"sim", "fist,noise=kinect,width=160,height=120"}});
  ASSERT_TRUE(track.wait_for("160x120")) << track.output();
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));

  // The run ends normally, and its counts agree.
  track.signal(SIGTERM);
  EXPECT_EQ(track.finish(), 0) << track.output();
  const Counts counts = counts_in(track.output());
  EXPECT_GT(counts.published, 0) << track.output();
  EXPECT_EQ(counts.captured, counts.published + counts.dropped + counts.failed) << track.output();
  EXPECT_EQ(counts.failed, 0) << track.output();
}

}  // namespace
}  // namespace barehand
