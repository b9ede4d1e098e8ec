// SPDX-License-Identifier: Apache-2.0
#include "app/service/journal.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <string>

#include "app/log.h"
#include "tests/support/journal_socket.h"

namespace orbwatch::app {
namespace {

using tests::JournalSocket;

/// Stderr of a service: connected to the journal, as the environment states. Text written to it is
/// kept.
class ServiceStderr {
 public:
  ServiceStderr() {
    testing::internal::CaptureStderr();
    struct stat file {};
    EXPECT_EQ(::fstat(STDERR_FILENO, &file), 0);
    ::setenv("JOURNAL_STREAM", tests::journal_stream_of(file).c_str(), 1);
  }
  ServiceStderr(const ServiceStderr&) = delete;
  ServiceStderr& operator=(const ServiceStderr&) = delete;
  ~ServiceStderr() {
    ::unsetenv("JOURNAL_STREAM");
    if (!is_read_) testing::internal::GetCapturedStderr();
  }

  std::string text() {
    is_read_ = true;
    return testing::internal::GetCapturedStderr();
  }

 private:
  bool is_read_ = false;
};

const LogRecord kRecord{LogLevel::Warning,
                        "colour: no frames",
                        {.camera = "colour", .fault = "stalled", .trigger = 12}};

TEST(Journal, HasFieldsOfALine) {
  ORBWATCH_WITHOUT_A_JOURNAL([] {
    const JournalSocket journal;
    ServiceStderr service;
    log_output()(kRecord);
    const auto sent = journal.next_sent();
    ASSERT_TRUE(sent);
    const JournalSocket::Entry wanted{{"MESSAGE", "colour: no frames"},
                                      {"PRIORITY", "4"},
                                      {"SYSLOG_IDENTIFIER", program_invocation_short_name},
                                      {"ORBWATCH_CAMERA", "colour"},
                                      {"ORBWATCH_FAULT", "stalled"},
                                      {"ORBWATCH_TRIGGER", "12"}};
    EXPECT_EQ(JournalSocket::fields(*sent), wanted);
    EXPECT_EQ(service.text(), "") << "not twice";
  });
}

TEST(Journal, HasNoFieldThatALineIsNotAbout) {
  ORBWATCH_WITHOUT_A_JOURNAL([] {
    const JournalSocket journal;
    ServiceStderr service;
    log_output()({LogLevel::Info, "runs", {}});
    const auto sent = journal.next_sent();
    ASSERT_TRUE(sent);
    EXPECT_EQ(sent->find("ORBWATCH_"), std::string::npos) << *sent;
  });
}

TEST(Journal, LinesOfAValueAreNoFields) {
  ORBWATCH_WITHOUT_A_JOURNAL([] {
    const JournalSocket journal;
    ServiceStderr service;
    log_output()({LogLevel::Error, "site.toml:1: no\nPRIORITY=0\n", {.camera = "a\nb=c"}});
    const auto sent = journal.next_sent();
    ASSERT_TRUE(sent);
    JournalSocket::Entry entry = JournalSocket::fields(*sent);
    EXPECT_EQ(entry["MESSAGE"], "site.toml:1: no\nPRIORITY=0\n");
    EXPECT_EQ(entry["PRIORITY"], "3");
    EXPECT_EQ(entry["ORBWATCH_CAMERA"], "a\nb=c");
    EXPECT_EQ(entry.size(), 4u) << *sent;
  });
}

TEST(Journal, ThatIsNotThereGetsTextWithTheLevel) {
  ORBWATCH_WITHOUT_A_JOURNAL([] {
    ServiceStderr service;
    log_output()(kRecord);
    EXPECT_EQ(service.text(), "<4>orbwatch: colour: no frames\n");
  });
}

TEST(Journal, ThatEndedGetsTextWithTheLevel) {
  ORBWATCH_WITHOUT_A_JOURNAL([] {
    { const JournalSocket journal; }  // its file remains
    ServiceStderr service;
    log_output()(kRecord);
    EXPECT_EQ(service.text(), "<4>orbwatch: colour: no frames\n");
  });
}

/// Situation under `systemd-run --pty` and in shells started by a service: the variable is
/// inherited, stderr is another.
TEST(Journal, IsNotUsedWhenStderrIsAnother) {
  ORBWATCH_WITHOUT_A_JOURNAL([] {
    const JournalSocket journal;
    ServiceStderr service;
    ::setenv("JOURNAL_STREAM", "1:2", 1);
    log_output()(kRecord);
    EXPECT_EQ(service.text(), "orbwatch: colour: no frames\n");
  });
}

}  // namespace
}  // namespace orbwatch::app
