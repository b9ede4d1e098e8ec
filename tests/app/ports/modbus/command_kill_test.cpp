// SPDX-License-Identifier: Apache-2.0
/// A PLC that writes its block in every cycle, and a server that is killed again and again.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <thread>

#include "tests/app/ports/modbus/clients.h"
#include "tests/support/share.h"
#include "tests/support/subprocess.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

using orbwatch::tests::Subprocess;
using tests::kAcknowledged;
using tests::kArguments;
using tests::Plc;
using tests::Words;

/// Every command has a unique argument, by which the journal shows how often it was executed.
class CyclicPlc {
 public:
  /// Cycles until the connection is lost, or a command of at least this argument is acknowledged.
  void run(int port, int last) {
    try {
      Plc plc(port);
      while (argument_ <= last && cycle(plc)) {
      }
    } catch (const std::exception&) {
      // The server was killed before it accepted the connection.
    }
  }

  /// Simulates a restart of the PLC: it forgets its block, and continues by the rules of the
  /// handbook.
  void restart() {
    is_new_ = true;
    ++argument_;
  }

  int argument() const { return argument_; }
  const std::map<int, CommandResult>& results() const { return results_; }

 private:
  bool cycle(Plc& plc) {
    if (is_new_) {
      if (plc.read_holding(kAcknowledged, 1) != 0) return false;
      sequence_ = static_cast<std::uint16_t>(plc.words[0] + 1);
      is_new_ = false;
    }
    const auto view = static_cast<std::uint16_t>(argument_);
    const Words block = tests::select_view(view, sequence_);
    if (plc.write_and_read(kArguments, block, kAcknowledged, 2) != 0) return false;
    if (plc.words[0] == sequence_) {
      results_[argument_++] = static_cast<CommandResult>(plc.words[1]);
      ++sequence_;
    }
    return true;
  }

  std::map<int, CommandResult> results_;  ///< acknowledged results by argument
  int argument_ = 0;
  std::uint16_t sequence_ = 65500;  // wraps soon
  bool is_new_ = false;
};

/// End of a server.
struct End {
  int signal = SIGKILL;
  std::chrono::microseconds after{};  ///< delay after it runs, or was started
  bool is_at_start = false;
};

class CommandKill : public testing::Test {
 protected:
  /// Runs the server to its end, or without an end until the PLC's commands up to `last` are
  /// answered.
  void run(CyclicPlc& plc, const std::optional<End>& end, int last) {
    Subprocess server({ORBWATCH_KILLED_APPLIANCE, folder_ / "state", folder_ / "journal"},
                      folder_ / "output");
    std::jthread killer;
    const auto arm = [&] {
      killer = std::jthread([pid = server.pid(), end] {
        std::this_thread::sleep_for(end->after);  // the moment is the subject of the test
        ::kill(pid, end->signal);
      });
    };
    if (end && end->is_at_start) arm();
    int port = 0;
    while (server.runs() && std::sscanf(server.output().c_str(), "%d\n", &port) != 1) {
      std::this_thread::yield();
    }
    if (end && !end->is_at_start) arm();
    if (port != 0) plc.run(port, last);
    killer = {};
    if (!end) server.send(SIGTERM);
    server.wait();
  }

  std::map<int, int> journal() const {
    std::map<int, int> times;
    std::ifstream in(folder_ / "journal");
    for (int argument = 0; in >> argument;) ++times[argument];
    return times;
  }

  const orbwatch::tests::TemporaryFolder folder_;
};

TEST_F(CommandKill, NoCommandIsCarriedOutTwiceAndEachThatIsDoneWas) {
  constexpr int kNoEnd = 65000;
  std::mt19937 random(20240611);
  CyclicPlc plc;
  const int kills = orbwatch::tests::share_of(1000);
  for (int n = 0; n < kills; ++n) {
    const int signal = random() % 4 == 0 ? SIGTERM : SIGKILL;
    const std::chrono::microseconds after(random() % 50000);
    run(plc, End{signal, after, random() % 8 == 0}, kNoEnd);
    if (random() % 20 == 0) plc.restart();
  }
  run(plc, std::nullopt, plc.argument() + 2);

  const auto times = journal();
  std::map<CommandResult, int> counts;
  for (const auto& [argument, count] : times) EXPECT_EQ(count, 1) << "command " << argument;
  for (const auto& [argument, result] : plc.results()) {
    ++counts[result];
    if (result == CommandResult::Done) {
      EXPECT_TRUE(times.contains(argument)) << "command " << argument;
    }
  }
  const int done = counts[CommandResult::Done], interrupted = counts[CommandResult::Interrupted];
  RecordProperty("done", done);
  RecordProperty("interrupted", interrupted);
  std::printf("%d restarts, %zu commands carried out, %d done, %d interrupted\n", kills,
              times.size(), done, interrupted);
  EXPECT_EQ(done + interrupted, static_cast<int>(plc.results().size())) << "nothing else is said";
  EXPECT_GT(done, kills / 10);
  EXPECT_GT(interrupted, 0) << "no kill hit a command";
}

}  // namespace
}  // namespace orbwatch::app
