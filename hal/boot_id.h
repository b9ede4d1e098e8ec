// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "hal/regular_file.h"

namespace orbwatch::hal {

/// UUID of the kernel's run since power-on or reboot; empty if the kernel reports none. The same in
/// all processes, so that times of Clock in a file are compared within one boot only. `root`:
/// folder with /proc; another one in tests. Reentrant.
inline std::string boot_id(const std::filesystem::path& root = "/") {
  auto id = read_regular_file(root / "proc/sys/kernel/random/boot_id").value_or("");
  return id.substr(0, id.find('\n'));
}

}  // namespace orbwatch::hal
