// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/transport.h"

#include <fcntl.h>
#include <modbus.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "app/ports/modbus/server/rtu_framer.h"

namespace orbwatch::app::modbus {
namespace {

constexpr std::size_t kTcpUnit = 6;  // after transaction, protocol and length

bool is_broadcast(std::span<const std::uint8_t> request) {
  return request[0] == RtuFramer::kBroadcast;
}

char letter_of(Parity parity) {
  constexpr std::array kLetters{'N', 'E', 'O'};
  return kLetters[static_cast<std::size_t>(parity)];
}

Result<> check(const ModbusSerialSettings& settings) {
  const auto refused = [](const std::string& what) { return fail("modbus.serial: " + what); };
  if (settings.device.empty()) return refused("device is not set; set one such as /dev/ttyUSB0");
  if (std::ranges::find(kBaudRates, settings.baud_rate) == kBaudRates.end()) {
    return refused("baud_rate " + std::to_string(settings.baud_rate) +
                   " must be one of 1200, 2400, ... 921600");
  }
  if (settings.stop_bits < 1 || settings.stop_bits > 2) return refused("stop_bits must be 1 or 2");
  if (settings.unit_id < 1 || settings.unit_id > 247) return refused("unit_id must be 1 to 247");
  return {};
}

}  // namespace

Transport::Transport(Context context, std::size_t checksum)
    : context_(std::move(context)),
      header_(static_cast<std::size_t>(modbus_get_header_length(context_.get()))),
      checksum_(checksum) {}

Result<Transport::Context> Transport::prepared(_modbus* context) {
  Context owned(context, modbus_free);
  // libmodbus sleeps for its response timeout before some exceptions.
  if (!owned || modbus_set_response_timeout(owned.get(), 0, 1) != 0) {
    return fail("modbus: libmodbus cannot create a context: " +
                std::string(modbus_strerror(errno)));
  }
  return owned;
}

bool Transport::reply(std::span<const std::uint8_t> request, _modbus_mapping_t& mapping) {
  const bool is_written =
      modbus_reply(context_.get(), request.data(), static_cast<int>(request.size()), &mapping) >= 0;
  return deliver() && is_written;
}

bool Transport::refuse(std::span<const std::uint8_t> request, Exception exception) {
  const bool is_written = modbus_reply_exception(context_.get(), request.data(),
                                                 static_cast<unsigned int>(exception)) >= 0;
  return deliver() && is_written;
}

Result<std::unique_ptr<TcpTransport>> TcpTransport::create(std::vector<int> unit_ids) {
  // The address is unused: it never connects, each request sets its client's socket.
  auto context = prepared(modbus_new_tcp("127.0.0.1", MODBUS_TCP_DEFAULT_PORT));
  if (!context) return tl::unexpected(context.error());
  return std::unique_ptr<TcpTransport>(new TcpTransport(std::move(*context), std::move(unit_ids)));
}

void TcpTransport::use(int socket) { modbus_set_socket(context_.get(), socket); }

bool TcpTransport::is_ours(std::span<const std::uint8_t> request) const {
  return std::ranges::find(unit_ids_, request[kTcpUnit]) != unit_ids_.end();
}

bool TcpTransport::send(std::span<const std::uint8_t> request, std::span<const std::uint8_t> pdu) {
  std::vector<std::uint8_t> answer(request.begin(), request.end() - std::ssize(pdu_of(request)));
  const std::size_t length = pdu.size() + 1;  // including the unit
  answer[4] = static_cast<std::uint8_t>(length >> 8);
  answer[5] = static_cast<std::uint8_t>(length);
  answer.insert(answer.end(), pdu.begin(), pdu.end());
  const ssize_t sent =
      ::send(modbus_get_socket(context_.get()), answer.data(), answer.size(), MSG_NOSIGNAL);
  return sent == std::ssize(answer);
}

Result<std::unique_ptr<RtuTransport>> RtuTransport::create(const ModbusSerialSettings& settings) {
  if (auto checked = check(settings); !checked) return tl::unexpected(checked.error());
  auto context = prepared(modbus_new_rtu(settings.device.c_str(), settings.baud_rate,
                                         letter_of(settings.parity), 8, settings.stop_bits));
  if (!context) return tl::unexpected(context.error());
  std::unique_ptr<RtuTransport> made(new RtuTransport(std::move(*context), settings.device));
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_NONBLOCK | O_CLOEXEC) != 0) {
    return fail("modbus: cannot create a pipe for answers: " +
                std::system_category().message(errno));
  }
  made->encoded_ = hal::FileDescriptor(ends[0]);
  made->encoder_ = hal::FileDescriptor(ends[1]);
  return made;
}

RtuTransport::~RtuTransport() { close(); }

Result<> RtuTransport::open() {
  if (modbus_connect(context_.get()) != 0) {
    return fail("modbus: cannot open the serial line " + device_ + ": " + modbus_strerror(errno) +
                "; check cable and device");
  }
  line_ = modbus_get_socket(context_.get());
  modbus_set_socket(context_.get(), encoder_.get());
  return {};
}

/// Closes the line; libmodbus restores its settings.
void RtuTransport::close() {
  if (line_ < 0) return;
  modbus_set_socket(context_.get(), std::exchange(line_, -1));
  modbus_close(context_.get());
}

bool RtuTransport::deliver() {
  std::array<std::uint8_t, RtuFramer::kLongestFrame> answer;
  const ssize_t size = ::read(encoded_.get(), answer.data(), answer.size());
  if (size <= 0) return false;
  const ssize_t written = ::write(line_, answer.data(), static_cast<std::size_t>(size));
  if (written > 0) sent_.assign(answer.data(), answer.data() + written);
  return written == size;
}

bool RtuTransport::refuse(std::span<const std::uint8_t> request, Exception exception) {
  return is_broadcast(request) || Transport::refuse(request, exception);
}

bool RtuTransport::send(std::span<const std::uint8_t> request, std::span<const std::uint8_t> pdu) {
  if (is_broadcast(request)) return true;
  std::vector<std::uint8_t> answer{request[0]};
  answer.insert(answer.end(), pdu.begin(), pdu.end());
  // A "raw request" is sent with only the checksum appended, which also suits answers.
  const bool is_written =
      modbus_send_raw_request(context_.get(), answer.data(), static_cast<int>(answer.size())) >= 0;
  return deliver() && is_written;
}

}  // namespace orbwatch::app::modbus
