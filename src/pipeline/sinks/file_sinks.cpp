// The sinks that write result tables, decisions and overlay images.
#include "pipeline/sinks/file_sinks.h"

#include <filesystem>

#include "core/both.h"
#include "io/atomic_file.h"
#include "io/hand/hand_json.h"
#include "io/hand/path_of_hand.h"

namespace barehand {

Result<std::unique_ptr<Sink>> ResultTableSink::create(const std::string& path,
                                                      const std::vector<std::shared_ptr<const HandProfile>>& profiles,
                                                      bool overwrite) {
  std::vector<TableWriter> writers;
  for (std::size_t k = 0; k < profiles.size(); ++k) {
    auto writer = TableWriter::create(path_of_hand(path, static_cast<int>(k), profiles[k]->handedness), overwrite);
    if (!writer) return tl::unexpected(writer.error());
    writers.push_back(std::move(*writer));
  }
  return std::unique_ptr<Sink>(new ResultTableSink(std::move(writers)));
}

Result<void> ResultTableSink::consume(const TrackedFrame& tracked) {
  Result<void> result;
  for (std::size_t k = 0; k < writers_.size(); ++k)
    if (auto written = writers_[k].write(*tracked.estimates[k]); !written && result) result = std::move(written);
  ++frames_;
  return result;
}

Result<void> ResultTableSink::finish() {
  Result<void> result;
  if (frames_ == 0) return result;
  for (TableWriter& writer : writers_) result = both(std::move(result), writer.finish());
  return result;
}

Result<std::unique_ptr<Sink>> DecisionSink::create(const std::string& path, bool overwrite) {
  auto table = DecisionTable::create(path, overwrite);
  if (!table) return tl::unexpected(table.error());
  return std::unique_ptr<Sink>(new DecisionSink(std::move(*table)));
}

Result<void> DecisionSink::consume(const TrackedFrame& tracked) {
  ++frames_;
  Result<void> result;
  for (const HandEstimatePtr& estimate : tracked.estimates)
    if (auto written = table_.write(*estimate); !written && result) result = std::move(written);
  return result;
}

Result<void> DecisionSink::finish() { return frames_ > 0 ? table_.finish() : Result<void>(); }

Result<std::unique_ptr<Sink>> OverlaySink::create(const std::string& path, double fps, int every, bool overwrite,
                                                  SegmentNames names) {
  std::error_code ignored;
  const bool there = std::filesystem::exists(path, ignored);
  auto writer = OverlayWriter::open(path, fps / every, overwrite, names);
  if (!writer) return tl::unexpected(writer.error());
  const bool made = !there && std::filesystem::is_directory(path, ignored);
  return std::unique_ptr<Sink>(new OverlaySink(std::move(*writer), every, made ? path : ""));
}

Result<void> OverlaySink::finish() {
  auto finished = writer_.finish();
  std::error_code ignored;
  if (seen_ == 0 && !made_.empty()) std::filesystem::remove(made_, ignored);  // fails unless it is empty
  return finished;
}

Result<std::unique_ptr<Sink>> SaveHandSink::create(const std::string& path,
                                                   const std::vector<std::shared_ptr<const HandProfile>>& profiles) {
  for (std::size_t k = 0; k < profiles.size(); ++k)
    if (auto possible = check_writable(path_of_hand(path, static_cast<int>(k), profiles[k]->handedness)); !possible)
      return tl::unexpected(possible.error());
  return std::unique_ptr<Sink>(new SaveHandSink(path));
}

Result<void> SaveHandSink::consume(const TrackedFrame& tracked) {
  profiles_.resize(tracked.estimates.size());
  for (std::size_t k = 0; k < profiles_.size(); ++k)
    if (tracked.estimates[k]->has_pose()) profiles_[k] = tracked.estimates[k]->profile;
  return {};
}

Result<void> SaveHandSink::finish() {
  Result<void> result;
  bool tracked = false;
  for (std::size_t k = 0; k < profiles_.size(); ++k) {
    if (!profiles_[k]) continue;
    tracked = true;
    const std::string path = path_of_hand(path_, static_cast<int>(k), profiles_[k]->handedness);
    result = both(std::move(result), save_profile(*profiles_[k], path));
  }
  if (!tracked) return fail("no hand was tracked, nothing to save", path_, "hold the open hand before the sensor");
  return result;
}

}  // namespace barehand
