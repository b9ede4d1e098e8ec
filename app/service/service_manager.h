// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace orbwatch::app {

/// True if a service manager started this process and reads its messages (NOTIFY_SOCKET).
bool has_service_manager();

/// Time without a watchdog message after which the service manager ends the process; 0: it does
/// not.
std::chrono::microseconds watchdog_period();

/// Sends assignments of sd_notify(3), one per line. Does nothing without a service manager; one
/// that does not read is logged once. May wait for it: never on the frame path. Thread-safe.
void notify(const std::string& assignments);

/// Message READY=1, with the watchdog's period from before notify_restart(). `status` is for
/// people.
std::string ready_message(std::string_view status);

/// Announces that the files are read again and everything is rebuilt, which may take as long as the
/// first start.
void notify_restart();

/// Announces that the process ends.
void notify_end();

}  // namespace orbwatch::app
