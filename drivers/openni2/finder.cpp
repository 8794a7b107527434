// Finds the OpenNI2 sensors that are plugged in, and loads OpenNI2 again if the USB devices change.
#include "drivers/openni2/finder.h"

#include <algorithm>

namespace barehand {
namespace {

// Times after which OpenNI2 is loaded again although no change was seen [us]: kReloadBlindly if the devices on the bus
// cannot be listed, kReloadAnyway if they can.
constexpr std::int64_t kReloadBlindly = 600'000'000, kReloadAnyway = 86'400'000'000;

}  // namespace

OpenNiFinder::OpenNiFinder(std::string wanted, std::function<void()> came, UsbBus* usb, const Clock& clock)
    : wanted_(std::move(wanted)), came_(std::move(came)), usb_(usb), clock_(clock) {}

Result<void> OpenNiFinder::load() {
  // Release the library, and note the state of the bus.
  library_.reset();
  told_ = false;
  bus_when_loaded_ = bus_state();
  loaded_us_ = looked_us_;

  // OpenNI2 reports changes of the bus on its own threads.
  auto library = OpenNiLibrary::load([this](bool came, const std::string& uri) {
    if (came) return came_();
    {
      const std::lock_guard lock(mutex_);
      gone_.push_back(uri);
    }
    came_();
  });

  // Keep the library if it could be loaded.
  if (!library) return tl::unexpected(library.error());
  library_ = std::move(*library);
  return {};
}

Result<std::string> OpenNiFinder::find() {
  looked_us_ = clock_.steady_us();  // read before OpenNI2 is called, which may hang until the clock is destroyed
  if (!library_)
    if (auto loaded = load(); !loaded) return tl::unexpected(loaded.error());

  // Forget the sensors that were unplugged before this search.
  {
    const std::lock_guard lock(mutex_);
    gone_.clear();
  }

  // Take the first sensor that matches.
  std::string others;
  for (const openni::DeviceInfo& sensor : library_->sensors()) {
    const std::string uri = sensor.getUri();
    if (uri.find(wanted_) != std::string::npos) return uri;
    others += (others.empty() ? "; there are: " : ", ") + uri;
  }

  // Have OpenNI2 loaded again, since it may not have noticed a sensor that was plugged in.
  distrust();
  return not_found(others);
}

tl::unexpected<Error> OpenNiFinder::not_found(const std::string& others) const {
  // Report it if no known sensor is plugged in.
  const auto plugged = usb_ ? usb_->sensors() : Result<std::vector<UsbSensor>>{};
  std::string what = whom() + " yet" + others;
  if (!plugged || plugged->empty()) return fail(what, "OpenNI2", "plug it in; barehand doctor lists what is found");

  // Name the known sensors that are plugged in, and what to do if one of them cannot be opened.
  std::string remedy =
      "if OpenNI2 has no driver for it, copy the manufacturer's driver into OpenNI2/Drivers beside libOpenNI2.so.0";
  for (const UsbSensor& sensor : *plugged) {
    what += "; plugged in: " + to_text(sensor);

    // A sensor that cannot be opened determines the remedy.
    if (!sensor.obstacle) continue;
    what += ", " + sensor.obstacle->what;
    remedy = sensor.obstacle->remedy;
  }
  return fail(what, "OpenNI2", remedy);
}

void OpenNiFinder::distrust() {
  const std::string bus = bus_state();
  const std::int64_t patience = bus.empty() ? kReloadBlindly : kReloadAnyway;
  if (bus != bus_when_loaded_ || told_ || looked_us_ - loaded_us_ > patience)
    library_.reset();  // the next find() loads it again
}

bool OpenNiFinder::gone(const std::string& uri) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::find(gone_, uri) != gone_.end();
}

}  // namespace barehand
