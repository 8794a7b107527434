#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/hand/decision_table.h"
#include "io/hand/result_table.h"
#include "io/overlay/overlay.h"
#include "pipeline/sink.h"

namespace barehand {

/// --result: writes one table per hand, in the format of docs/formats.md.
class ResultTableSink : public Sink {
 public:
  /// `profiles`: one per hand; path_of_hand() names the file of each.
  static Result<std::unique_ptr<Sink>> create(const std::string& path,
                                              const std::vector<std::shared_ptr<const HandProfile>>& profiles,
                                              bool overwrite);
  std::string name() const override { return "result table"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  /// Writes no table if there was no frame.
  Result<void> finish() override;

 private:
  explicit ResultTableSink(std::vector<TableWriter> writers) : writers_(std::move(writers)) {}
  std::vector<TableWriter> writers_;
  std::int64_t frames_ = 0;
};

/// --log-decisions: writes a table of what the tracker decided in every frame, with the scores compared.
class DecisionSink : public Sink {
 public:
  static Result<std::unique_ptr<Sink>> create(const std::string& path, bool overwrite);
  std::string name() const override { return "decisions"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  /// Writes no table if there was no frame.
  Result<void> finish() override;

 private:
  explicit DecisionSink(DecisionTable table) : table_(std::move(table)) {}
  DecisionTable table_;
  std::int64_t frames_ = 0;
};

/// --overlay: draws the tracked hands over the images of the first and then of each `every`-th frame.
class OverlaySink : public Sink {
 public:
  static Result<std::unique_ptr<Sink>> create(const std::string& path, double fps, int every, bool overwrite,
                                              SegmentNames names);
  std::string name() const override { return "overlay"; }
  Result<void> consume(const TrackedFrame& tracked) override {
    if (seen_++ % every_ != 0) return {};
    return writer_.write(*tracked.frame, tracked.estimates);
  }
  /// Removes the folder again if this sink made it and there was no frame.
  Result<void> finish() override;

 private:
  OverlaySink(OverlayWriter writer, int every, std::string made)
      : writer_(std::move(writer)), every_(every), made_(std::move(made)) {}
  OverlayWriter writer_;
  const std::int64_t every_;
  const std::string made_;  // the folder if this sink made it, otherwise empty
  std::int64_t seen_ = 0;
};

/// --save-hand: saves the profiles of the tracked hands at the end of the run, as fitted to the person by then.
class SaveHandSink : public Sink {
 public:
  static Result<std::unique_ptr<Sink>> create(const std::string& path,
                                              const std::vector<std::shared_ptr<const HandProfile>>& profiles);
  std::string name() const override { return "hand profile"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  Result<void> finish() override;

 private:
  explicit SaveHandSink(std::string path) : path_(std::move(path)) {}

  const std::string path_;
  std::vector<std::shared_ptr<const HandProfile>> profiles_;  // one per hand; null: that hand was not tracked
};

}  // namespace barehand
