// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/device/cli_program.h"

#include <string_view>
#include <system_error>
#include <utility>

#include "app/model/plain_text.h"
#include "app/service/child_program.h"

namespace orbwatch::app::daemon {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostOutput = std::size_t{4} << 20;
constexpr std::size_t kLongestMessage = 2000;

/// Beside this program: in its folder, or as installed in bin beside sbin.
Result<fs::path> cli_program() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& program : {folder / "orbwatch", folder.parent_path() / "bin/orbwatch"}) {
    if (!error && fs::is_regular_file(program, error)) return program;
    error.clear();
  }
  return fail("the program orbwatch is not installed beside " + folder.string() + "/orbwatchd");
}

/// The message of a failed call, without the program's name.
std::string message_of(std::string_view errors) {
  constexpr std::string_view kName = "orbwatch: ";
  if (const auto begin = errors.rfind(kName); begin != errors.npos) {
    errors.remove_prefix(begin + kName.size());
  }
  while (errors.ends_with('\n')) errors.remove_suffix(1);
  return plain_text(std::string(errors), kLongestMessage);
}

}  // namespace

Result<std::string> run_cli(const fs::path& config, const CliCall& call) {
  const auto program = cli_program();
  if (!program) return tl::unexpected(program.error());
  ChildCall child{
      .program = *program,
      .arguments = call.arguments,
      // The service manager's variables are for this process alone.
      .environment = environment_without({"NOTIFY_SOCKET", "WATCHDOG_PID", "WATCHDOG_USEC"}),
      .secret = call.secret,
      .time = call.time,
      .bytes = kMostOutput,
      .cancelled = call.cancelled};
  child.arguments.insert(child.arguments.end(), {"--config", config.string()});
  auto end = run_child(child);
  if (!end) return tl::unexpected(end.error());
  if (end->status != 0) return fail(message_of(end->errors));
  return std::move(end->output);
}

}  // namespace orbwatch::app::daemon
