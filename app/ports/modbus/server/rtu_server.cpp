#include "app/ports/modbus/server/rtu_server.h"

#include <poll.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "hal/back_off.h"

namespace orbwatch::app::modbus {

Result<std::unique_ptr<RtuServer>> RtuServer::open(const ModbusSerialSettings& settings,
                                                   Answer answer, OnLine on_line,
                                                   ServerCounters& counters) {
  auto transport = RtuTransport::create(settings);
  if (!transport) return tl::unexpected(transport.error());
  std::unique_ptr<RtuServer> server(new RtuServer(settings, std::move(*transport),
                                                  std::move(answer), std::move(on_line), counters));
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

/// Until stop(). Errors: the line is lost.
Result<> RtuServer::serve_line() {
  RtuFramer framer(settings_.unit_id, rtu_pause(settings_.baud_rate));
  std::array<std::uint8_t, RtuFramer::kLongestFrame> bytes;
  hal::TimePoint last;
  for (;;) {
    std::array<pollfd, 2> files{{{transport_->descriptor(), POLLIN, 0}, {stop_.get(), POLLIN, 0}}};
    if (::poll(files.data(), files.size(), -1) < 0) continue;  // interrupted
    if (files[1].revents != 0) return {};
    const ssize_t count = ::read(files[0].fd, bytes.data(), bytes.size());
    const bool has_nothing = count < 0 && (errno == EAGAIN || errno == EINTR);
    if (has_nothing && (files[0].revents & (POLLHUP | POLLERR)) == 0) continue;
    if (count <= 0) {
      return fail("modbus: the serial line " + settings_.device +
                  " is lost: " + (count == 0 ? "hung up" : std::system_category().message(errno)) +
                  "; it is opened again");
    }
    const auto now = hal::Clock::now();
    framer.push(std::span(bytes).first(static_cast<std::size_t>(count)), now - last);
    last = now;
    answer_frames(framer);
  }
}

void RtuServer::answer_frames(RtuFramer& framer) {
  const std::uint64_t errors = framer.errors();
  const std::uint64_t other_units = framer.other_units();
  while (const auto frame = framer.next()) {
    // Until then the master may still be switching its line from sending to receiving.
    if (is_stopped_within(rtu_pause(settings_.baud_rate))) return;
    const Outcome outcome = answer_(*transport_, *frame);
    if (outcome != Outcome::Answered && outcome != Outcome::NotSent) ++counters_.refused;
    if (outcome != Outcome::NotModbus && outcome != Outcome::NotSent) ++counters_.answered;
  }
  counters_.serial_errors += framer.errors() - errors;
  counters_.serial_other_units += framer.other_units() - other_units;
}

}  // namespace orbwatch::app::modbus
