// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/process/supervision.h"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "app/log.h"
#include "app/service/service_manager.h"

namespace orbwatch::app::daemon {
namespace {

/// Between two turns at most, and a fourth of the watchdog's period.
constexpr std::chrono::nanoseconds kLongestTurn = std::chrono::seconds(1);
constexpr int kTurnsInPeriod = 4;

/// Time for the RestartWatch to see that a trial was confirmed in its last second.
constexpr std::chrono::seconds kLongestLook{1};

}  // namespace

sigset_t block_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

Supervision::Supervision(const sigset_t& signals, const std::filesystem::path& file,
                         std::shared_ptr<const RecentLog> log)
    : watchdog_(watchdog_period()),
      signals_(::signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC)),
      turned_(hal::Clock::now()),
      restarts_(file, {[this] {
                         is_restart_decided_ = true;
                         woken_.signal();
                       },
                       [this] { appliance_.report_refusal(); }}),
      appliance_(
          {file, std::move(log), restarts_, [this] { return is_supervised(); },
           [this] { woken_.signal(); },
           [this](const std::string& line, bool power_off) { stop_by_line(line, power_off); },
           [this] { restart_device(); }}) {}

Result<Supervision::End> Supervision::run() {
  if (!signals_.is_open() || !woken_.is_open()) {
    return fail(std::string("cannot wait for signals: ") + std::strerror(errno));
  }
  restarts_.start();
  appliance_.start();
  const auto turn =
      watchdog_.count() > 0 ? std::min(kLongestTurn, watchdog_ / kTurnsInPeriod) : kLongestTurn;
  while (true) {
    turned_ = hal::Clock::now();
    std::array<pollfd, 2> polled{{{signals_.get(), POLLIN, 0}, {woken_.get(), POLLIN, 0}}};
    ::poll(polled.data(), polled.size(), hal::poll_timeout(hal::Clock::now() + turn));
    woken_.clear();
    if (const int signal = signal_that_ends(); signal != 0) {
      log_soon(LogLevel::Info, {"ended by signal ", std::to_string(signal)});
      return End::Stop;
    }
    if (device_end_ != End::Stop) return device_end_;
    if (appliance_.has_ended()) return End::Stop;
    if (is_restart_decided_) return End::Restart;
    if (is_trial_over()) {
      log_soon(LogLevel::Warning, {"restarts for another configuration: the trial's time is over, "
                                   "and its files do not answer"});
      return End::Restart;
    }
  }
}

/// On the thread of the lines.
void Supervision::stop_by_line(const std::string& line, bool power_off) {
  log_soon(LogLevel::Warning,
           {"line ", line, " asks for a stop", power_off ? " and power-off" : ""});
  device_end_ = power_off ? End::PowerOff : End::StopLine;
  woken_.signal();
}

/// On the thread of an interface.
void Supervision::restart_device() {
  log_soon(LogLevel::Info, {"restarts the computer for an update"});
  device_end_ = End::RestartDevice;
  woken_.signal();
}

/// 0: none; those to start again are forwarded.
int Supervision::signal_that_ends() {
  int ends = 0;
  signalfd_siginfo received{};
  while (::read(signals_.get(), &received, sizeof received) == sizeof received) {
    const int signal = static_cast<int>(received.ssi_signo);
    if (signal == SIGHUP) {
      restarts_.ask();
    } else {
      ends = signal;
    }
  }
  return ends;
}

bool Supervision::is_supervised() const {
  return watchdog_.count() == 0 || hal::Clock::now() - turned_.load() < watchdog_;
}

bool Supervision::is_trial_over() const {
  const hal::TimePoint end = restarts_.trial_end();
  return end != hal::TimePoint::max() && hal::Clock::now() > end + kLongestLook;
}

bool Supervision::finish(End end) {
  const bool restarts = end == End::Restart;
  const bool is_of_service = end == End::Stop || restarts;
  const auto longest = is_of_service ? kLongestEnd : kLongestEndByLine;
  const auto deadline = hal::Clock::now() + longest;
  bool is_orderly = appliance_.end(restarts, longest);
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - hal::Clock::now());
  is_orderly = restarts_.end(std::max(left, std::chrono::milliseconds(0))) && is_orderly;
  if (is_orderly) return true;
  log_soon(LogLevel::Warning,
           {"ends without waiting for what hangs or still starts: a driver, the disk, "
            "the log"});
  if (!appliance_.has_ended() && !appliance_.abandon(restarts, kLongestAbandonment)) {
    log_soon(LogLevel::Error, {"the outputs hang, too: they may be active"});
  }
  return false;
}

}  // namespace orbwatch::app::daemon
