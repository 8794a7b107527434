// The live page of a run, with the recorder that its button starts.
#include "app/track/live_page.h"

namespace barehand {

Result<void> LivePage::check(const TrackOptions& options) {
  if (!options.view)
    return options.view_record.empty() ? Result<void>()
                                       : fail("records from the live page", "--view-record", "give --view, too");
  if (const auto address = parse_web_address(*options.view); !address) return tl::unexpected(address.error());
  return options.view_record.empty() ? Result<void>() : LogRecorder::check_folder(options.view_record);
}

Result<std::unique_ptr<LivePage>> LivePage::open(const TrackOptions& options, std::shared_ptr<spdlog::logger> log) {
  const auto address = parse_web_address(*options.view);
  if (!address) return tl::unexpected(address.error());
  std::unique_ptr<LivePage> page(new LivePage);
  if (!options.view_record.empty())
    page->recorder_ =
        std::make_unique<LogRecorder>(LogRecorder::Options{options.view_record}, std::move(log), page->clock_);
  auto server = ViewServer::start({*address, options.view_origins, {}, page->recorder(), "--view=PORT"}, page->clock_);
  if (!server) return tl::unexpected(server.error());
  page->server_ = std::move(*server);
  return page;
}

}  // namespace barehand
