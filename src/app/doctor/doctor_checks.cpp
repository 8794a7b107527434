// The checks of `barehand doctor`: processor, graphics, network, sensors and installed files.
#include "app/doctor/doctor_checks.h"

#include <array>
#include <fstream>
#include <sstream>

#include "core/parallel/parallel.h"
#include "drivers/openni2/openni_devices.h"
#include "drivers/synthetic/hand/hand_mesh_file.h"
#include "drivers/usb/libusb_bus.h"
#include "io/data_files.h"
#include "io/hand/hand_json.h"
#include "io/lcm/lcm_bus.h"
#include "observe/egl/egl_observer.h"
#include "pipeline/config.h"
#include "pipeline/trial_level.h"
#include "stages/segment_tracker/cpu_observer.h"

namespace barehand {
namespace {

using Level = Finding::Level;

#if defined(__AVX512F__)
constexpr const char* kInstructionSet = "AVX-512";
#elif defined(__AVX2__)
constexpr const char* kInstructionSet = "AVX2";
#else
constexpr const char* kInstructionSet = nullptr;
#endif

Finding check_config(const std::string& name) {
  const std::string subject = "configuration " + name;
  const auto path = find_data_file("configs/" + name);
  if (!path) return {Level::problem, subject, path.error().what, path.error().remedy};
  const auto config = load_config<Config>(*path);
  if (!config) return {Level::problem, subject, config.error().message(), "see barehand track --print-config"};
  return {Level::ok, subject, *path, ""};
}

Finding check_profile(const std::string& name) {
  const std::string subject = "hand profile " + name;
  const auto path = find_data_file("configs/hands/" + name);
  if (!path) return {Level::problem, subject, path.error().what, path.error().remedy};
  const auto profile = load_profile(*path);
  if (!profile) return {Level::problem, subject, profile.error().message(), "restore the shipped file"};
  return {Level::ok, subject, *path, ""};
}

Finding check_mesh(Handedness side) {
  const std::string subject = std::string("simulated ") + std::string(to_string(side)) + " hand";
  const auto path = synthetic::find_hand_mesh(side);
  if (!path) return {Level::warning, subject, path.error().what + "; sim:NAME cannot run", path.error().remedy};
  return {Level::ok, subject, *path, ""};
}

Finding check_sensor(const UsbSensor& sensor) {
  if (const auto& obstacle = sensor.obstacle)
    return {Level::problem, "USB", to_text(sensor) + ": " + obstacle->what + " (" + obstacle->where + ")",
            obstacle->remedy};
  if (sensor.held_back)
    return {Level::warning, "USB", to_text(sensor) + ", although it supports a faster one",
            "plug it into a faster USB port, without a hub"};
  return {Level::ok, "USB", to_text(sensor), ""};
}

}  // namespace

void examine(const std::string& lcm_url, const std::function<void(const Finding&)>& report) {
  report(check_processor());
  for (const Finding& finding : check_files()) report(finding);
  for (const Handedness side : {Handedness::right, Handedness::left}) report(check_mesh(side));
  report(check_multicast_route(lcm_url));
  report(check_receive_buffer(lcm_url));
  report(check_lcm(lcm_url));
  report(check_graphics());
  for (const Finding& finding : check_openni()) report(finding);
  for (const Finding& finding : check_usb()) report(finding);
}

Finding check_processor() {
  bool avx2 = false;
#ifdef __x86_64__
  avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
  const int cores = available_cores();
  const std::string text = std::to_string(cores) + (cores == 1 ? " core" : " cores") +
                           (avx2 ? " with AVX2" : " without AVX2") + "; the program " +
                           (kInstructionSet ? std::string("uses ") + kInstructionSet : "uses neither AVX2 nor AVX-512");
  if (cores < 2) return {Level::warning, "processor", text, "two cores are needed to track at the rate of a sensor"};
  if (avx2 && !kInstructionSet)
    return {Level::warning, "processor", text, "a build with -DBAREHAND_ARCH=x86-64-v3 tracks about 1.5 times as fast"};
  return {Level::ok, "processor", text, ""};
}

std::vector<Finding> check_files() {
  return {check_config("default.yaml"), check_config("paper.yaml"), check_config("accurate.yaml"),
          check_profile("adult_right.json"), check_profile("adult_left.json")};
}

Finding check_receive_buffer(const std::string& lcm_url, const std::string& rmem_max_file) {
  const std::string subject = "receive buffer";
  long bytes = 0;
  if (!(std::ifstream(rmem_max_file) >> bytes))
    return {Level::note, subject, "the kernel does not report its size (" + rmem_max_file + ")", ""};
  if (const auto shortfall = LcmBus::receive_buffer_shortfall(lcm_url, rmem_max_file))
    return {Level::warning, subject, shortfall->what, shortfall->remedy};
  return {Level::ok, subject, std::to_string(bytes) + " bytes for a UDP socket", ""};
}

Finding check_multicast_route(const std::string& lcm_url, const std::string& route_file) {
  if (!LcmBus::is_network(lcm_url)) return {Level::ok, "multicast route", "not needed for " + lcm_url, ""};
  std::ifstream routes(route_file);
  std::string line;
  std::getline(routes, line);  // skips the column names

  // Read one route after the other; the columns between gateway and mask are not needed.
  while (std::getline(routes, line)) {
    std::string interface;
    std::uint32_t destination = 0, gateway = 0, mask = 0;
    std::array<std::string, 4> skipped;
    std::istringstream fields(line);
    fields >> interface >> std::hex >> destination >> gateway;
    for (auto& field : skipped) fields >> field;
    fields >> mask;
    // The addresses in the route file are little-endian words. 239.255.76.67 is LCM's default address; a default route
    // (mask 0) covers it as well.
    const std::uint32_t lcm_address = 239u | 255u << 8 | 76u << 16 | 67u << 24;
    if (fields && (lcm_address & mask) == destination)
      return {Level::ok, "multicast route", "through " + interface, ""};
  }
  return {Level::problem, "multicast route", "there is none: LCM cannot send over UDP",
          "sudo ip link set lo up; sudo ip route add 224.0.0.0/4 dev lo"};
}

Finding check_graphics(const std::string& egl_library) {
  const std::string subject = "graphics";
  const Config config;
  const SegmentTrackerParams& params = config.tracker.segment_tracker;
  const auto observer = EglObserver::open(distance_cap(params), DeviceChoice::any, egl_library);
  if (!observer)
    return {Level::note, subject, observer.error().message() + "; samples are compared on the CPU",
            "only with a GPU: install its driver and libegl1"};

  // Measure what `observer: auto` measures with its first batch of samples.
  const GraphicsDevice& device = (*observer)->device();
  const std::string name = device.renderer + ", " + device.version;
  Workers workers(available_cores());
  const auto trial = time_trial_level(config, params.samples, **observer, workers);
  if (!trial)
    return {Level::warning, subject, name + ": " + trial.error().message() + "; samples are compared on the CPU",
            trial.error().remedy};

  // State what follows for `observer: auto`.
  const std::string times = "; " + std::to_string(trial->samples) + " samples: " + to_text(trial->times);
  if (device.software)
    return {Level::note, subject, name + ": software, not a GPU; observer: auto uses the CPU" + times, ""};
  if (!trial->times.device_is_faster())
    return {Level::note, subject,
            name + ": a GPU, which is measured to be slower, so that observer: auto uses the CPU" + times, ""};
  return {Level::ok, subject, name + ": a GPU, which is measured to be faster and used with observer: auto" + times,
          ""};
}

std::vector<Finding> check_openni() {
  const auto devices = list_openni_devices();
  if (!devices) return {{Level::note, "OpenNI2", devices.error().what, devices.error().remedy}};
  std::vector<Finding> findings{{Level::ok, "OpenNI2",
                                 "version " + openni_version() + ", " + std::to_string(devices->size()) +
                                     (devices->size() == 1 ? " sensor" : " sensors"),
                                 ""}};
  for (const OpenNiDevice& device : *devices)
    findings.push_back(
        {Level::ok, "sensor", device.vendor + " " + device.name + ", --source openni2:" + device.uri, ""});
  return findings;
}

std::vector<Finding> check_usb() {
  const auto sensors = LibUsbBus().sensors();
  if (!sensors) return {{Level::note, "USB", sensors.error().what, sensors.error().remedy}};
  if (sensors->empty()) return {{Level::note, "USB", "no known depth sensor is plugged in", ""}};
  std::vector<Finding> findings;
  for (const UsbSensor& sensor : *sensors) findings.push_back(check_sensor(sensor));
  return findings;
}

}  // namespace barehand
