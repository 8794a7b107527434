#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/hand/decision_table.h"
#include "io/hand/result_table.h"
#include "io/overlay/overlay.h"
#include "pipeline/sink.h"

namespace barehand {

/// --result: the table of formats.md, one a hand.
class ResultTableSink : public Sink {
 public:
  /// `profiles`: of the hands.
  static Result<std::unique_ptr<Sink>> create(const std::string& path,
                                              const std::vector<std::shared_ptr<const HandProfile>>& profiles,
                                              bool overwrite);
  std::string name() const override { return "result table"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  /// Without a frame there is no table.
  Result<void> finish() override;

 private:
  explicit ResultTableSink(std::vector<TableWriter> writers) : writers_(std::move(writers)) {}
  std::vector<TableWriter> writers_;
  std::int64_t frames_ = 0;
};

/// --log-decisions: what the tracker decided in every frame, and by what.
class DecisionSink : public Sink {
 public:
  static Result<std::unique_ptr<Sink>> create(const std::string& path, bool overwrite);
  std::string name() const override { return "decisions"; }
  Result<void> consume(const TrackedFrame& tracked) override;
  /// Without a frame there is no table.
  Result<void> finish() override;

 private:
  explicit DecisionSink(DecisionTable table) : table_(std::move(table)) {}
  DecisionTable table_;
  std::int64_t frames_ = 0;
};

/// --overlay: the tracked hands drawn over the images, on the first and then on each `every`-th frame.
class OverlaySink : public Sink {
 public:
  static Result<std::unique_ptr<Sink>> create(const std::string& path, double fps, int every, bool overwrite);
  std::string name() const override { return "overlay"; }
  Result<void> consume(const TrackedFrame& tracked) override {
    if (seen_++ % every_ != 0) return {};
    return writer_.write(*tracked.frame, tracked.estimates);
  }
  /// A folder that was made for nothing is removed.
  Result<void> finish() override;

 private:
  OverlaySink(OverlayWriter writer, int every, std::string made)
      : writer_(std::move(writer)), every_(every), made_(std::move(made)) {}
  OverlayWriter writer_;
  const std::int64_t every_;
  const std::string made_;  // the folder, if it was not there
  std::int64_t seen_ = 0;
};

/// --save-hand: the hands that were tracked with in the end, as fitted to the person.
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
  std::vector<std::shared_ptr<const HandProfile>> profiles_;  // null: of a hand that was not tracked
};

}  // namespace barehand
