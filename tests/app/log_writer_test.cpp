// SPDX-License-Identifier: Apache-2.0
#include "app/log_writer.h"

#include <gmock/gmock.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

namespace orbwatch::app {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

/// Reader of the log that may stop reading.
class Reader {
 public:
  LogWriter::Output output() {
    return [this](const LogRecord& record) {
      std::unique_lock lock(mutex_);
      ++entered_;
      changed_.notify_all();
      changed_.wait(lock, [this] { return reads_; });
      lines_.emplace_back(record.text);
      cameras_.emplace_back(record.fields.camera);
      faults_.emplace_back(record.fields.fault);
      triggers_.push_back(record.fields.trigger);
    };
  }

  void stop_reading() { set(false); }
  void go_on() { set(true); }

  /// Returns when a writer waits for it with a line.
  void await_line() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return entered_ > lines_.size(); });
  }

  std::vector<std::string> lines() {
    const std::lock_guard lock(mutex_);
    return lines_;
  }
  std::vector<std::string> cameras_, faults_;
  std::vector<std::uint64_t> triggers_;

 private:
  void set(bool reads) {
    const std::lock_guard lock(mutex_);
    reads_ = reads;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool reads_ = true;
  std::size_t entered_ = 0;
  std::vector<std::string> lines_;
};

TEST(LogWriterTest, KeepsTheOrderOfAThreadAndTheFields) {
  Reader reader;
  LogWriter log(reader.output());
  log_soon(LogLevel::Warning, {"first", " line"},
           {.camera = "colour", .fault = "stalled", .trigger = 7});
  log_soon(LogLevel::Info, {"second"});
  log_line(LogLevel::Info, "third", {.camera = "thermal"});
  EXPECT_THAT(reader.lines(), ElementsAre("first line", "second", "third"));
  EXPECT_THAT(reader.cameras_, ElementsAre("colour", "", "thermal"));
  EXPECT_THAT(reader.faults_, ElementsAre("stalled", "", ""));
  EXPECT_THAT(reader.triggers_, ElementsAre(7, 0, 0));
}

TEST(LogWriterTest, WithoutAReaderNobodyWaitsAndWhatIsDroppedIsCounted) {
  constexpr std::size_t kTooMany = 10;
  Reader reader;
  reader.stop_reading();
  LogWriter log(reader.output());
  log_soon(LogLevel::Info, {"under way"});
  reader.await_line();
  for (std::size_t i = 0; i < LogWriter::kMaxWaiting + kTooMany; ++i) {
    log_soon(LogLevel::Info, {"line ", std::to_string(i)});
  }
  reader.go_on();
  log.flush();
  const auto lines = reader.lines();
  ASSERT_THAT(lines, SizeIs(1 + LogWriter::kMaxWaiting + 1));
  for (std::size_t i = 0; i < LogWriter::kMaxWaiting; ++i) {
    EXPECT_EQ(lines[1 + i], "line " + std::to_string(i)) << "the oldest are kept";
  }
  EXPECT_EQ(lines.back(), "10 lines were dropped: the log was not read in time");

  log_soon(LogLevel::Info, {"later"});
  log.flush();
  EXPECT_EQ(reader.lines().back(), "later") << "said once";
}

TEST(LogWriterTest, AReaderThatDoesNotReadHoldsALineUpOnce) {
  Reader reader;
  LogWriter log(reader.output());
  reader.stop_reading();
  const std::string longest(2 * LogWriter::kMaxText, 'x');
  log_line(LogLevel::Info, longest);
  const auto began = std::chrono::steady_clock::now();
  log_line(LogLevel::Info, "second");
  log_line(LogLevel::Info, "third");
  EXPECT_LT(std::chrono::steady_clock::now() - began, LogWriter::kLongestWait)
      << "it is known to be stalled";
  EXPECT_FALSE(log.flush(std::chrono::milliseconds(1)));
  reader.go_on();
  EXPECT_TRUE(log.flush());
  EXPECT_THAT(reader.lines(), ElementsAre(longest, "second", "third"));
  log_line(LogLevel::Info, "fourth");
  EXPECT_EQ(reader.lines().back(), "fourth") << "it is waited for again";
}

TEST(LogWriterTest, CutsALineThatIsTooLong) {
  Reader reader;
  LogWriter log(reader.output());
  const std::string most(LogWriter::kMaxText, 'm');
  log_soon(LogLevel::Info, {most});
  log_soon(LogLevel::Info, {most, "more"});
  log.flush();
  EXPECT_THAT(reader.lines(), ElementsAre(most, most));
}

TEST(LogWriterTest, WritesWhatWaitsAtItsEnd) {
  Reader reader;
  {
    LogWriter log(reader.output());
    reader.stop_reading();
    log_soon(LogLevel::Info, {"under way"});
    reader.await_line();
    log_soon(LogLevel::Info, {"last"});
    reader.go_on();
  }
  EXPECT_THAT(reader.lines(), ElementsAre("under way", "last"));
  EXPECT_EQ(LogWriter::current(), nullptr);
}

TEST(LogWriterTest, WithoutOneTheLogIsTextOnStderr) {
  testing::internal::CaptureStderr();
  log_soon(LogLevel::Warning, {"a", "b"}, {.camera = "colour"});
  log_line(LogLevel::Info, "c");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "orbwatch: ab\norbwatch: c\n");
}

}  // namespace
}  // namespace orbwatch::app
