#include "io/lcm/log_recorder.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <semaphore>

#include "core/log.h"
#include "io/lcm/lcm_log_reader.h"
#include "support/resource_limit.h"
#include "support/temp_folder.h"

namespace barehand {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kUser = 1, kOther = 2;
const std::string kName = "barehand-20261122T090000Z";

class LogRecorderTest : public ::testing::Test {
 protected:
  std::unique_ptr<LogRecorder> recorder(std::size_t capacity = 8) {
    return std::make_unique<LogRecorder>(LogRecorder::Options{folder_ / "takes", capacity}, make_silent_logger(),
                                         clock_);
  }
  void SetUp() override { fs::create_directory(folder_ / "takes"); }
  static void post(LogRecorder& recorder, std::int64_t utime) {
    recorder.post(utime, [utime](MessageSink& log) {
      return log.send("A", std::vector<std::uint8_t>{1, 2, 3}, utime);
    });
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "takes")) names.push_back(entry.path().filename());
    std::ranges::sort(names);
    return names;
  }
  /// The times of the events of a log.
  std::vector<std::int64_t> times(const std::string& name) const {
    std::vector<std::int64_t> times;
    const auto log = LcmLogReader::open(folder_ / ("takes/" + name));
    EXPECT_TRUE(log) << name;
    if (log)
      for (const LogEntry& entry : log->entries()) times.push_back(entry.timestamp);
    return times;
  }

  const test::TempFolder folder_;
  ManualClock clock_{1'795'338'000'000'000};  // 2026-11-22 09:00 UTC
};

TEST_F(LogRecorderTest, WritesWhatIsPostedWhileItRecords) {
  const auto r = recorder();
  post(*r, 1);
  ASSERT_TRUE(r->start(kUser));
  EXPECT_TRUE(r->recording());
  for (const std::int64_t utime : {10, 10, 20, 0, 30}) post(*r, utime);
  clock_.advance(2'500'000);
  r->stop(kUser);
  post(*r, 40);
  r->finish();

  EXPECT_THAT(files(), ElementsAre(kName + ".lcmlog"));
  EXPECT_THAT(times(kName + ".lcmlog"), ElementsAre(10, 10, 20, 0, 30));
  const RecorderState state = r->state();
  EXPECT_FALSE(state.recording);
  EXPECT_EQ(state.folder, folder_ / "takes");
  EXPECT_EQ(state.file, kName + ".lcmlog");
  EXPECT_EQ(state.frames, 3) << "two entries of one frame, and one of none";
  EXPECT_EQ(state.bytes, static_cast<std::int64_t>(fs::file_size(folder_ / ("takes/" + kName + ".lcmlog"))));
  EXPECT_EQ(state.seconds, 2.5);
  EXPECT_EQ(state.note, "");
}

TEST_F(LogRecorderTest, IsUnfinishedUntilItIsWhole) {
  const auto r = recorder();
  ASSERT_TRUE(r->start(kUser));
  EXPECT_THAT(files(), ElementsAre(kName + ".lcmlog.unfinished"));
  post(*r, 1);
  r->finish();
  EXPECT_THAT(files(), ElementsAre(kName + ".lcmlog"));
}

TEST_F(LogRecorderTest, ReplacesNothing) {
  test::write_text(folder_ / ("takes/" + kName + ".lcmlog"), "somebody's");
  const auto r = recorder();
  for (const std::int64_t utime : {1, 2}) {
    ASSERT_TRUE(r->start(kUser));
    post(*r, utime);
    r->stop(kUser);
  }
  r->finish();
  EXPECT_THAT(files(), ElementsAre(kName + "-2.lcmlog", kName + "-3.lcmlog", kName + ".lcmlog"));
  EXPECT_EQ(test::read_text(folder_ / ("takes/" + kName + ".lcmlog")), "somebody's");
  EXPECT_THAT(times(kName + "-3.lcmlog"), ElementsAre(2));
}

TEST_F(LogRecorderTest, GoesOnWhereAnotherUserStartsAndSaysWhoStopped) {
  const auto r = recorder();
  ASSERT_TRUE(r->start(kUser));
  ASSERT_TRUE(r->start(kOther));
  post(*r, 1);
  r->stop(kOther);
  r->stop(kUser);
  r->finish();
  EXPECT_EQ(r->state().note, "Stopped from another page.");
  EXPECT_FALSE(r->state().failed);
  EXPECT_THAT(files(), ElementsAre(kName + ".lcmlog"));
}

