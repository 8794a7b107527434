#include "app/publish_sink.h"

#include "stages/publish/health_message.h"

namespace barehand {
namespace {

void follow(Slot<PublishParams>* news, HandMessageMaker& maker) {
  if (const auto params = news ? news->take() : std::nullopt) maker = HandMessageMaker(*params);
}

}  // namespace

BusSink::BusSink(const PublishParams& params, Publisher publisher, Health health, const Clock& clock,
                 Slot<PublishParams>* news)
    : maker_(params),
      publisher_(std::move(publisher)),
      health_(std::move(health)),
      clock_(clock),
      news_(news),
      next_health_us_(clock.steady_us() + health_.period_us) {}

Result<std::unique_ptr<Sink>> BusSink::create(const PublishParams& params, const std::string& prefix, LcmBus& bus,
                                              Health health, const Clock& clock, Slot<PublishParams>* news) {
  auto publisher = Publisher::create(prefix, {&bus});
  if (!publisher) return tl::unexpected(publisher.error());
  return std::unique_ptr<Sink>(new BusSink(params, std::move(*publisher), std::move(health), clock, news));
}

Result<void> BusSink::consume(const TrackedFrame& tracked) {
  follow(news_, maker_);
  auto sent = publisher_.send(maker_.process(*tracked.estimate));
  if (!sent) return sent;
  return send_health_when_due();
}

Result<void> BusSink::send_health_when_due() {
  if (clock_.steady_us() < next_health_us_) return {};
  next_health_us_ = clock_.steady_us() + health_.period_us;
  return publisher_.send(health_message(health_.take(), clock_.utime(), health_.source));
}

StatesLogSink::StatesLogSink(const PublishParams& params, std::unique_ptr<LcmLogWriter> log, Publisher publisher,
                             Slot<PublishParams>* news)
    : maker_(params), log_(std::move(log)), publisher_(std::move(publisher)), news_(news) {}

Result<std::unique_ptr<Sink>> StatesLogSink::create(const PublishParams& params, const std::string& prefix,
                                                    const std::string& path, Slot<PublishParams>* news) {
  auto log = LcmLogWriter::create(path, true);
  if (!log) return tl::unexpected(log.error());
  auto publisher = Publisher::create(prefix, {log->get()});
  if (!publisher) return tl::unexpected(publisher.error());
  return std::unique_ptr<Sink>(new StatesLogSink(params, std::move(*log), std::move(*publisher), news));
}

Result<void> StatesLogSink::consume(const TrackedFrame& tracked) {
  follow(news_, maker_);
  return publisher_.send(maker_.process(*tracked.estimate));
}

}  // namespace barehand
