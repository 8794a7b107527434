// The sinks that publish hand states on LCM or write them to a log.
#include "pipeline/sinks/publish_sink.h"

#include "stages/publish/health_message.h"

namespace barehand {

namespace {

/// Everything is sent even if something fails; the first error is returned.
void note(Result<void>& first, Result<void> sent) {
  if (first) first = std::move(sent);
}

}  // namespace

Result<void> StatePublisher::send(const TrackedFrame& tracked) {
  Result<void> result;
  const FrameMessages messages = makers_.process(tracked);
  for (const HandMessages& hand : messages.hands) {
    note(result, publisher_.send_hand(hand));
    note(result, publisher_.send_findings(hand));
  }
  for (const object_state_t& object : messages.objects) note(result, publisher_.send(object));
  return result;
}

Result<void> StatePublisher::send_hands(const TrackedFrame& tracked) {
  Result<void> result;
  for (const HandMessages& hand : makers_.make_hands(tracked)) note(result, publisher_.send_hand(hand));
  return result;
}

Result<void> StatePublisher::send_findings(const TrackedFrame& tracked) {
  Result<void> result;
  const FrameMessages messages = makers_.add_findings(tracked);
  for (const HandMessages& hand : messages.hands) note(result, publisher_.send_findings(hand));
  for (const object_state_t& object : messages.objects) note(result, publisher_.send(object));
  return result;
}

BusSink::BusSink(StatePublisher states, Health health, const Clock& clock)
    : states_(std::move(states)),
      health_(std::move(health)),
      clock_(clock),
      next_health_us_(clock.steady_us() + health_.period_us) {}

Result<std::unique_ptr<BusSink>> BusSink::create(const PublishParams& params, const std::string& prefix, LcmBus& bus,
                                                 Health health, const Clock& clock, Slot<PublishParams>* pending) {
  auto publisher = Publisher::create(prefix, {&bus});
  if (!publisher) return tl::unexpected(publisher.error());
  return std::unique_ptr<BusSink>(
      new BusSink(StatePublisher(params, std::move(*publisher), pending), std::move(health), clock));
}

Result<void> BusSink::consume(const TrackedFrame& tracked) {
  auto sent = states_.send_hands(tracked);
  if (!sent) return sent;
  return send_health_when_due();
}

Result<void> BusSink::send_health_when_due() {
  if (clock_.steady_us() < next_health_us_) return {};
  next_health_us_ = clock_.steady_us() + health_.period_us;
  return states_.send(health_message(health_.take(), clock_.utime(), health_.source));
}

Result<std::unique_ptr<Sink>> StatesLogSink::create(const PublishParams& params, const std::string& prefix,
                                                    const std::string& path, bool overwrite,
                                                    Slot<PublishParams>* pending) {
  auto log = LcmLogWriter::create(path, overwrite);
  if (!log) return tl::unexpected(log.error());
  auto publisher = Publisher::create(prefix, {log->get()});
  if (!publisher) return tl::unexpected(publisher.error());
  return std::unique_ptr<Sink>(
      new StatesLogSink(std::move(*log), StatePublisher(params, std::move(*publisher), pending)));
}

}  // namespace barehand
