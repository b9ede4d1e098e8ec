#include "app/ports/modbus/server/transport.h"

#include <modbus.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <utility>

namespace orbwatch::app::modbus {
namespace {

constexpr std::size_t kUnit = 6;  // behind transaction, protocol and length

}  // namespace

void Transport::Free::operator()(_modbus* context) const { modbus_free(context); }

Transport::Transport(Context context, std::size_t checksum)
    : context_(std::move(context)),
      header_(static_cast<std::size_t>(modbus_get_header_length(context_.get()))),
      checksum_(checksum) {}

Result<Transport::Context> Transport::prepared(_modbus* context) {
  Context owned(context);
  // libmodbus sleeps for its response timeout before some exceptions.
  if (!owned || modbus_set_response_timeout(owned.get(), 0, 1) != 0) {
    return fail("modbus: libmodbus gives no context: " + std::string(modbus_strerror(errno)));
  }
  return owned;
}

bool Transport::reply(std::span<const std::uint8_t> request, _modbus_mapping_t& mapping) {
  return modbus_reply(context_.get(), request.data(), static_cast<int>(request.size()), &mapping) >=
         0;
}

bool Transport::refuse(std::span<const std::uint8_t> request, Exception exception) {
  return modbus_reply_exception(context_.get(), request.data(),
                                static_cast<unsigned int>(exception)) >= 0;
}

Result<std::unique_ptr<TcpTransport>> TcpTransport::create(std::vector<int> unit_ids) {
  // The address is unused: it never connects, each request sets its client's socket.
  auto context = prepared(modbus_new_tcp("127.0.0.1", MODBUS_TCP_DEFAULT_PORT));
  if (!context) return tl::unexpected(context.error());
  return std::unique_ptr<TcpTransport>(new TcpTransport(std::move(*context), std::move(unit_ids)));
}

void TcpTransport::use(int socket) { modbus_set_socket(context_.get(), socket); }

bool TcpTransport::is_ours(std::span<const std::uint8_t> request) const {
  return std::ranges::find(unit_ids_, request[kUnit]) != unit_ids_.end();
}

bool TcpTransport::send(std::span<const std::uint8_t> request, std::span<const std::uint8_t> pdu) {
  std::vector<std::uint8_t> answer(request.begin(), request.end() - std::ssize(pdu_of(request)));
  const std::size_t length = pdu.size() + 1;  // with the unit
  answer[4] = static_cast<std::uint8_t>(length >> 8);
  answer[5] = static_cast<std::uint8_t>(length);
  answer.insert(answer.end(), pdu.begin(), pdu.end());
  const ssize_t sent =
      ::send(modbus_get_socket(context_.get()), answer.data(), answer.size(), MSG_NOSIGNAL);
  return sent == std::ssize(answer);
}

}  // namespace orbwatch::app::modbus
