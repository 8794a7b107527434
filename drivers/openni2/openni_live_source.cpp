// Delivers the frames of a live OpenNI2 sensor.
#include "drivers/openni2/openni_live_source.h"

#include <exception>

#include "core/parallel/is_ready.h"
#include "drivers/openni2/live_reader.h"

namespace barehand {
namespace {

// Longest time that the destructor waits for the driver to return.
constexpr std::chrono::milliseconds kLongestFarewell{1500};

}  // namespace

OpenNiLiveSource::OpenNiLiveSource(const std::string& wanted, const OpenNiParams& params, std::size_t capacity,
                                   const Clock& clock, std::unique_ptr<UsbBus> usb)
    : name_("openni2" + (wanted.empty() ? "" : ":" + wanted)),
      reader_(std::make_shared<LiveReader>(wanted, params, capacity, clock, std::move(usb))) {
  std::packaged_task<void()> task([reader = reader_] { reader->run(); });
  finished_ = task.get_future().share();
  thread_ = std::thread(std::move(task));
}

OpenNiLiveSource::~OpenNiLiveSource() {
  reader_->request_stop();
  if (finished_.wait_for(kLongestFarewell) == std::future_status::ready) {
    thread_.join();
  } else {
    thread_.detach();
  }
}

SourceEvent OpenNiLiveSource::next(std::chrono::milliseconds patience) {
  if (auto event = reader_->output().box().take(patience)) return std::move(*event);
  if (!is_ready(finished_)) return Timeout{};

  // Only an exception, such as one of memory, ends the thread before the destructor stops it.
  try {
    finished_.get();
  } catch (const std::exception& e) {
    return SourceFailed{{std::string("the thread that reads the sensor ended: ") + e.what(), name_, "start again"}};
  }
  return Timeout{};
}

std::vector<QueueHealth> OpenNiLiveSource::queues() const {
  return {reader_->output().transit(), reader_->output().box().health()};
}

}  // namespace barehand
