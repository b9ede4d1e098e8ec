#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace orbwatch::app {

/// Whether a service manager started this process and reads its messages (NOTIFY_SOCKET).
bool has_service_manager();

/// How long it waits for a message of the watchdog before it ends the process; 0: it does not.
std::chrono::microseconds watchdog_period();

/// Sends assignments of sd_notify(3), one per line. Nothing happens without a service manager; one
/// that does not read is logged once. May wait for it: never on the frame path. Thread-safe.
void notify(const std::string& assignments);

/// READY=1, with the watchdog's period as it was before notify_restart(). `status` is for people.
std::string ready_message(std::string_view status);

/// The files are read again and all is built anew, which may take as long as the first start.
void notify_restart();

/// The end begins.
void notify_end();

}  // namespace orbwatch::app
