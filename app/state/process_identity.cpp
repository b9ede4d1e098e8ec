// SPDX-License-Identifier: Apache-2.0
#include "app/state/process_identity.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "hal/boot_id.h"

namespace orbwatch::app {
namespace {

/// Field of proc_pid_stat(5): the name in brackets may contain any character, so fields are counted
/// after it.
std::uint64_t start_time() {
  constexpr int kStart = 22, kFirstBehindName = 3;
  std::ifstream file("/proc/self/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t name_end = text.rfind(')');
  if (name_end == text.npos) return 0;
  std::istringstream fields(text.substr(name_end + 1));
  std::string field;
  for (int number = kFirstBehindName; number < kStart; ++number) fields >> field;
  std::uint64_t start = 0;
  return fields >> start ? start : 0;
}

}  // namespace

ProcessIdentity this_process() {
  ProcessIdentity identity{.id = static_cast<std::uint32_t>(::getpid()), .start = start_time()};
  const std::string boot = hal::boot_id();
  if (boot.size() < identity.boot.size() || identity.start == 0) return {};
  std::copy_n(boot.begin(), identity.boot.size(), identity.boot.begin());
  return identity;
}

}  // namespace orbwatch::app
