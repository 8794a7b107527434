// Records the first sensor with OpenNI2's own recorder. This is a separate program because the recorder crashes if a
// process uses it twice.
// Usage: record_oni FILE MILLISECONDS depth|both
#include <OpenNI.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

namespace {

void must(openni::Status status, const char* what) {
  if (status == openni::STATUS_OK) return;
  std::printf("%s: %s\n", what, openni::OpenNI::getExtendedError());
  std::exit(1);
}

void pause(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

}  // namespace

int main(int, char** arguments) {
  // Open the sensor.
  const bool both = std::string(arguments[3]) == "both";
  must(openni::OpenNI::initialize(), "initialize");
  openni::Device device;
  must(device.open(openni::ANY_DEVICE), "open");

  // Create its streams.
  openni::VideoStream depth, colour;
  must(depth.create(device, openni::SENSOR_DEPTH), "depth");
  openni::VideoMode mode = depth.getVideoMode();
  mode.setPixelFormat(openni::PIXEL_FORMAT_DEPTH_100_UM);
  must(depth.setVideoMode(mode), "mode");
  if (both) {
    must(colour.create(device, openni::SENSOR_COLOR), "colour");
    must(device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR), "registration");
  }

  // Attach them to the recorder and record for some time.
  openni::Recorder recorder;
  must(recorder.create(arguments[1]), "recorder");
  must(recorder.attach(depth), "attach");
  if (both) must(recorder.attach(colour), "attach");
  must(recorder.start(), "record");
  must(depth.start(), "start");
  if (both) must(colour.start(), "start");
  std::puts("recording");
  std::fflush(stdout);
  pause(std::atoi(arguments[2]));

  // Stop.
  recorder.stop();
  depth.stop();
  if (both) colour.stop();
  pause(300);  // without it, destroy() sometimes deadlocks
  recorder.destroy();
  std::_Exit(0);
}
