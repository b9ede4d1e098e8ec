// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/rtu_server.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "app/ports/modbus/server/echo_filter.h"
#include "app/ports/modbus/server/rtu_framer.h"
#include "hal/back_off.h"

namespace orbwatch::app::modbus {

Result<std::unique_ptr<RtuServer>> RtuServer::open(const ModbusSerialSettings& settings,
                                                   Answer answer, OnLine on_line,
                                                   ServerCounters& counters, OnEcho on_echo) {
  auto transport = RtuTransport::create(settings);
  if (!transport) return tl::unexpected(transport.error());
  std::unique_ptr<RtuServer> server(new RtuServer(settings, std::move(*transport),
                                                  std::move(answer), std::move(on_line), counters,
                                                  std::move(on_echo)));
  if (!server->stop_.is_open()) {
    return fail("modbus: cannot watch the serial line: " + std::system_category().message(errno));
  }
  return server;
}

void RtuServer::run() {
  hal::BackOff pause;
  for (bool is_lost = false;; is_lost = true) {
    Result<> line = transport_->open();
    if (line) {
      if (is_lost) on_line_(line);
      is_lost = false;
      pause.reset();
      line = serve_line();
      transport_->close();
      if (line) return;
    }
    if (!is_lost) on_line_(line);
    if (is_stopped_within(pause.next())) return;
  }
}

bool RtuServer::is_stopped_within(hal::Clock::duration time) const {
  pollfd stop{stop_.get(), POLLIN, 0};
  const auto wait = std::chrono::ceil<std::chrono::milliseconds>(time);
  return ::poll(&stop, 1, static_cast<int>(wait.count())) > 0;
}

/// State of reception on an open line.
struct RtuServer::Reception {
  RtuFramer framer;
  EchoFilter echoes;
  hal::TimePoint last{};     ///< arrival of the newest bytes
  std::uint64_t errors = 0;  ///< errors counted so far
  std::uint64_t other_units = 0;
  std::uint64_t dropped_echoes = 0;

  /// Time at which waiting bytes and expected echoes are given up.
  hal::TimePoint deadline() const {
    const auto end = framer.is_waiting() ? last + RtuFramer::kMaxGap : hal::TimePoint::max();
    return echoes.is_waiting() ? std::min(end, echoes.deadline()) : end;
  }
};

/// Serves the line until stop(). Errors: the line is lost.
Result<> RtuServer::serve_line() {
  Reception line{.framer{settings_.unit_id, rtu_pause(settings_.baud_rate)},
                 .echoes{EchoFilter(settings_.baud_rate)}};
  std::array<std::uint8_t, RtuFramer::kLongestFrame> bytes;
  for (;;) {
    std::array<pollfd, 2> files{{{transport_->descriptor(), POLLIN, 0}, {stop_.get(), POLLIN, 0}}};
    const auto begin = hal::Clock::now();
    const int ready = ::poll(files.data(), files.size(), hal::poll_timeout(line.deadline()));
    if (ready < 0) continue;  // interrupted
    if (ready == 0) {
      receive(line, {}, hal::Clock::now());
      continue;
    }
    if (files[1].revents != 0) return {};
    const ssize_t count = ::read(files[0].fd, bytes.data(), bytes.size());
    const bool has_nothing = count < 0 && (errno == EAGAIN || errno == EINTR);
    if (has_nothing && (files[0].revents & (POLLHUP | POLLERR)) == 0) continue;
    if (count <= 0) {
      return fail("modbus: the serial line " + settings_.device +
                  " is lost: " + (count == 0 ? "hung up" : std::system_category().message(errno)) +
                  "; reopening it");
    }
    receive(line, std::span(bytes).first(static_cast<std::size_t>(count)), begin);
  }
}

/// Receives bytes, none of which had arrived at `silent_until`.
void RtuServer::receive(Reception& line, std::span<const std::uint8_t> bytes,
                        hal::TimePoint silent_until) {
  const auto now = hal::Clock::now();
  auto silence = now - line.last;
  if (!bytes.empty()) line.last = now;
  bool is_newest = true;  // earlier answers have no echo after another request
  const auto is_answered = [&] {
    while (const auto frame = line.framer.next()) {
      if (std::exchange(is_newest, false)) line.echoes.end_wait();
      if (!answer_frame(line.echoes, *frame)) return false;
    }
    return true;
  };
  auto received = line.echoes.strip(bytes, silent_until);
  while (!received.empty()) {
    const auto part = received.first(std::min(received.size(), RtuFramer::kLongestFrame));
    line.framer.push(part, std::exchange(silence, hal::Clock::duration(0)));
    received = received.subspan(part.size());
    if (!is_answered()) return;
  }
  if (bytes.empty() && now - line.last >= RtuFramer::kMaxGap) {
    line.framer.end();
    if (!is_answered()) return;
  }
  count(line);
}

/// Answers a frame. False: stopped.
bool RtuServer::answer_frame(EchoFilter& echoes, std::span<const std::uint8_t> frame) {
  // Waits, because the master may still be switching from sending to receiving.
  if (is_stopped_within(rtu_pause(settings_.baud_rate))) return false;
  const Outcome outcome = answer_(*transport_, frame);
  const auto sent = transport_->take_sent();
  echoes.expect(sent, std::ranges::equal(sent, frame), hal::Clock::now());
  if (outcome != Outcome::Answered && outcome != Outcome::NotSent) ++counters_.refused;
  if (outcome != Outcome::NotModbus && outcome != Outcome::NotSent) ++counters_.answered;
  return true;
}

void RtuServer::count(Reception& line) {
  const auto add = [](std::atomic<std::uint64_t>& counter, std::uint64_t& counted,
                      std::uint64_t all) { counter += all - std::exchange(counted, all); };
  add(counters_.serial_errors, line.errors, line.framer.errors());
  add(counters_.serial_other_units, line.other_units, line.framer.other_units());
  add(counters_.serial_echoes, line.dropped_echoes, line.echoes.echoes());
  const bool has_echo = line.dropped_echoes > 0;
  if (const auto report = has_echo ? std::exchange(on_echo_, {}) : OnEcho()) report();
}

}  // namespace orbwatch::app::modbus
