#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/shared/known_objects.h"

namespace barehand {

/// The arguments of `barehand track`.
struct TrackOptions {
  std::string source;
  std::string config = "default.yaml";
  std::vector<std::string> hands;  ///< none: the recording's own, or the shipped adult hand
  std::optional<std::int64_t> start;
  std::int64_t step = 1;
  std::string init = "auto";
  ObjectMeshes objects;
  std::string result, states_log, mcap, decisions, overlay, save_hand;  ///< "": not written
  std::string saved_later;  ///< a file that the caller writes after the run, checked with the other outputs; "": none
  bool overwrite = false;   ///< whether outputs may replace existing files
  int overlay_every = 1;    ///< only every n-th frame is drawn
  bool overlay_names = false;  ///< whether the overlay names the segments
  std::string lcm_url;
  std::optional<std::int64_t> seed;  ///< replaces the configuration's seed
  int threads = 1;
  bool single_threaded = false;  ///< --inline
  bool no_publish = false;
  std::string print_config;  ///< which keys to print instead of tracking: user, all or changed; "": none
  bool health = false;
  std::optional<std::string> view;        ///< PORT or ADDRESS:PORT of the live page; none: no page is served
  std::vector<std::string> view_origins;  ///< foreign origins whose pages may connect
  std::string view_record;                ///< folder for recordings started on the page; "": nothing can be recorded

  /// The outputs that are one file each.
  static constexpr std::array kFiles = {&TrackOptions::result, &TrackOptions::states_log, &TrackOptions::mcap,
                                        &TrackOptions::decisions, &TrackOptions::save_hand};
};

}  // namespace barehand
