// SPDX-License-Identifier: Apache-2.0
/// killed_appliance FOLDER JOURNAL: a Modbus server with its record of commands in FOLDER. Prints
/// its port. Appends the first argument of each command that it executes to JOURNAL. Ends by
/// SIGTERM, unless killed before.
#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>
#include <thread>

#include "app/ports/modbus/modbus_sink.h"

namespace {

using namespace orbwatch::app;

/// Duration of a command that moves something.
constexpr std::chrono::milliseconds kWork{1};

CommandResult note(int journal, const Command& command) {
  const std::string line = std::to_string(command.integer(0)) + "\n";
  const bool is_noted =
      ::write(journal, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  std::this_thread::sleep_for(kWork);
  return is_noted ? CommandResult::Done : CommandResult::NotPossible;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  sigset_t end;
  sigemptyset(&end);
  sigaddset(&end, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &end, nullptr);
  const int journal = ::open(argv[2], O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  ModbusSettings settings;
  settings.address = "127.0.0.1";
  settings.port = 0;
  ModbusSink sink(
      settings, [journal](const Command& command) { return note(journal, command); },
      std::make_shared<CommandRecord>(argv[1]));
  if (journal < 0 || !sink.start()) return 1;
  std::printf("%d\n", sink.port());
  std::fflush(stdout);
  int signal = 0;
  sigwait(&end, &signal);
  sink.stop();
  return 0;
}
