// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/model/configuration/configuration_files.h"
#include "app/model/configuration/device_files.h"
#include "app/model/configuration/device_update.h"

namespace orbwatch::app {

class RecentLog;

/// Parts of the program around an appliance, for interfaces that show them; null: not present.
struct Program {
  std::shared_ptr<ConfigurationFiles> files = nullptr;
  std::shared_ptr<const RecentLog> log = nullptr;
  /// Versions by name: the program's own first, then those of libraries.
  std::vector<std::pair<std::string, std::string>> versions{};
  std::string commanders{};  ///< interfaces that accept commands, in words
  std::shared_ptr<DeviceFiles> device = nullptr;
  std::shared_ptr<DeviceUpdate> update = nullptr;  ///< of a device that runs an image
};

/// Version of the program itself; empty: unknown.
inline std::string version_of(const Program& program) {
  return program.versions.empty() ? "" : program.versions.front().second;
}

}  // namespace orbwatch::app
