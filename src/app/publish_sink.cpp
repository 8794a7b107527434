#include "app/publish_sink.h"

#include "stages/publish/health_message.h"

namespace barehand {

BusSink::BusSink(const PublishParams& params, Publisher publisher, Health health, const Clock& clock)
    : maker_(params),
      publisher_(std::move(publisher)),
      health_(std::move(health)),
      clock_(clock),
      next_health_us_(clock.steady_us() + health_.period_us) {}

Result<std::unique_ptr<Sink>> BusSink::create(const PublishParams& params, const std::string& prefix, LcmBus& bus,
                                              Health health, const Clock& clock) {
  auto publisher = Publisher::create(prefix, {&bus});
  if (!publisher) return tl::unexpected(publisher.error());
  return std::unique_ptr<Sink>(new BusSink(params, std::move(*publisher), std::move(health), clock));
}

Result<void> BusSink::consume(const TrackedFrame& tracked) {
  auto sent = publisher_.send(maker_.process(*tracked.estimate));
  if (!sent) return sent;
  return send_health_when_due();
}

Result<void> BusSink::send_health_when_due() {
  if (clock_.steady_us() < next_health_us_) return {};
  next_health_us_ = clock_.steady_us() + health_.period_us;
  return publisher_.send(health_message(health_.take(), clock_.utime(), health_.source));
}

StatesLogSink::StatesLogSink(const PublishParams& params, std::unique_ptr<LcmLogWriter> log, Publisher publisher)
    : maker_(params), log_(std::move(log)), publisher_(std::move(publisher)) {}

Result<std::unique_ptr<Sink>> StatesLogSink::create(const PublishParams& params, const std::string& prefix,
                                                    const std::string& path) {
  auto log = LcmLogWriter::create(path, true);
  if (!log) return tl::unexpected(log.error());
  auto publisher = Publisher::create(prefix, {log->get()});
  if (!publisher) return tl::unexpected(publisher.error());
  return std::unique_ptr<Sink>(new StatesLogSink(params, std::move(*log), std::move(*publisher)));
}

Result<void> StatesLogSink::consume(const TrackedFrame& tracked) {
  return publisher_.send(maker_.process(*tracked.estimate));
}

}  // namespace barehand
