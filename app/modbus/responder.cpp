#include "app/modbus/responder.h"

#include <modbus.h>

#include <array>
#include <utility>

#include "app/modbus/device_identification.h"

namespace orbwatch::app::modbus {

void Responder::Free::operator()(_modbus_mapping_t* image) const { modbus_mapping_free(image); }

Result<std::unique_ptr<Responder>> Responder::create(const RegisterMap& map, WriteRegisters write,
                                                     TakeSnapshot take) {
  Image image(modbus_mapping_new(map.size(Table::Coil), map.size(Table::Discrete),
                                 map.size(Table::Holding), map.size(Table::Input)));
  if (!image) return fail("modbus: no memory for the registers");
  return std::unique_ptr<Responder>(
      new Responder(map, std::move(write), std::move(take), std::move(image)));
}

Responder::Responder(const RegisterMap& map, WriteRegisters write, TakeSnapshot take, Image image)
    : map_(map), write_(std::move(write)), take_(std::move(take)), image_(std::move(image)) {}

Answered Responder::answer(Transport& transport, std::span<const std::uint8_t> frame,
                           bool may_write) {
  const auto pdu = transport.pdu_of(frame);
  if (pdu[0] >= 0x80) return Answered::NotModbus;  // marks an answer, not a request
  const auto refuse = [&](Exception exception) {
    return transport.refuse(frame, exception) ? Answered::Refused : Answered::NotTaken;
  };
  const auto done = [](bool taken) { return taken ? Answered::Done : Answered::NotTaken; };
  if (!transport.is_ours(frame)) return refuse(Exception::GatewayTargetFailed);
  if (pdu[0] == kEncapsulatedInterface) {
    const auto identification = identify(pdu);
    return identification ? done(transport.send(frame, *identification))
                          : refuse(identification.error());
  }
  const auto request = parse(pdu);
  if (!request) return refuse(request.error());
  const std::lock_guard lock(mutex_);
  if (const auto exception = carry_out_request(*request, may_write)) return refuse(*exception);
  // libmodbus would put what was written into the image before it reads there.
  if (request->read && request->write) return done(transport.send(frame, words(*request->read)));
  return done(transport.reply(frame, *image_));
}

/// The answer to Read/Write Multiple Registers, from the image.
std::vector<std::uint8_t> Responder::words(const Range& read) const {
  std::vector<std::uint8_t> pdu{MODBUS_FC_WRITE_AND_READ_REGISTERS,
                                static_cast<std::uint8_t>(2 * read.count)};
  for (int at = read.address; at < read.address + read.count; ++at) {
    const std::uint16_t word = image_->tab_registers[at];
    pdu.push_back(static_cast<std::uint8_t>(word >> 8));
    pdu.push_back(static_cast<std::uint8_t>(word));
  }
  return pdu;
}

/// Afterwards what the request reads is in the image.
std::optional<Exception> Responder::carry_out_request(Request request, bool may_write) {
  if (request.mask) request.write = resolved(*request.mask, map_, take_());
  if (const auto exception = check_access(request, may_write)) return exception;
  if (request.write) write_(*request.write);
  if (request.read) fill_image(*request.read, take_());  // sees what the write has led to
  return std::nullopt;
}

std::optional<Exception> Responder::check_access(const Request& request, bool may_write) const {
  if (request.write && !may_write) return Exception::IllegalFunction;
  if (request.read) {
    if (const auto exception = check(*request.read, map_)) return exception;
  }
  return request.write ? check(*request.write, map_) : std::nullopt;
}

void Responder::fill_image(const Range& range, const Snapshot& snapshot) {
  const std::array<std::uint8_t*, 2> bits{image_->tab_bits, image_->tab_input_bits};
  const std::array<std::uint16_t*, 2> words{image_->tab_registers, image_->tab_input_registers};
  const std::size_t input = range.table == Table::Discrete || range.table == Table::Input ? 1 : 0;
  for (int place = range.address; place < range.address + range.count;) {
    const Row& row = *map_.find(range.table, place);
    place = row.address + row.count;
    if (!row.read) continue;  // reserved: stays 0
    const std::uint32_t value = row.read(snapshot);
    if (row.type == Type::Bool) {
      bits[input][row.address] = static_cast<std::uint8_t>(value);
      continue;
    }
    if (row.count == 2) words[input][row.address] = static_cast<std::uint16_t>(value >> 16);
    words[input][place - 1] = static_cast<std::uint16_t>(value);
  }
}

}  // namespace orbwatch::app::modbus
