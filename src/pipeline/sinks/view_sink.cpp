// The sink that passes frames and hands to the live page and its recorder.
#include "pipeline/sinks/view_sink.h"

#include <limits>
#include <vector>

#include "core/format.h"
#include "pipeline/sinks/record_frame.h"
#include "stages/publish/health_message.h"

namespace barehand {
namespace {

template <class Message>
ViewMessage encoded(const char* channel, const Message& message) {
  ViewMessage out{channel, {}};
  out.bytes.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(out.bytes.data(), 0, static_cast<int>(out.bytes.size()));
  return out;
}

}  // namespace

ViewSink::ViewSink(const PublishParams& params, ViewServer& server, Input input, const Clock& clock,
                   Slot<PublishParams>* pending)
    : makers_(params, pending),
      server_(server),
      input_(std::move(input)),
      clock_(clock),
      frame_us_(clock.steady_us()),
      status_us_(clock.steady_us() - kStatusPeriodUs) {}

Result<void> ViewSink::consume(const TrackedFrame& tracked) {
  frame_us_ = clock_.steady_us();
  any_frame_ = true;

  // Make the messages even if no client is connected, so that later ones are smoothed with the same history as on the
  // bus.
  const FrameMessages messages = makers_.process(tracked);
  if (server_.has_clients()) server_.show(make_frame(tracked, messages));

  // Post the same messages to the recorder of the live page, which writes them in its own thread.
  if (input_.recorder && input_.recorder->recording())
    input_.recorder->post(tracked.frame->utime,
                          [frame = tracked.frame, prefix = input_.prefix,
                           hands = std::vector(messages.hands.begin(), messages.hands.end()),
                           objects = std::vector(messages.objects.begin(), messages.objects.end())](auto& log) {
                            return record_frame(log, prefix, *frame, hands, objects);
                          });
  return idle();
}

Result<void> ViewSink::idle() {
  if (clock_.steady_us() - status_us_ >= kStatusPeriodUs || recording_changed()) show_status();
  return {};
}

Result<void> ViewSink::finish() {
  if (input_.recorder) input_.recorder->finish();
  frame_us_ = clock_.steady_us();  // that no more frames come is no trouble
  show_status();
  return {};
}

/// Whether a recording has started or ended since the last status. Then a status is sent at once, so that the user sees
/// the effect of the button.
bool ViewSink::recording_changed() const { return input_.recorder && input_.recorder->recording() != shown_recording_; }

ViewFramePtr ViewSink::make_frame(const TrackedFrame& tracked, const FrameMessages& messages) {
  // Take over what identifies the frame.
  ViewFrame::Content content;
  content.utime = tracked.frame->utime;
  content.number = tracked.frame->number;
  content.frame = tracked.frame;

  // Collect the messages of each hand, and where it is.
  FrameVector<Eigen::Vector3d> places;
  for (std::size_t k = 0; k < tracked.estimates.size(); ++k) {
    const HandEstimate& estimate = *tracked.estimates[k];
    if (estimate.has_pose())
      for (const SegmentState& segment : estimate.segments) places.push_back(segment.T_camera_segment.t);

    // Encode the messages of the hand as they are on the bus.
    const HandMessages& hand = messages.hands[k];
    content.messages.push_back(encoded("HAND_STATE", hand.state));
    content.messages.push_back(encoded("GLOVE_STATE", hand.glove));
    content.messages.push_back(encoded("HAND_JOINTS", hand.joints));
    if (hand.contact) content.messages.push_back(encoded("CONTACT_STATE", *hand.contact));
    if (hand.grasp) content.messages.push_back(encoded("GRASP_STATE", *hand.grasp));

    // Keep the messages for the clients of Foxglove, and add the skin.
    content.hands.push_back({hand.state, hand.glove, hand.joints, hand.contact, hand.grasp});
    content.skins[static_cast<std::size_t>(estimate.handedness)] = skin_of(estimate);
  }

  // Add the objects, the part of the image around the hands, and from time to time the health.
  for (const object_state_t& object : messages.objects) content.messages.push_back(encoded("OBJECT_STATE", object));
  content.objects.assign(messages.objects.begin(), messages.objects.end());
  content.focus = focus_on(places, tracked.frame->camera);
  content.depths = depths_.follow(typical_range(*tracked.frame), content.utime);
  content.T_world_camera = input_.T_world_camera;
  if (clock_.steady_us() - status_us_ >= kStatusPeriodUs)  // as often as in the status of the page
    content.health = health_message(input_.health(), clock_.utime(), input_.source);
  return std::allocate_shared<const ViewFrame>(FrameAllocator<ViewFrame>(), std::move(content));
}

ViewSkinPtr ViewSink::skin_of(const HandEstimate& estimate) {
  ViewSkinPtr& last = skins_[static_cast<std::size_t>(estimate.handedness)];
  if (estimate.profile && (!last || last->profile() != estimate.profile))
    last = std::make_shared<const ViewSkin>(estimate.profile);
  return last;
}

void ViewSink::show_status() {
  status_us_ = clock_.steady_us();
  ViewState state{input_.source, input_.live, "", server_.clients(), {}, {}, input_.T_world_camera};
  if (input_.scan) state.scan = input_.scan();
  state.record = input_.recorder ? input_.recorder->state() : RecorderState{};
  shown_recording_ = state.record->recording;
  if (!server_.has_clients()) return server_.show_status(status_json(state));

  state.health = input_.health();
  state.health->queues.push_back(server_.health());
  if (status_us_ - frame_us_ >= kNoFramesUs) state.trouble = trouble(*state.health);
  server_.show_status(status_json(state));
}

/// Why no frame has been tracked for a while, as far as the program knows.
std::string ViewSink::trouble(const PipelineHealth& health) const {
  const auto silent_s = static_cast<long long>((status_us_ - frame_us_) / 1'000'000);

  // Work that is known to take long comes first.
  if (const std::string work = input_.held_up_by ? input_.held_up_by() : ""; !work.empty())
    return formatted("%s So far it has taken %lld s.", work.c_str(), silent_s);

  // Either a frame is being tracked, or none has arrived.
  const bool at_work = health.captured > health.published + health.dropped + health.failed;
  if (at_work)
    return formatted("Tracking the %s frame has taken %lld s so far. Is the processor busy with other work?",
                     any_frame_ ? "next" : "first", silent_s);
  return formatted("No frame has come %s%lld s. %s", any_frame_ ? "for " : "yet, for ", silent_s,
                   input_.if_silent.c_str());
}

}  // namespace barehand