TEST_F(LogRecorderTest, LeavesNothingWhereNoFrameCame) {
  const auto r = recorder();
  ASSERT_TRUE(r->start(kUser));
  r->finish();
  EXPECT_THAT(files(), IsEmpty());
  EXPECT_EQ(r->state().file, "");
  EXPECT_THAT(r->state().note, HasSubstr("No frame came"));
}

TEST_F(LogRecorderTest, EndsARecordingWhoseProgramEnds) {
  const auto r = recorder();
  ASSERT_TRUE(r->start(kUser));
  post(*r, 1);
  r->finish();
  EXPECT_FALSE(r->recording());
  EXPECT_EQ(r->state().note, "");
  EXPECT_THAT(times(kName + ".lcmlog"), ElementsAre(1));
}

TEST_F(LogRecorderTest, NeverWaitsAndCountsWhatItDrops) {
  const auto r = recorder(2);
  ASSERT_TRUE(r->start(kUser));
  std::binary_semaphore busy(0), go_on(0);
  r->post(1, [&](MessageSink&) -> Result<void> {
    busy.release();
    go_on.acquire();
    return {};
  });
  busy.acquire();
  for (int utime = 2; utime <= 6; ++utime) post(*r, utime);
  r->stop(kUser);
  EXPECT_FALSE(r->state().recording);
  EXPECT_TRUE(r->state().writing) << "what waits is still to be written";
  go_on.release();
  r->finish();
  EXPECT_EQ(r->state().dropped, 3);
  EXPECT_FALSE(r->state().writing);
  EXPECT_THAT(times(kName + ".lcmlog"), ElementsAre(5, 6)) << "the newest ones";
}

TEST_F(LogRecorderTest, EndsWhereTheDiskIsFullAndKeepsWhatWasWritten) {
  const auto r = recorder();
  ASSERT_TRUE(r->start(kUser));
  post(*r, 1);
  r->post(2, [](MessageSink& log) {
    const test::FileSizeLimit full(100);
    return log.send("A", std::vector<std::uint8_t>(1000), 2);
  });
  while (r->recording()) std::this_thread::yield();
  r->finish();
  EXPECT_TRUE(r->state().failed);
  EXPECT_THAT(r->state().note, HasSubstr("cannot write the log"));
  EXPECT_EQ(r->state().frames, 1);
  EXPECT_THAT(times(kName + ".lcmlog"), ElementsAre(1));

  // The recorder can be started again, since there may be space on the disk by then.
  ASSERT_TRUE(r->start(kUser));
  EXPECT_FALSE(r->state().failed);
  post(*r, 3);
  r->finish();
  EXPECT_THAT(times(kName + "-2.lcmlog"), ElementsAre(3));
}

TEST_F(LogRecorderTest, SaysThatTheFolderIsGone) {
  // The folder is removed while the recorder records.
  const auto r = recorder();
  ASSERT_TRUE(r->start(kUser));
  fs::remove_all(folder_ / "takes");
  post(*r, 1);
  while (r->recording()) std::this_thread::yield();
  r->finish();
  EXPECT_TRUE(r->state().failed);
  EXPECT_THAT(r->state().note, HasSubstr("the folder is gone"));

  // The folder is missing when the recorder is started.
  const auto started = r->start(kUser);
  ASSERT_FALSE(started);
  EXPECT_THAT(started.error().message(), HasSubstr(folder_ / "takes"));
  EXPECT_TRUE(r->state().failed);
  EXPECT_FALSE(r->recording());
}

TEST_F(LogRecorderTest, ChecksTheFolderBeforehand) {
  EXPECT_TRUE(LogRecorder::check_folder(folder_ / "takes"));
  test::write_text(folder_ / "file", "");
  for (const std::string& wrong : {folder_ / "nowhere", folder_ / "file"}) {
    const auto checked = LogRecorder::check_folder(wrong);
    ASSERT_FALSE(checked) << wrong;
    EXPECT_EQ(checked.error().where, wrong);
  }
}

}  // namespace
}  // namespace barehand
