// Recognises the grasps of the hands in a log of hand states anew, so that a classifier can be tried without tracking
// once more.
//
//   restate_grasps CLASSIFIER LOG OUT
//
// OUT is an LCM log of the grasp_state_t that `barehand track` would have written with this classifier.
#include <cstdio>

#include "io/lcm/lcm_log_writer.h"
#include "stages/grasp/grasp_stage.h"
#include "stages/publish/grasp_messages.h"
#include "tools/training/grasps/logged_estimate.h"

namespace {

using namespace barehand;

Result<void> restate(char** argv) {
  auto classifier = GraspClassifier::load(argv[1]);
  if (!classifier) return tl::unexpected(classifier.error());
  auto out = LcmLogWriter::create(argv[3], true);
  if (!out) return tl::unexpected(out.error());

  GraspStage stage(std::move(*classifier));
  const auto restated = visit_hands(argv[2], [&](const LoggedHand& hand) -> Result<void> {
    const auto estimate = std::make_shared<const HandEstimate>(hand.estimate);
    const auto grasps = stage.process({estimate}, hand.contacts);
    if (!grasps) return tl::unexpected(grasps.error());
    const auto message = encode_message(grasp_message(*estimate, estimate->status, (**grasps)[0]));
    return (*out)->send("GRASP_STATE", message, hand.state.utime);
  });
  if (!restated) return restated;
  return (*out)->finish();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: restate_grasps CLASSIFIER LOG OUT\n");
    return 2;
  }
  const auto done = restate(argv);
  if (!done) std::fprintf(stderr, "restate_grasps: %s\n", done.error().message().c_str());
  return done ? 0 : 1;
}
