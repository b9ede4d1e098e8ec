#include "app/modbus/rtu_server.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

#include "hal/back_off.h"

namespace orbwatch::app::modbus {

Result<std::unique_ptr<RtuServer>> RtuServer::open(const ModbusSerialSettings& settings,
                                                   Answer answer, OnLine on_line,
                                                   Counters& counters) {
  auto transport = RtuTransport::create(settings);
  if (!transport) return tl::unexpected(transport.error());
  std::unique_ptr<RtuServer> server(new RtuServer(settings, std::move(*transport),
                                                  std::move(answer), std::move(on_line), counters));
  server->stop_ = hal::FileDescriptor(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
  if (!server->stop_.is_open()) {
    return fail("modbus: cannot watch the serial line: " + std::system_category().message(errno));
  }
  return server;
}

void RtuServer::stop() {
  // Fails only when the count is full, and then run() has been told often enough.
  [[maybe_unused]] const int told = ::eventfd_write(stop_.get(), 1);
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

/// Until stop(), or the line is lost, which is the error.
Result<> RtuServer::serve_line() {
  RtuFramer framer(settings_.unit_id, rtu_pause(settings_.baud_rate));
  std::array<std::uint8_t, RtuFramer::kLongestFrame> bytes;
  hal::TimePoint last;
  for (;;) {
    std::array<pollfd, 2> files{{{transport_->descriptor(), POLLIN, 0}, {stop_.get(), POLLIN, 0}}};
    if (::poll(files.data(), files.size(), -1) < 0) continue;  // by a signal
    if (files[1].revents != 0) return {};
    const ssize_t count = ::read(files[0].fd, bytes.data(), bytes.size());
    const bool has_nothing = count < 0 && (errno == EAGAIN || errno == EINTR);
    if (has_nothing && (files[0].revents & (POLLHUP | POLLERR)) == 0) continue;
    if (count <= 0) {
      return fail("modbus: the serial line " + settings_.device +
                  " is lost: " + (count == 0 ? "hung up" : std::system_category().message(errno)) +
                  "; it is tried again");
    }
    const auto now = hal::Clock::now();
    framer.push(std::span(bytes).first(static_cast<std::size_t>(count)), now - last);
    last = now;
    answer_frames(framer);
  }
}

void RtuServer::answer_frames(RtuFramer& framer) {
  const std::uint64_t broken = framer.broken();
  const std::uint64_t for_others = framer.for_others();
  while (const auto frame = framer.next()) {
    // Until then the master may still be switching its line from sending to receiving.
    if (is_stopped_within(rtu_pause(settings_.baud_rate))) return;
    const Answered answered = answer_(*transport_, *frame);
    if (answered == Answered::NotModbus || answered == Answered::Refused) ++counters_.refused;
    if (answered == Answered::Done || answered == Answered::Refused) ++counters_.answered;
  }
  counters_.broken += framer.broken() - broken;
  counters_.for_others += framer.for_others() - for_others;
}

}  // namespace orbwatch::app::modbus
