// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace orbwatch::app {

/// Exit statuses of `orbwatch` and `orbwatchd`.
enum class ExitStatus {
  Done = 0,
  Failed = 1,
  WrongUsage = 2,
  StopLine = 3,
  PowerOff = 4,
  RestartDevice = 5
};

/// Meaning of a status, for help and manual pages. Empty: the program does not have it.
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
    ExitStatusInfo{ExitStatus::StopLine, "",
                   "A line of use stop asked for it; the service is not started again."},
    ExitStatusInfo{ExitStatus::PowerOff, "",
                   "As 3, and the line has power_off: the service powers the machine off."},
    ExitStatusInfo{ExitStatus::RestartDevice, "",
                   "The page asked for a restart that tries an installed update; the service of an "
                   "image restarts the computer."},
};

}  // namespace orbwatch::app
