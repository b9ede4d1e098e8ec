// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/process/run_records.h"

#include <filesystem>
#include <set>
#include <system_error>
#include <vector>

#include "app/daemon/configuration/configuration_choice.h"
#include "app/files/runtime/driven_lines.h"
#include "app/log.h"
#include "app/state/state_folder.h"
#include "hal/atomic_file.h"

namespace orbwatch::app::daemon {

namespace fs = std::filesystem;

void remove_leftovers(const files::Resolved& site) {
  std::set<fs::path> folders{site.state_folder};
  if (const auto service = service_folder()) folders.insert(*service);
  for (const auto& [file, text] : site.texts) folders.insert(file.parent_path());
  for (const fs::path& folder : folders) {
    std::error_code none;  // remove_unfinished() says what is wrong
    if (!fs::exists(folder, none) && !none) continue;
    if (const auto removed = hal::remove_unfinished(folder); !removed) {
      log_line(LogLevel::Warning, "temporary files stay: " + removed.error().message);
    }
  }
}

void record_outputs(const files::Resolved& site) {
  auto folder = runtime_directory();
  if (!folder) folder = service_folder();
  if (!folder) return;
  const std::vector<LineSettings> lines(site.site.lines.begin(), site.site.lines.end());
  if (const auto recorded = files::record_driven_lines(*folder, lines); !recorded) {
    log_line(LogLevel::Warning,
             "after SIGKILL outputs are set inactive as the files say then, since those that run "
             "are not recorded: " +
                 recorded.error().message);
  }
}

}  // namespace orbwatch::app::daemon
