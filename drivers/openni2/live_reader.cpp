#include "drivers/openni2/live_reader.h"

namespace barehand {

LiveReader::LiveReader(const std::string& wanted, const OpenNiParams& params, std::size_t capacity, const Clock& clock)
    : params_(params),
      clock_(clock),
      output_("openni2" + (wanted.empty() ? "" : ":" + wanted), capacity, clock),
      finder_(
          wanted, [this] { look_again(); }, clock) {}

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
  const auto where = finder_.find();
  if (stop_) return;
  if (!where) {
    output_.notice("absent", where.error().what, where.error().remedy);
    return wait(backoff_.next());
  }
  auto sensor = OpenNiSensor::open(*where, params_);
  if (stop_) return;
  if (!sensor) {
    output_.notice("not opened", *where + " " + sensor.error().what, sensor.error().remedy);
    finder_.distrust();
    return wait(backoff_.next());
  }
  output_.notice("opened", "opened " + (*sensor)->description(), "", false);
  for (const std::string& shortfall : (*sensor)->shortfalls()) output_.notice(shortfall, "the sensor " + shortfall);
  session_ = std::make_unique<LiveSession>(std::move(*sensor), params_, output_, clock_, stop_);
}

void LiveReader::follow() {
  auto loss = session_->step();
  if (stop_) return;
  if (session_->proven()) backoff_.reset();
  if (finder_.gone(session_->where())) loss = LiveSession::Loss{"unplugged", "was unplugged", "plug it in again"};
  if (!loss) return;
  output_.notice(loss->kind, "the sensor at " + session_->where() + " " + loss->what, loss->remedy);
  session_.reset();
  if (stop_) return;
  if (loss->kind != "unplugged") wait(backoff_.next());
}

void LiveReader::wait(std::chrono::milliseconds duration) {
  std::unique_lock lock(mutex_);
  if (wake_.wait_for(lock, duration, [this] { return changed_; })) backoff_.reset();
  changed_ = false;
}

}  // namespace barehand
