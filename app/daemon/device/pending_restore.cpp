// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/device/pending_restore.h"

#include <system_error>

#include "app/daemon/device/cli_program.h"
#include "app/files/runtime/site_file.h"
#include "app/log.h"
#include "app/state/state_folder.h"

namespace orbwatch::app::daemon {

void complete_restore(const std::filesystem::path& config) {
  namespace fs = std::filesystem;
  const auto site = files::read_site(config);
  const auto state = state_folder(site ? site->state_folder : fs::path(), config);
  if (!state) return;  // the start refuses it
  std::error_code none;
  if (!fs::exists(fs::symlink_status(*state / kPendingRestore, none))) return;
  const auto done = run_cli(config, {.arguments = {"restore", "--pending"}});
  if (done) {
    log_line(LogLevel::Info, "the files of a restore or factory reset are in place");
  } else {
    log_line(LogLevel::Error, "a restore or factory reset failed: " + done.error().message);
  }
}

}  // namespace orbwatch::app::daemon
