// The thread of a live OpenNI2 source: finds a sensor, reads it, and recovers it after faults.
#include "drivers/openni2/live_reader.h"

#include <algorithm>

#include "drivers/openni2/usb_address.h"

namespace barehand {
namespace {

// A reset disturbs everything that uses the device. It is therefore done only after the sensor was opened
// kSilentUntilReset times and never answered, and at most kMostResets times in a row.
constexpr int kSilentUntilReset = 2, kMostResets = 3;

}  // namespace

LiveReader::LiveReader(const std::string& wanted, const OpenNiParams& params, std::size_t capacity, const Clock& clock,
                       std::unique_ptr<UsbBus> usb)
    : params_(params),
      clock_(clock),
      output_("openni2" + (wanted.empty() ? "" : ":" + wanted), capacity, clock),
      usb_(std::move(usb)),
      finder_(
          wanted, [this] { look_again(); }, usb_.get(), clock) {
  // Watch the USB bus, so that a sensor is noticed as soon as it is plugged in.
  if (!usb_) return;
  const auto changed = [this] {
    finder_.bus_changed();
    look_again();
  };
  if (auto watched = usb_->watch(changed); !watched)
    output_.notice("usb", watched.error().what, "a sensor that is plugged in is noticed within 2 s", false);
}

void LiveReader::run() {
  while (!stop_) session_ ? follow() : connect();
  session_.reset();
  finder_.unload();
}

void LiveReader::request_stop() {
  stop_ = true;
  look_again();
}

void LiveReader::look_again() {
  const std::lock_guard lock(mutex_);
  changed_ = true;
  wake_.notify_all();
}

void LiveReader::connect() {
  // Find the sensor.
  const auto where = finder_.find();
  if (stop_) return;
  if (!where) {
    output_.await("absent", where.error().what, where.error().remedy);
    return wait(backoff_.next());
  }

  // Open the sensor.
  auto sensor = OpenNiSensor::open(*where, params_);
  if (stop_) return;
  if (!sensor) {
    output_.await("not opened", *where + " " + sensor.error().what, sensor.error().remedy);
    finder_.distrust();
    return wait(backoff_.next());
  }

  // Report what was opened, and what it lacks.
  output_.end_waiting();
  output_.notice("opened", "opened " + (*sensor)->description() + usb_port(*where), "", false);
  for (const std::string& shortfall : (*sensor)->shortfalls()) output_.notice(shortfall, "the sensor " + shortfall);
  session_ = std::make_unique<LiveSession>(std::move(*sensor), params_, output_, clock_, stop_);
}

void LiveReader::follow() {
  // Read the sensor. If it delivers, it is healthy, so earlier failures no longer count.
  auto loss = session_->step();
  if (stop_) return;
  if (session_->proven()) {
    backoff_.reset();
    silent_ = resets_ = 0;
  }

  // Check whether the sensor was lost.
  if (finder_.gone(session_->where())) loss = LiveSession::Loss{"unplugged", "was unplugged", "plug it in again"};
  if (!loss) return;

  // Report the loss and close the sensor.
  const std::string where = session_->where();
  silent_ = loss->kind == "stalled" && !session_->proven() ? silent_ + 1 : 0;
  output_.notice(loss->kind, "the sensor at " + where + " " + loss->what, loss->remedy);
  session_.reset();
  if (stop_) return;

  // Reset a sensor that opens but never answers.
  if (silent_ >= kSilentUntilReset && resets_ < kMostResets) reset(where);
  if (loss->kind != "unplugged") wait(backoff_.next());
}

std::string LiveReader::usb_port(const std::string& uri) const {
  const auto address = usb_address(uri);
  const auto sensors = usb_ && address ? usb_->sensors() : Result<std::vector<UsbSensor>>{};
  if (!sensors) return "";
  const auto sensor = std::ranges::find(*sensors, address, &UsbSensor::address);
  return sensor == sensors->end() ? "" : "; " + to_text(*sensor);
}

void LiveReader::reset(const std::string& uri) {
  const auto address = usb_address(uri);
  if (!usb_ || !address) return;
  silent_ = 0;
  ++resets_;
  finder_.unload();  // unloads the sensor's driver, which would otherwise keep the device open
  if (stop_) return;
  if (auto done = usb_->reset(*address); !done)
    output_.notice("not reset", done.error().message(), done.error().remedy);
  else
    output_.notice("reset", "the sensor at " + uri + " can be opened but sends no frames: its USB port was reset");
}

void LiveReader::wait(std::chrono::milliseconds duration) {
  std::unique_lock lock(mutex_);
  if (wake_.wait_for(lock, duration, [this] { return changed_; })) backoff_.reset();
  changed_ = false;
}

}  // namespace barehand
