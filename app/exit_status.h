// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace orbwatch::app {

/// Exit statuses of `orbwatch` and `orbwatchd`.
enum class ExitStatus { Done = 0, Failed = 1, WrongUsage = 2 };

/// Meaning of a status, for help and manual pages.
struct ExitStatusInfo {
  ExitStatus status;
  std::string_view of_orbwatch;
  std::string_view of_orbwatchd;
};

inline constexpr std::array kExitStatuses{
    ExitStatusInfo{ExitStatus::Done,
                   "The command did what was asked; what it found is on standard output.",
                   "A signal ended it, or the files that --check reads are right."},
    ExitStatusInfo{ExitStatus::Failed,
                   "It did not, or what it judges is not good enough; the reason is on standard "
                   "error.",
                   "A file is wrong, or something is missing that it cannot run without."},
    ExitStatusInfo{ExitStatus::WrongUsage, "The options or arguments are wrong; nothing was done.",
                   "The options or arguments are wrong; nothing was done."},
};

}  // namespace orbwatch::app
