// The command `barehand view`: its options.
#include "app/view/view_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "app/track/track_command.h"
#include "app/view/view_run.h"

namespace barehand {

void add_view_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ViewOptions>();
  ViewOptions& o = *options;
  CLI::App* view = app.add_subcommand("view", "Serve a page that shows the states of another tracker, or a log");
  view->add_option("LOG", o.logs, "LCM logs or MCAP files; states and images of one frame may be in different ones");
  view->add_flag("--lcm", o.lcm, "show what trackers send on the LCM network now");
  view->add_option("--lcm-url", o.lcm_url, "LCM network");
  view->add_option("--prefix", o.prefix, "channel prefix of the tracker");
  view->add_option("--port", o.port, "PORT or ADDRESS:PORT of the page; 0.0.0.0:8765: for the whole network")
      ->capture_default_str();
  add_origin_option(*view, "--origin", o.origins);
  view->add_option("--hand", o.hands, "profile whose skin is shown (hand.json); default: the mean adult hand")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  view->add_option("--record", o.record,
                   "with --lcm: folder into which the page's button records, as LCM logs named by their time; default: "
                   "it records nothing");
  view->add_option("--config", o.config, "as for track; only T_world_camera of it matters");
  view->callback([options, &exit_code] { exit_code = run_view(*options); });
}

}  // namespace barehand
