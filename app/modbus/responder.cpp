#include "app/modbus/responder.h"

#include <modbus.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "app/modbus/device_identification.h"

namespace orbwatch::app::modbus {
namespace {

constexpr std::size_t kHeader = 7;  // transaction, protocol, length, unit
constexpr std::size_t kUnit = 6;

/// Over TCP the unit only matters behind a gateway: 255 is recommended, 0 accepted (Modbus
/// Messaging on TCP/IP Implementation Guide), and 1 is what most clients send unless told
/// otherwise. Requests for other units were meant for another device.
bool is_ours(std::uint8_t unit) { return unit == 0 || unit == 1 || unit == 255; }

}  // namespace

void Responder::Free::operator()(_modbus* context) const { modbus_free(context); }
void Responder::Free::operator()(_modbus_mapping_t* image) const { modbus_mapping_free(image); }

Result<std::unique_ptr<Responder>> Responder::create(const RegisterMap& map, CommandHandler handler,
                                                     TakeSnapshot take) {
  // The context never connects: each request sets its client's socket, so the address is unused.
  Context context(modbus_new_tcp("127.0.0.1", MODBUS_TCP_DEFAULT_PORT));
  // libmodbus sleeps its response timeout before it answers some requests with an exception.
  if (!context || modbus_set_response_timeout(context.get(), 0, 1) != 0) {
    return fail("modbus: libmodbus gives no context: " + std::string(modbus_strerror(errno)));
  }
  Image image(modbus_mapping_new(map.size(Table::Coil), map.size(Table::Discrete),
                                 map.size(Table::Holding), map.size(Table::Input)));
  if (!image) return fail("modbus: no memory for the registers");
  return std::unique_ptr<Responder>(new Responder(map, std::move(handler), std::move(take),
                                                  std::move(context), std::move(image)));
}

Responder::Responder(const RegisterMap& map, CommandHandler handler, TakeSnapshot take,
                     Context context, Image image)
    : map_(map),
      handler_(std::move(handler)),
      take_(std::move(take)),
      context_(std::move(context)),
      image_(std::move(image)) {}

Answered Responder::answer(int socket, std::span<const std::uint8_t> frame, bool may_write) {
  const auto pdu = frame.subspan(kHeader);
  if (pdu[0] >= 0x80) return Answered::NotModbus;  // marks an answer, not a request
  modbus_set_socket(context_.get(), socket);
  if (!is_ours(frame[kUnit])) return refuse(frame, Exception::GatewayTargetFailed);
  if (pdu[0] == kEncapsulatedInterface) return answer_identification(socket, frame);

  auto request = parse(pdu);
  if (!request) return refuse(frame, request.error());
  Snapshot snapshot = take_();
  snapshot.command = command_;
  if (request->mask) request->write = resolved(*request->mask, map_, snapshot);
  if (const auto exception = check_access(*request, may_write)) return refuse(frame, *exception);

  if (request->write) {
    apply(*request->write, map_, command_);
    carry_out(command_, handler_);
    snapshot.command = command_;  // a read in the same request sees the acknowledgement
  }
  fill_image(snapshot);
  const int sent =
      modbus_reply(context_.get(), frame.data(), static_cast<int>(frame.size()), image_.get());
  return sent < 0 ? Answered::NotTaken : Answered::Done;
}

std::optional<Exception> Responder::check_access(const Request& request, bool may_write) const {
  if (request.write && !may_write) return Exception::IllegalFunction;
  if (request.read) {
    if (const auto exception = check(*request.read, map_)) return exception;
  }
  return request.write ? check(*request.write, map_) : std::nullopt;
}

Answered Responder::refuse(std::span<const std::uint8_t> frame, Exception exception) {
  const int sent =
      modbus_reply_exception(context_.get(), frame.data(), static_cast<unsigned int>(exception));
  return sent < 0 ? Answered::NotTaken : Answered::Refused;
}

Answered Responder::answer_identification(int socket, std::span<const std::uint8_t> frame) {
  const auto pdu = identify(frame.subspan(kHeader));
  if (!pdu) return refuse(frame, pdu.error());
  std::vector<std::uint8_t> answer(frame.begin(), frame.begin() + kHeader);
  const std::size_t length = pdu->size() + 1;  // with the unit
  answer[4] = static_cast<std::uint8_t>(length >> 8);
  answer[5] = static_cast<std::uint8_t>(length);
  answer.insert(answer.end(), pdu->begin(), pdu->end());
  const ssize_t sent = ::send(socket, answer.data(), answer.size(), MSG_NOSIGNAL);
  return sent == static_cast<ssize_t>(answer.size()) ? Answered::Done : Answered::NotTaken;
}

void Responder::fill_image(const Snapshot& snapshot) {
  const std::array<std::uint8_t*, 2> bits{image_->tab_bits, image_->tab_input_bits};
  for (const Row& row : map_.rows()) {
    if (!row.read) continue;  // reserved: stays 0
    const std::uint32_t value = row.read(snapshot, row.index);
    if (row.type == Type::Bool) {
      bits[row.table == Table::Discrete ? 1 : 0][row.address] = static_cast<std::uint8_t>(value);
      continue;
    }
    auto* registers =
        row.table == Table::Input ? image_->tab_input_registers : image_->tab_registers;
    if (row.count == 2) registers[row.address] = static_cast<std::uint16_t>(value >> 16);
    registers[row.address + row.count - 1] = static_cast<std::uint16_t>(value);
  }
}

}  // namespace orbwatch::app::modbus
